// SPDX-License-Identifier: MIT
#include "core/bytes/compression.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <new>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr std::size_t block = std::size_t{1} << 16;
constexpr int gzip_window = 15 + 16;  // largest window; +16 selects the gzip header and checksum

/// Number of bytes to pass to zlib in one call; zlib counts bytes in an unsigned int.
uInt as_much(std::size_t size) { return static_cast<uInt>(std::min(size, std::size_t{1} << 30)); }

/// Passes both spans to zlib; end() drops the consumed front of `in` and the filled front of `out`.
class ZlibTurn {
  public:
    ZlibTurn(z_stream& stream, std::string_view& in, std::span<char>& out)
        : stream_(stream), in_(in), out_(out) {
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
        stream.avail_in = as_much(in.size());
        stream.next_out = reinterpret_cast<Bytef*>(out.data());
        stream.avail_out = as_much(out.size());
    }

    void end() {
        in_.remove_prefix(as_much(in_.size()) - stream_.avail_in);
        out_ = out_.subspan(as_much(out_.size()) - stream_.avail_out);
    }

  private:
    z_stream& stream_;
    std::string_view& in_;
    std::span<char>& out_;
};

struct GzipCompression final : Compressor::Stream {
    GzipCompression() {
        if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, 8,
                         Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    GzipCompression(const GzipCompression&) = delete;
    GzipCompression& operator=(const GzipCompression&) = delete;
    ~GzipCompression() override { deflateEnd(&stream); }

    bool step(std::string_view& in, std::span<char>& out, bool last) override {
        ZlibTurn turn(stream, in, out);
        const int result = deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
        turn.end();
        return last ? result == Z_STREAM_END : in.empty() && !out.empty();
    }

    z_stream stream{};
};

struct ZstdCompression final : Compressor::Stream {
    ZstdCompression() : context(ZSTD_createCCtx(), &ZSTD_freeCCtx) {
        if (!context) throw std::bad_alloc();
        ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    }

    bool step(std::string_view& in, std::span<char>& out, bool last) override {
        ZSTD_inBuffer taken{in.data(), in.size(), 0};
        ZSTD_outBuffer given{out.data(), out.size(), 0};
        const std::size_t left = ZSTD_compressStream2(context.get(), &given, &taken,
                                                      last ? ZSTD_e_end : ZSTD_e_continue);
        if (ZSTD_isError(left) != 0) throw std::bad_alloc();  // only an allocation can fail here
        in.remove_prefix(taken.pos);
        out = out.subspan(given.pos);
        return last ? left == 0 : in.empty() && !out.empty();
    }

    std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context;
};

struct GzipDecompression final : Decompressor::Stream {
    GzipDecompression() {
        if (inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
    }
    GzipDecompression(const GzipDecompression&) = delete;
    GzipDecompression& operator=(const GzipDecompression&) = delete;
    ~GzipDecompression() override { inflateEnd(&stream); }

    bool step(std::string_view& in, std::span<char>& out, std::string& wrong) override {
        ZlibTurn turn(stream, in, out);
        const int result = inflate(&stream, Z_NO_FLUSH);
        turn.end();
        if (result == Z_MEM_ERROR) throw std::bad_alloc();
        if (result == Z_STREAM_END) inflateReset(&stream);
        if (result != Z_OK && result != Z_BUF_ERROR && result != Z_STREAM_END)
            wrong = stream.msg != nullptr ? stream.msg : "unknown error";
        return result == Z_STREAM_END;
    }

    z_stream stream{};
};

struct ZstdDecompression final : Decompressor::Stream {
    ZstdDecompression() : context(ZSTD_createDCtx(), &ZSTD_freeDCtx) {
        if (!context) throw std::bad_alloc();
    }

    bool step(std::string_view& in, std::span<char>& out, std::string& wrong) override {
        ZSTD_inBuffer taken{in.data(), in.size(), 0};
        ZSTD_outBuffer given{out.data(), out.size(), 0};
        const std::size_t left = ZSTD_decompressStream(context.get(), &given, &taken);
        if (ZSTD_isError(left) != 0) wrong = ZSTD_getErrorName(left);
        in.remove_prefix(taken.pos);
        out = out.subspan(given.pos);
        return left == 0;
    }

    std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context;
};

template <class Stream, class Gzip, class Zstd>
std::unique_ptr<Stream> stream_of(Compression kind) {
    if (kind == Compression::gzip) return std::make_unique<Gzip>();
    return std::make_unique<Zstd>();
}

}  // namespace

Compression compression_of_name(std::string_view path) {
    const std::string name =
        lower_case(path.substr(path.size() - std::min<std::size_t>(path.size(), 4)));
    if (name.ends_with(".gz")) return Compression::gzip;
    return name == ".zst" ? Compression::zstd : Compression::none;
}

Compression compression_of_bytes(std::string_view bytes) {
    if (bytes.starts_with("\x1f\x8b\x08")) return Compression::gzip;
    return bytes.starts_with("\x28\xb5\x2f\xfd") ? Compression::zstd : Compression::none;
}

Compressor::Compressor(Compression kind)
    : stream_(stream_of<Stream, GzipCompression, ZstdCompression>(kind)) {}

bool Compressor::add(std::string_view bytes, const Sink& sink) {
    return bytes.empty() || pass(bytes, false, sink);
}

bool Compressor::finish(const Sink& sink) { return pass({}, true, sink); }

bool Compressor::pass(std::string_view bytes, bool last, const Sink& sink) {
    std::array<char, block> buffer;
    for (bool done = false; !done;) {
        std::span<char> room(buffer);
        done = stream_->step(bytes, room, last);
        const std::size_t size = buffer.size() - room.size();
        if (size > 0 && !sink({buffer.data(), size})) return false;
    }
    return true;
}

Decompressor::Decompressor(Compression kind, Refill refill, std::string name)
    : refill_(std::move(refill)),
      name_(std::move(name)),
      stream_(stream_of<Stream, GzipDecompression, ZstdDecompression>(kind)) {}

std::size_t Decompressor::read(std::span<char> bytes) {
    std::span<char> room = bytes;
    while (!room.empty()) {
        if (in_.empty() && !at_end_) {
            in_ = refill_();
            at_end_ = in_.empty();
        }
        if (at_end_ && whole_) break;
        const std::size_t before = room.size();
        std::string wrong;
        whole_ = stream_->step(in_, room, wrong);
        if (!wrong.empty())
            fail(ErrorKind::input, "{}: the compressed bytes are damaged: {}", name_, wrong);
        if (at_end_ && !whole_ && room.size() == before)
            fail(ErrorKind::input, "{}: the compressed bytes end too soon", name_);
    }
    return bytes.size() - room.size();
}

}  // namespace stipple
