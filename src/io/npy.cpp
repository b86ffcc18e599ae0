// SPDX-License-Identifier: MIT
//
// NumPy's array files: a magic string, a version, the length of a header, a Python dictionary
// padded with blanks to a multiple of 64 bytes, and the raw numbers.
//
//     \x93NUMPY 1 0 <u16> {'descr': '<f8', 'fortran_order': False, 'shape': (1024, 2), }
//
// Shape   (n, d), or (R, n, d) for R sets; extras count as coordinates. The reader also takes (n,),
//         versions 2 and 3, both byte orders, column-major order, float32 and integers.
// Source  numpy.lib.format, NEP 1 (https://numpy.org/neps/nep-0001-npy-format.html).
#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/binary.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

void head(const Layout& layout, std::string& out) {
    std::string header = fmt::format(
        "{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}{}, {}), }}", layout.single ? 4 : 8,
        layout.many_sets ? fmt::format("{}, ", layout.counts.size()) : std::string(),
        layout.counts.at(0), layout.width());
    constexpr std::size_t before = 10;
    const std::size_t used = before + header.size() + 1;
    header.append((64 - used % 64) % 64, ' ');
    header += '\n';
    out += magic;
    out.append({'\1', '\0', static_cast<char>(header.size() % 256),
                static_cast<char>(header.size() / 256)});
    out += header;
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_raw(out, numbers, layout.single);
}

/// What a header says.
struct Header {
    RawType type;
    bool columns_first = false;
    std::vector<std::size_t> shape;
    std::size_t size = 0;  ///< bytes before the numbers
};

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, std::string source)
        : bytes_(bytes), source_(std::move(source)) {}

    Header read() {
        if (!bytes_.starts_with(magic)) refuse(0, "not an npy file; expected the bytes \\x93NUMPY");
        const std::size_t version = number(6, 1);
        if (version < 1 || version > 3)
            refuse(6, fmt::format("npy version {}; expected 1, 2 or 3", version));
        start_ = version == 1 ? 10 : 12;
        const std::size_t length = number(8, start_ - 8);
        if (length > bytes_.size() - start_)
            refuse(bytes_.size(),
                   fmt::format("the header is cut off; expected {} bytes of it", length));
        text_ = bytes_.substr(start_, length);
        Header header{.type = type(), .shape = shape(), .size = start_ + length};
        header.columns_first = word_behind("fortran_order").starts_with("True");
        return header;
    }

    [[noreturn]] void refuse(std::size_t byte, const std::string& what) const {
        fail(ErrorKind::input, "{}: byte {}: {}", source_, byte, what);
    }

  private:
    std::size_t number(std::size_t at, std::size_t size) const {
        if (bytes_.size() < at + size) refuse(bytes_.size(), "the file ends in the npy header");
        std::size_t value = 0;
        for (std::size_t i = size; i-- > 0;)
            value = value * 256 + static_cast<unsigned char>(bytes_[at + i]);
        return value;
    }

    /// The text behind a key of the dictionary.
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
            constexpr std::string_view kinds = "fiu";
            const auto kind = kinds.find(name[2]);
            const auto size = static_cast<std::size_t>(name[3] - '0');
            const bool whole = size == 1 || size == 2;
            if (kind != kinds.npos && (size == 4 || size == 8 || (kind > 0 && whole)))
                return {static_cast<RawType::Kind>(kind), size, name[1] == '>'};
        }
        refuse(start_,
               fmt::format("numbers of type {}; expected float64, float32 or integers", name));
    }

    std::vector<std::size_t> shape() const {
        const std::string_view word = word_behind("shape");
        const auto close = word.find(')');
        if (!word.starts_with('(') || close == word.npos)
            refuse(start_, "the header's shape is not like (1024, 2)");
        std::vector<std::size_t> shape;
        for (const auto part : split(word.substr(1, close - 1), ',')) {
            if (trim(part).empty()) continue;
            const auto extent = parse_unsigned(trim(part));
            if (!extent) refuse(start_, "the header's shape is not like (1024, 2)");
            shape.push_back(*extent);
        }
        const std::string shown(word.substr(0, close + 1));
        if (shape.empty() || shape.size() > 3)
            refuse(
                start_,
                fmt::format("an array of shape {}; expected (n,), (n, d) or (sets, n, d)", shown));
        if (std::ranges::find(shape, std::size_t{0}) != shape.end())
            refuse(start_, fmt::format("an array of shape {} holds no points", shown));
        return shape;
    }

    std::string_view bytes_;
    std::string source_;
    std::string_view text_;
    std::size_t start_ = 0;
};

/// Bytes that the numbers take. Refuses a file that has fewer or more.
std::size_t data_bytes(const Header& header, std::size_t present, const HeaderReader& reader) {
    std::size_t wanted = header.type.size;
    for (const std::size_t extent : header.shape)
        if (__builtin_mul_overflow(wanted, extent, &wanted))
            reader.refuse(header.size, "the shape is larger than any file");
    if (present < wanted)
        reader.refuse(header.size + present,
                      fmt::format("the file ends too soon; expected {} bytes "
                                  "of numbers, found {}",
                                  wanted, present));
    if (present > wanted)
        reader.refuse(header.size + wanted,
                      fmt::format("{} bytes follow the numbers; expected the end of the file",
                                  present - wanted));
    return wanted;
}

/// Point after point what was stored with the first index running fastest.
std::vector<double> rows_first(const std::vector<double>& stored, std::size_t sets, std::size_t n,
                               std::size_t d) {
    std::vector<double> table(stored.size());
    for (std::size_t r = 0; r < sets; ++r)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < d; ++k)
                table[(r * n + i) * d + k] = stored[r + sets * (i + n * k)];
    return table;
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const std::string source = source_name(options.source);
    HeaderReader reader(bytes, source);
    const Header header = reader.read();
    const std::string_view data = bytes.substr(header.size);
    const std::size_t size = data_bytes(header, data.size(), reader) / header.type.size;
    const std::size_t rank = header.shape.size();
    const std::size_t sets = rank == 3 ? header.shape[0] : 1;
    const std::size_t width = rank == 1 ? 1 : header.shape.back();
    const std::size_t n = size / sets / width;

    run.need_memory(static_cast<double>(size) * 8, "the points of " + source);
    const Columns columns = choose_columns({}, width, options, source);
    std::vector<double> table(size);
    take_raw(data, header.type, table);
    check_finite(table, {.source = source,
                         .row = header.columns_first ? 0 : width,
                         .size = header.type.size,
                         .offset = header.size});
    if (header.columns_first) table = rows_first(table, sets, n, width);
    std::vector<std::uint64_t> starts(sets);
    for (std::size_t r = 0; r < sets; ++r) starts[r] = r * n;
    return cut_sets(keep_coordinates(std::move(table), columns), columns.dimension, starts, {});
}

}  // namespace

Format npy() {
    return {.name = "npy",
            .summary = "NumPy array of shape (n, d), or (sets, n, d)",
            .source = "NEP 1, numpy.lib.format",
            .extensions = {".npy"},
            .traits = {.binary = true, .equal_sets = true},
            .head = head,
            .rows = rows,
            .read = read};
}

}  // namespace stipple::io
