// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string_view>

#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "media/token_file.hpp"
#include "media/triangle_mesh.hpp"

namespace stipple {
namespace {

struct Property {
    std::string name;
    RawType type;
    bool list = false;
    RawType length = {};
};

struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
};

struct Header {
    bool ascii = false;
    std::vector<Element> elements;
};

RawType type_of(TokenFile& file) {
    const Token token = file.next("a type");
    constexpr RawType int8{RawType::integer, 1}, uint8{RawType::natural, 1};
    constexpr RawType int16{RawType::integer, 2}, uint16{RawType::natural, 2};
    constexpr RawType int32{RawType::integer, 4}, uint32{RawType::natural, 4};
    constexpr RawType float32{RawType::floating, 4}, float64{RawType::floating, 8};
    constexpr std::pair<std::string_view, RawType> names[] = {
        {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
        {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
        {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
        {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
    for (const auto& [name, type] : names)
        if (token.text == name) return type;
    file.refuse(token, fmt::format("{} is not a type; expected char, uchar, short, ushort, int, "
                                   "uint, float or double",
                                   shown(token.text)));
}

bool is_ascii(TokenFile& file) {
    const Token token = file.next("a format");
    if (token.text != "ascii" && token.text != "binary_little_endian")
        file.refuse(token, fmt::format("format {} is not read; expected ascii or "
                                       "binary_little_endian",
                                       shown(token.text)));
    return token.text == "ascii";
}

Property property_of(TokenFile& file) {
    Property property{.name = {}, .type = {}};
    if (file.peek().text == "list") {
        file.next("list");
        property.list = true;
        property.length = type_of(file);
    }
    property.type = type_of(file);
    property.name = file.next("the name of a property").text;
    return property;
}

/// Parses the header; the file is then positioned after it.
Header header_of(TokenFile& file) {
    Header header;
    file.next("ply");
    while (true) {
        const Token word = file.next("end_header");
        if (word.text == "end_header") return header;
        if (word.text == "format") {
            header.ascii = is_ascii(file);
        } else if (word.text == "element") {
            Element element{.name = std::string(file.next("the name of an element").text),
                            .count = file.number("the number of its rows"),
                            .properties = {}};
            header.elements.push_back(std::move(element));
        } else if (word.text == "property") {
            if (header.elements.empty()) file.refuse(word, "a property before any element");
            header.elements.back().properties.push_back(property_of(file));
        } else if (word.text != "comment" && word.text != "obj_info") {
            file.refuse(word, fmt::format("{} is not known; expected format, element, property, "
                                          "comment or end_header",
                                          shown(word.text)));
        }
        while (!file.at_line_end()) file.next("a word");
    }
}

/// Reader of the numbers after the header, in order.
class Body {
  public:
    Body() = default;
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;
    virtual ~Body() = default;

    /// Sets the position reported in error messages.
    void stand_at(const Element& element, const Property& property, std::uint64_t row) {
        element_ = &element;
        property_ = &property;
        row_ = row;
    }
    /// Describes the position: "x of vertex 3 of 8".
    [[nodiscard]] std::string what() const {
        return fmt::format("{} of {} {} of {}", property_->name, element_->name, row_ + 1,
                           element_->count);
    }

    /// Reads the next number. @throws Error(input) at the end of the data
    virtual double next(const RawType& type) = 0;
    /// Reports an error at the last number.
    [[noreturn]] virtual void refuse(const std::string& what) = 0;
    /// Checks that no data is left.
    virtual void finish() = 0;

  private:
    const Element* element_ = nullptr;
    const Property* property_ = nullptr;
    std::uint64_t row_ = 0;
};

class AsciiBody final : public Body {
  public:
    explicit AsciiBody(TokenFile& file) : file_(file) {}

    double next(const RawType& /*type*/) override {
        if (file_.at_end()) file_.next(what());
        last_ = file_.next("a number");
        const auto value = parse_number(last_.text);
        if (!value) refuse(fmt::format("not a finite number; expected {}", what()));
        return *value;
    }
    [[noreturn]] void refuse(const std::string& what) override {
        file_.refuse(last_, fmt::format("{}: {}", shown(last_.text), what));
    }
    void finish() override {
        if (file_.at_end()) return;
        last_ = file_.peek();
        refuse("more than the header announces; expected the end of the file");
    }

  private:
    TokenFile& file_;
    Token last_;
};

class BinaryBody final : public Body {
  public:
    BinaryBody(std::string_view bytes, std::size_t at, std::string name)
        : bytes_(bytes), at_(at), name_(std::move(name)) {}

    double next(const RawType& type) override {
        last_ = at_;
        if (bytes_.size() - at_ < type.size)
            fail(ErrorKind::input, "{}: byte {}: the file ends here; expected {}", name_,
                 bytes_.size() + 1, what());
        double value = 0;
        take_raw(bytes_.substr(at_, type.size), type, {&value, 1});
        at_ += type.size;
        return value;
    }
    [[noreturn]] void refuse(const std::string& what) override {
        fail(ErrorKind::input, "{}: byte {}: {}", name_, last_ + 1, what);
    }
    void finish() override {
        if (at_ == bytes_.size()) return;
        last_ = at_;
        refuse(fmt::format("{} bytes more than the header announces", bytes_.size() - at_));
    }

  private:
    std::string_view bytes_;
    std::size_t at_;
    std::size_t last_ = 0;  ///< start of the last number
    std::string name_;
};

/// Reads the rows of all elements into a mesh.
class Assembly {
  public:
    Assembly(Body& body, const Header& header, const RunContext& run)
        : body_(body), header_(header), run_(run) {}

    TriangleMesh mesh(const std::string& name) {
        for (const Element& element : header_.elements)
            for (std::uint64_t row = 0; row < element.count && !element.properties.empty(); ++row) {
                if (row % 65536 == 0) run_.check_stop();
                read_row(element, row);
            }
        body_.finish();
        mesh_.triangles = faces_.triangles(mesh_.vertices, name, run_);
        return std::move(mesh_);
    }

  private:
    void read_row(const Element& element, std::uint64_t row) {
        Vector3 at{};
        for (const Property& property : element.properties) {
            body_.stand_at(element, property, row);
            if (property.list) {
                read_list(element, property);
                continue;
            }
            const double value = body_.next(property.type);
            const std::size_t axis = std::string_view("xyz").find(property.name);
            if (element.name != "vertex" || property.name.size() != 1 || axis > 2) continue;
            if (!(std::abs(value) <= most_coordinate))
                body_.refuse(fmt::format("{} is {}; expected a number in [-1e150, 1e150]",
                                         body_.what(), value));
            at[axis] = value;
        }
        if (element.name == "vertex") mesh_.vertices.push_back(at);
    }

    void read_list(const Element& element, const Property& property) {
        const double length = body_.next(property.length);
        if (!(length >= 0 && length <= 1e9 && length == std::floor(length)))
            body_.refuse(fmt::format("a list of {} numbers in {}", length, body_.what()));
        const bool corners = element.name == "face" && property.name.starts_with("vertex_ind");
        if (corners && length < 3)
            body_.refuse(
                fmt::format("{} corners in {}; at least 3 are needed", length, body_.what()));
        polygon_.clear();
        for (auto left = static_cast<std::uint64_t>(length); left > 0; --left) {
            const double index = body_.next(property.type);
            if (corners) polygon_.push_back(place_of(index));
        }
        if (corners) faces_.add(polygon_);
    }

    std::uint32_t place_of(double index) {
        const auto count = static_cast<double>(mesh_.vertices.size());
        if (!(index >= 0 && index < count && index == std::floor(index)))
            body_.refuse(fmt::format("there is no vertex {}, used in {}; there are {}, from 0",
                                     index, body_.what(), mesh_.vertices.size()));
        return static_cast<std::uint32_t>(index);
    }

    Body& body_;
    const Header& header_;
    const RunContext& run_;
    TriangleMesh mesh_;
    MeshFaces faces_;
    std::vector<std::uint32_t> polygon_;
};

/// Checks the header. @throws Error(input) if it does not describe a mesh
void check(const Header& header, TokenFile& file) {
    const auto has = [&](std::string_view element, std::string_view property, bool list) {
        for (const Element& e : header.elements)
            for (const Property& p : e.properties)
                if (e.name == element && p.name.starts_with(property) && p.list == list)
                    return true;
        return false;
    };
    for (const char* axis : {"x", "y", "z"})
        if (!has("vertex", axis, false))
            file.refuse_whole(fmt::format("no property {} of element vertex in the header", axis));
    if (!has("face", "vertex_ind", true))
        file.refuse_whole(
            "no property list vertex_indices of element face in the header; points alone have no "
            "surface");
    if (header.elements.size() > 64) file.refuse_whole("more than 64 elements in the header");
    for (const Element& element : header.elements)
        if (element.count > std::numeric_limits<std::uint32_t>::max())
            file.refuse_whole(fmt::format("{} rows of element {}; at most 2^32 - 1 are read",
                                          element.count, element.name));
}

}  // namespace

TriangleMesh parse_ply(std::string bytes, const std::string& name, const RunContext& run) {
    constexpr std::string_view last = "\nend_header";
    const auto found = bytes.find(last);
    if (found == std::string::npos)
        fail(ErrorKind::input, "{}: no line end_header; the header is cut off", name);
    const auto end = bytes.find('\n', found + last.size());
    const std::size_t begin = end == std::string::npos ? bytes.size() : end + 1;
    TokenFile head(bytes.substr(0, begin), name);
    const Header header = header_of(head);
    check(header, head);
    TriangleMesh mesh;
    if (header.ascii) {
        TokenFile file(std::move(bytes), name);
        header_of(file);
        AsciiBody body(file);
        mesh = Assembly(body, header, run).mesh(name);
    } else {
        BinaryBody body(bytes, begin, name);
        mesh = Assembly(body, header, run).mesh(name);
    }
    if (mesh.triangles.empty()) head.refuse_whole("no faces");
    return mesh;
}

}  // namespace stipple
