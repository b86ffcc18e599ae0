// SPDX-License-Identifier: MIT
#include "media/png_picture.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <csetjmp>
#include <cstring>

#include "core/error.hpp"

namespace stipple {
namespace {

/// Stores the message of libpng, which reports errors by longjmp. Functions that call setjmp must
/// hold no objects with destructors, since the jump would not call them.
class ErrorText {
  public:
    [[nodiscard]] const char* error() const { return text_.data(); }

  protected:
    [[noreturn]] static void take_error(png_structp png, png_const_charp message) {
        auto& self = *static_cast<ErrorText*>(png_get_error_ptr(png));
        std::strncpy(self.text_.data(), message, self.text_.size() - 1);
        png_longjmp(png, 1);
    }
    static void ignore_warning(png_structp, png_const_charp) {}

  private:
    std::array<char, 128> text_{"libpng cannot be used"};
};

class Decoder : public ErrorText {
  public:
    explicit Decoder(std::string_view bytes) : bytes_(bytes) {
        ErrorText* const errors = this;
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, errors, take_error, ignore_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

    /// Reads everything before the pixels; requests 16-bit samples without a palette. On failure
    /// returns false and sets error().
    bool read_head() {
        if (info_ == nullptr) return false;
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_read_fn(png_, this, give_bytes);
        png_read_info(png_, info_);
        png_set_expand_16(png_);
        if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    /// Reads all rows and the end of the file. On failure returns false and sets error().
    bool read_rows(png_bytep* rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    [[nodiscard]] std::size_t width() const { return png_get_image_width(png_, info_); }
    [[nodiscard]] std::size_t height() const { return png_get_image_height(png_, info_); }
    [[nodiscard]] std::size_t channels() const { return png_get_channels(png_, info_); }

  private:
    static void give_bytes(png_structp png, png_bytep out, std::size_t size) {
        auto& self = *static_cast<Decoder*>(png_get_io_ptr(png));
        if (self.bytes_.size() < size) png_error(png, "the file ends too soon");
        std::memcpy(out, self.bytes_.data(), size);
        self.bytes_.remove_prefix(size);
    }

    std::string_view bytes_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// Counterpart of Decoder: collects the bytes that libpng writes.
class Encoder : public ErrorText {
  public:
    Encoder() {
        ErrorText* const errors = this;
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, errors, take_error, ignore_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
    ~Encoder() { png_destroy_write_struct(&png_, &info_); }

    /// Writes a whole picture. On failure returns false and sets error().
    bool write(const PngShape& shape, std::span<png_bytep> rows, std::span<png_text> texts) {
        if (info_ == nullptr) return false;
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_write_fn(png_, this, take_bytes, nullptr);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(shape.width),
                     static_cast<png_uint_32>(shape.height), shape.bits,
                     shape.colour ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        if (shape.linear) png_set_gAMA(png_, info_, 1);
        png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
        png_write_info(png_, info_);
        png_write_image(png_, rows.data());
        png_write_end(png_, nullptr);
        return true;
    }

    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    /// No exception may propagate through libpng.
    [[nodiscard]] bool append(const char* bytes, std::size_t size) noexcept {
        try {
            bytes_.append(bytes, size);
            return true;
        } catch (...) {
            return false;
        }
    }

    static void take_bytes(png_structp png, png_bytep bytes, std::size_t size) {
        auto& self = *static_cast<Encoder*>(png_get_io_ptr(png));
        if (!self.append(reinterpret_cast<const char*>(bytes), size))
            png_error(png, "out of memory");
    }

    std::string bytes_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// Whether every chunk fits into the file: libpng would allocate any length that a chunk claims.
bool chunks_fit(std::string_view png) {
    for (png.remove_prefix(png_magic.size()); png.size() >= 8;) {
        const std::size_t length = png_get_uint_32(reinterpret_cast<png_const_bytep>(png.data()));
        if (png.size() < 12 || length > png.size() - 12) return false;
        if (png.substr(4, 4) == "IEND") break;  // libpng reads no further
        png.remove_prefix(12 + length);
    }
    return true;
}

}  // namespace

PngPicture read_png(std::string_view bytes, const std::string& source, const RunContext& run) {
    if (!bytes.starts_with(png_magic)) fail(ErrorKind::input, "{}: not a PNG picture", source);
    if (!chunks_fit(bytes))
        fail(ErrorKind::input, "{}: not a whole PNG picture: the file ends too soon", source);
    Decoder decoder(bytes);
    if (!decoder.read_head())
        fail(ErrorKind::input, "{}: not a whole PNG picture: {}", source, decoder.error());
    PngPicture picture{
        .width = decoder.width(), .height = decoder.height(), .grey = {}, .opacity = {}};
    const std::size_t pixels = picture.width * picture.height;
    run.need_memory(static_cast<double>(pixels) * 24, "the picture " + source);

    const std::size_t channels = decoder.channels();
    std::vector<std::uint16_t> samples(channels * pixels);
    std::vector<png_bytep> rows(picture.height);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = reinterpret_cast<png_bytep>(&samples[i * channels * picture.width]);
    if (!decoder.read_rows(rows.data()))
        fail(ErrorKind::input, "{}: not a whole PNG picture: {}", source, decoder.error());

    constexpr double largest = 65535;
    picture.grey.resize(pixels);
    if (channels % 2 == 0) picture.opacity.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint16_t* s = &samples[i * channels];
        // Integer weights: if red, green and blue are equal, the grey is exactly the same number.
        picture.grey[i] = channels < 3
                              ? s[0] / largest
                              : (2126. * s[0] + 7152. * s[1] + 722. * s[2]) / (10000 * largest);
        if (channels % 2 == 0) picture.opacity[i] = s[channels - 1] / largest;
    }
    return picture;
}

/// A chunk (ISO/IEC 15948:2004, 5.3) is its data's length, type, data, CRC of type and data.
std::string png_with_text(std::string_view png, std::string_view keyword, std::string_view text) {
    constexpr std::size_t behind_header = 8 + 12 + 13;
    std::string content("tEXt");
    content.append(keyword).append(1, '\0').append(text);
    boost::crc_32_type crc;
    crc.process_bytes(content.data(), content.size());
    std::string out(png.substr(0, behind_header));
    const auto append_word = [&out](std::uint64_t word) {
        for (int shift = 24; shift >= 0; shift -= 8)
            out += static_cast<char>((word >> shift) & 255);
    };
    append_word(content.size() - 4);
    out += content;
    append_word(crc.checksum());
    return out.append(png.substr(std::min(behind_header, png.size())));
}

namespace {

/// Text of an iTXt chunk (11.3.4.5); nullopt if compressed. `data` follows the keyword: compression
/// flag and method, language and translated keyword, each terminated by 0, and the text.
std::optional<std::string> international_text(std::string_view data) {
    if (data.size() < 2 || data[0] != 0) return std::nullopt;
    data.remove_prefix(2);
    for (int names = 0; names < 2; ++names) {
        const auto end = data.find('\0');
        if (end == std::string_view::npos) return std::nullopt;
        data.remove_prefix(end + 1);
    }
    return std::string(data);
}

}  // namespace

std::optional<std::string> text_of_png(std::string_view png, std::string_view keyword) {
    std::string wanted(keyword);
    wanted += '\0';
    for (std::size_t at = png_magic.size(); at + 12 <= png.size();) {
        const std::size_t length =
            png_get_uint_32(reinterpret_cast<png_const_bytep>(png.data() + at));
        if (length > png.size() - at - 12) return std::nullopt;
        const auto data = png.substr(at + 8, length);
        const bool ours = data.starts_with(wanted);
        if (png.substr(at + 4, 4) == "tEXt" && ours) return std::string(data.substr(wanted.size()));
        if (png.substr(at + 4, 4) == "iTXt" && ours)
            if (auto text = international_text(data.substr(wanted.size()))) return text;
        at += 12 + length;
    }
    return std::nullopt;
}

std::string encode_png(const PngShape& shape, std::string_view bytes,
                       std::span<const PngText> texts) {
    if (std::max(shape.width, shape.height) > PNG_UINT_31_MAX)
        fail(ErrorKind::limit, "a PNG picture of {} x {} pixels is too large", shape.width,
             shape.height);
    // libpng's interface requires mutable rows and texts, although it does not modify them.
    std::vector<PngText> held(texts.begin(), texts.end());
    std::vector<png_text> chunks(held.size());
    for (std::size_t i = 0; i < held.size(); ++i) {
        chunks[i].compression = PNG_ITXT_COMPRESSION_NONE;
        chunks[i].key = held[i].first.data();
        chunks[i].text = held[i].second.data();
        chunks[i].itxt_length = held[i].second.size();
    }
    std::vector<unsigned char> pixels(bytes.begin(), bytes.end());
    std::vector<png_bytep> rows(shape.height);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = pixels.data() + i * (pixels.size() / shape.height);
    Encoder encoder;
    if (!encoder.write(shape, rows, chunks))
        fail(ErrorKind::limit, "a PNG picture of {} x {} pixels: {}", shape.width, shape.height,
             encoder.error());
    return encoder.take();
}

std::string png_bytes_of_samples(std::span<const std::uint16_t> samples, int bits) {
    std::string bytes;
    bytes.reserve(samples.size() * static_cast<std::size_t>(bits / 8));
    for (const std::uint16_t sample : samples) {
        if (bits == 16) bytes += static_cast<char>(sample >> 8);
        bytes += static_cast<char>(sample & 255);
    }
    return bytes;
}

}  // namespace stipple
