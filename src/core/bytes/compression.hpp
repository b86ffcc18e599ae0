// SPDX-License-Identifier: MIT
//
// Streams of gzip (RFC 1952) and Zstandard (RFC 8878), by zlib and libzstd.
//
// Promise  the same bytes for the same content on every machine, as long as the libraries' releases
//          are the same: no time and no name is kept.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

enum class Compression { none, gzip, zstd };

/// What the end of a file's name says: .gz, .zst, in letters of any case.
Compression compression_of_name(std::string_view path);

/// What the first bytes of a file say.
Compression compression_of_bytes(std::string_view bytes);

class Compressor {
  public:
    /// Takes the next bytes of the stream; false: it wants no more.
    using Sink = std::function<bool(std::string_view bytes)>;

    /// @param kind not none
    explicit Compressor(Compression kind);

    /// Passes on what the bytes become, as soon as there is enough. False: the sink wants no more.
    bool add(std::string_view bytes, const Sink& sink);

    /// Passes on the end of the stream.
    bool finish(const Sink& sink);

    /// One stream of a kind.
    struct Stream {
        virtual ~Stream() = default;
        /// Takes from the front of `in`, gives to the front of `out`. True: nothing is left to be
        /// taken, and where `last`, to be given.
        virtual bool step(std::string_view& in, std::span<char>& out, bool last) = 0;
    };

  private:
    bool pass(std::string_view bytes, bool last, const Sink& sink);

    std::unique_ptr<Stream> stream_;
};

class Decompressor {
  public:
    /// Gives the next compressed bytes, which stay until it is called again; none at their end.
    using Refill = std::function<std::string_view()>;

    /// @param kind not none
    /// @param name of the file, for messages
    Decompressor(Compression kind, Refill refill, std::string name);

    /// Fills all of it, or what is left for; returns how many bytes came.
    /// @throws Error(input): damaged, or ends too soon
    std::size_t read(std::span<char> bytes);

    /// One stream of a kind, or several in a row.
    struct Stream {
        virtual ~Stream() = default;
        /// Takes from the front of `in`, gives to the front of `out`; true: here a stream ends.
        /// Nothing is wrong where `wrong` stays empty.
        virtual bool step(std::string_view& in, std::span<char>& out, std::string& wrong) = 0;
    };

  private:
    Refill refill_;
    std::string name_;
    std::unique_ptr<Stream> stream_;
    std::string_view in_ = {};
    bool at_end_ = false;  ///< of the compressed bytes
    bool whole_ = false;   ///< a stream has ended, and none begun
};

}  // namespace stipple
