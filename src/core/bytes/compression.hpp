// SPDX-License-Identifier: MIT
//
// Streams of gzip (RFC 1952) and Zstandard (RFC 8878), by zlib and libzstd.
//
// Promise  the same content gives the same bytes on every machine with the same releases of the
//          libraries: no time and no name is stored.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

enum class Compression { none, gzip, zstd };

/// Compression by the extension of a file's name: .gz or .zst, in any case; otherwise none.
Compression compression_of_name(std::string_view path);

/// Compression by the first bytes of a file; none if they match neither format.
Compression compression_of_bytes(std::string_view bytes);

class Compressor {
  public:
    /// Takes the next bytes of the stream; returns false to stop.
    using Sink = std::function<bool(std::string_view bytes)>;

    /// @param kind not Compression::none
    explicit Compressor(Compression kind);

    /// Compresses bytes and passes complete blocks to the sink. Returns false if the sink stopped.
    bool add(std::string_view bytes, const Sink& sink);

    /// Passes the rest of the stream to the sink. Returns false if the sink stopped.
    bool finish(const Sink& sink);

    /// Codec of one compressed stream.
    struct Stream {
        virtual ~Stream() = default;
        /// Consumes the front of `in` and fills the front of `out`. Returns true if all input is
        /// consumed and, if `last`, all output is written.
        virtual bool step(std::string_view& in, std::span<char>& out, bool last) = 0;
    };

  private:
    bool pass(std::string_view bytes, bool last, const Sink& sink);

    std::unique_ptr<Stream> stream_;
};

class Decompressor {
  public:
    /// Returns the next compressed bytes, which stay valid until the next call; empty at the end.
    using Refill = std::function<std::string_view()>;

    /// @param kind not Compression::none
    /// @param name of the file, for error messages
    Decompressor(Compression kind, Refill refill, std::string name);

    /// Fills `bytes`, or only its front at the end of the data; returns the number of bytes read.
    /// @throws Error(input) if the compressed data is damaged or truncated
    std::size_t read(std::span<char> bytes);

    /// Decoder of one compressed stream, or of several in a row.
    struct Stream {
        virtual ~Stream() = default;
        /// Consumes the front of `in` and fills the front of `out`. Returns true at the end of a
        /// stream. Sets `wrong` to a message if the data is damaged.
        virtual bool step(std::string_view& in, std::span<char>& out, std::string& wrong) = 0;
    };

  private:
    Refill refill_;
    std::string name_;
    std::unique_ptr<Stream> stream_;
    std::string_view in_ = {};
    bool at_end_ = false;  ///< no compressed bytes are left
    bool whole_ = false;   ///< a stream has ended, and no other has begun
};

}  // namespace stipple
