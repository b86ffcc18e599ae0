// SPDX-License-Identifier: MIT
#include "media/pfm_picture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

bool ends_word(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Reads the words of the header, each with the one white space character after it.
class Head {
  public:
    Head(std::string_view bytes, const std::string& source) : bytes_(bytes), source_(source) {}

    std::string_view word(const char* what) {
        while (at_ < bytes_.size() && ends_word(bytes_[at_])) ++at_;
        const std::size_t from = at_;
        while (at_ < bytes_.size() && !ends_word(bytes_[at_]) && at_ - from < 40) ++at_;
        if (at_ == from || at_ == bytes_.size() || !ends_word(bytes_[at_])) refuse(from, what);
        return bytes_.substr(from, at_++ - from);
    }

    std::size_t extent(const char* what) {
        const std::size_t from = at_;
        const auto value = parse_integer(word(what));
        if (!value || *value < 1 || *value > 1'000'000'000) refuse(from, what);
        return static_cast<std::size_t>(*value);
    }

    double scale() {
        constexpr auto what = "a scale other than 0, below 0 for little-endian floats";
        const std::size_t from = at_;
        const auto value = parse_number(word(what));
        if (!value || *value == 0) refuse(from, what);
        return *value;
    }

    [[nodiscard]] std::size_t size() const { return at_; }

  private:
    [[noreturn]] void refuse(std::size_t byte, const char* what) const {
        fail(ErrorKind::input, "{}: byte {}: expected {}", source_, byte, what);
    }

    std::string_view bytes_;
    const std::string& source_;
    std::size_t at_ = 0;
};

}  // namespace

bool looks_like_pfm(std::string_view bytes) {
    return (bytes.starts_with("PF") || bytes.starts_with("Pf")) && bytes.size() > 2 &&
           ends_word(bytes[2]);
}

PlaneValues read_pfm(std::string_view bytes, const std::string& source, const RunContext& run) {
    Head head(bytes, source);
    const std::size_t channels = head.word("PF or Pf") == "PF" ? 3 : 1;
    PlaneValues picture;
    picture.width = head.extent("the width, a whole number above 0");
    picture.height = head.extent("the height, a whole number above 0");
    const bool big_endian = head.scale() > 0;
    const double pixels = static_cast<double>(picture.width) * static_cast<double>(picture.height);
    const double expected = pixels * static_cast<double>(4 * channels);
    const std::size_t found = bytes.size() - head.size();
    if (static_cast<double>(found) != expected)
        fail(ErrorKind::input, "{}: byte {}: expected {:.0f} bytes of floats, found {}", source,
             head.size(), expected, found);
    run.need_memory(24 * pixels, "the picture " + source);

    picture.values.resize(picture.width * picture.height);
    const RawType type{.kind = RawType::floating, .size = 4, .big_endian = big_endian};
    if (channels == 1) {
        take_raw(bytes.substr(head.size()), type, picture.values);
        return picture;
    }
    std::array<double, 3> rgb{};
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        take_raw(bytes.substr(head.size() + 12 * i, 12), type, rgb);
        // A negative component must make the value negative, so that it is rejected later.
        const bool good = rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0;
        picture.values[i] = good ? 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
                                 : std::min({rgb[0], rgb[1], rgb[2]});
        for (const double part : rgb)
            if (std::isnan(part)) picture.values[i] = part;
    }
    return picture;
}

}  // namespace stipple
