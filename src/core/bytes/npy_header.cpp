// SPDX-License-Identifier: MIT
#include "core/bytes/npy_header.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

[[noreturn]] void refuse_at(const std::string& source, std::size_t byte, const std::string& what) {
    fail(ErrorKind::input, "{}: byte {}: {}", source, byte, what);
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& source)
        : bytes_(bytes), source_(source) {}

    NpyHeader read() {
        if (!bytes_.starts_with(npy_magic))
            refuse(0, "not an npy file; expected the bytes \\x93NUMPY");
        const std::size_t version = number(6, 1);
        if (version < 1 || version > 3)
            refuse(6, fmt::format("npy version {}; expected 1, 2 or 3", version));
        start_ = version == 1 ? 10 : 12;
        const std::size_t length = number(8, start_ - 8);
        if (length > bytes_.size() - start_)
            refuse(bytes_.size(),
                   fmt::format("the header is cut off; expected {} bytes of it", length));
        text_ = bytes_.substr(start_, length);
        NpyHeader header{
            .type = type(), .start = start_, .size = start_ + length, .source = source_};
        read_shape(header);
        header.columns_first = word_behind("fortran_order").starts_with("True");
        return header;
    }

  private:
    [[noreturn]] void refuse(std::size_t byte, const std::string& what) const {
        refuse_at(source_, byte, what);
    }

    std::size_t number(std::size_t at, std::size_t size) const {
        if (bytes_.size() < at + size) refuse(bytes_.size(), "the file ends within the npy header");
        std::size_t value = 0;
        for (std::size_t i = size; i-- > 0;)
            value = value * 256 + static_cast<unsigned char>(bytes_[at + i]);
        return value;
    }

    /// Returns the text after a key of the dictionary and its colon.
    /// @throws Error(input) if the key is missing
    std::string_view word_behind(std::string_view key) const {
        for (const char quote : {'\'', '"'}) {
            const auto at = text_.find(quote + std::string(key) + quote);
            if (at == std::string_view::npos) continue;
            const std::string_view rest = trim(text_.substr(at + key.size() + 2));
            if (rest.starts_with(':')) return trim(rest.substr(1));
        }
        refuse(start_, fmt::format("the header has no '{}'", key));
    }

    RawType type() const {
        const std::string_view word = word_behind("descr");
        const auto end = word.empty() ? word.npos : word.find(word.front(), 1);
        const std::string_view name = word.substr(0, end == word.npos ? 8 : end + 1);
        if (name.size() == 5 && (name[0] == '\'' || name[0] == '"')) {
            if (name.substr(1, 3) == "|b1") return {RawType::natural, 1, false};
            constexpr std::string_view kinds = "fiu";
            const auto kind = kinds.find(name[2]);
            const auto size = static_cast<std::size_t>(name[3] - '0');
            const bool whole = size == 1 || size == 2;
            if (kind != kinds.npos && (size == 4 || size == 8 || (kind > 0 && whole)))
                return {static_cast<RawType::Kind>(kind), size, name[1] == '>'};
        }
        refuse(
            start_,
            fmt::format("numbers of type {}; expected float64, float32, integers or bool", name));
    }

    void read_shape(NpyHeader& header) const {
        const std::string_view word = word_behind("shape");
        const auto close = word.find(')');
        if (!word.starts_with('(') || close == word.npos)
            refuse(start_, "the header's shape is not a tuple of whole numbers such as (1024, 2)");
        for (const auto part : split(word.substr(1, close - 1), ',')) {
            if (trim(part).empty()) continue;
            const auto extent = parse_unsigned(trim(part));
            if (!extent)
                refuse(start_,
                       "the header's shape is not a tuple of whole numbers such as (1024, 2)");
            header.shape.push_back(*extent);
        }
        header.shown_shape = word.substr(0, close + 1);
    }

    std::string_view bytes_;
    const std::string& source_;
    std::string_view text_;
    std::size_t start_ = 0;
};

}  // namespace

bool NpyHeader::empty() const { return std::ranges::find(shape, std::size_t{0}) != shape.end(); }

void NpyHeader::refuse(const std::string& what) const { refuse_at(source, start, what); }

NpyHeader read_npy_header(std::string_view bytes, const std::string& source) {
    return HeaderReader(bytes, source).read();
}

std::size_t npy_numbers(const NpyHeader& header, std::size_t bytes) {
    const std::size_t present = bytes - header.size;
    std::size_t wanted = header.type.size;
    for (const std::size_t extent : header.shape)
        if (__builtin_mul_overflow(wanted, extent, &wanted))
            refuse_at(header.source, header.size, "the shape is larger than any file");
    if (present < wanted)
        refuse_at(header.source, bytes,
                  fmt::format("the file ends too soon; expected {} bytes "
                              "of numbers, found {}",
                              wanted, present));
    if (present > wanted)
        refuse_at(header.source, header.size + wanted,
                  fmt::format("{} bytes follow the numbers; expected the end of the file",
                              present - wanted));
    return wanted / header.type.size;
}

std::string npy_head(std::span<const std::uint64_t> shape, bool single) {
    std::vector<std::string> extents;
    for (const std::uint64_t extent : shape) extents.push_back(std::to_string(extent));
    if (shape.size() == 1) extents.emplace_back();  // the trailing comma of a one-element tuple
    std::string header = fmt::format("{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}), }}",
                                     single ? 4 : 8, trim(join(extents, ", ")));
    const std::size_t before = npy_magic.size() + 4;  // magic, version and length
    header.append((64 - (before + header.size() + 1) % 64) % 64, ' ');
    header += '\n';
    std::string bytes(npy_magic);
    bytes.append({'\1', '\0', static_cast<char>(header.size() % 256),
                  static_cast<char>(header.size() / 256)});
    return bytes + header;
}

}  // namespace stipple
