// SPDX-License-Identifier: MIT
#include "io/point_stream.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "io/binary.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// Sets that are in memory.
class HeldSets final : public PointStream {
  public:
    explicit HeldSets(std::vector<PointSet> sets) : sets_(std::move(sets)) {}

    std::size_t dimension() const override { return sets_.front().dimension(); }
    std::optional<std::size_t> sets() const override { return sets_.size(); }
    std::optional<std::uint64_t> count() const override { return set().count(); }
    const Provenance& provenance() const override { return set().provenance; }
    bool held() const override { return true; }
    std::vector<PointSet> read_all(const RunContext&) override { return std::move(sets_); }

    bool next_set() override {
        at_ = 0;
        return next_++ < sets_.size();
    }

    std::size_t read(std::span<double> rows) override {
        const auto rest = set().flat().subspan(at_);
        const std::size_t size = std::min(rest.size(), rows.size());
        std::ranges::copy(rest.first(size), rows.begin());
        at_ += size;
        return size / dimension();
    }

  private:
    const PointSet& set() const { return sets_[std::max<std::size_t>(next_, 1) - 1]; }

    std::vector<PointSet> sets_;
    std::size_t next_ = 0;
    std::size_t at_ = 0;  ///< numbers of this set that were read
};

class RawStream final : public PointStream {
  public:
    RawStream(std::unique_ptr<Feed> feed, const RawShape& shape, const ReadOptions& options)
        : feed_(std::move(feed)),
          shape_(shape),
          source_(source_name(options.source)),
          columns_(choose_columns({}, shape.width, options, source_)) {
        std::string head(shape.offset, '\0');
        feed_->read(head);
    }

    std::size_t dimension() const override { return columns_.dimension; }
    std::optional<std::size_t> sets() const override { return shape_.sets; }
    std::optional<std::uint64_t> count() const override { return shape_.count; }
    const Provenance& provenance() const override { return provenance_; }

    bool next_set() override {
        if (set_ == shape_.sets) return false;
        ++set_;
        left_ = shape_.count.value_or(std::numeric_limits<std::uint64_t>::max());
        return true;
    }

    std::size_t read(std::span<double> rows) override {
        const auto wanted =
            static_cast<std::size_t>(std::min<std::uint64_t>(left_, rows.size() / dimension()));
        const std::size_t size = shape_.type.size;
        bytes_.resize(wanted * shape_.width * size);
        bytes_.resize(feed_->read(bytes_));
        check_end(wanted);
        const std::size_t numbers = bytes_.size() / size;
        const bool plain = columns_.plain();
        std::vector<double> table(plain ? 0 : numbers);
        const std::span<double> to = plain ? rows.first(numbers) : std::span(table);
        take_raw(bytes_, shape_.type, to);
        check_finite(to, {.source = source_,
                          .row = shape_.width,
                          .size = size,
                          .offset = shape_.offset,
                          .before = numbers_});
        if (!plain) std::ranges::copy(keep_coordinates(std::move(table), columns_), rows.begin());
        numbers_ += numbers;
        left_ -= numbers / shape_.width;
        check_rest();
        return numbers / shape_.width;
    }

  private:
    /// Looks whether the bytes may end here.
    void check_end(std::size_t wanted) const {
        const std::size_t point = shape_.width * shape_.type.size;
        const std::size_t all = shape_.offset + numbers_ * shape_.type.size + bytes_.size();
        if (bytes_.size() == wanted * point) return;
        if (shape_.count)
            fail(ErrorKind::input,
                 "{}: byte {}: the file ends too soon; expected {} bytes of "
                 "numbers, found {}",
                 source_, all, shape_.sets * *shape_.count * point, all - shape_.offset);
        if (bytes_.size() % point != 0)
            fail(ErrorKind::input,
                 "{}: byte {}: the last point is cut off; expected whole points, {} float{} each",
                 source_, all, shape_.width, 8 * shape_.type.size);
    }

    /// Behind the last of a known number of points nothing may follow.
    void check_rest() {
        if (!shape_.count || left_ > 0 || set_ < shape_.sets || ended_) return;
        ended_ = true;
        std::string more(Feed::front_size, '\0');
        const std::size_t got = feed_->read(more);
        if (got > 0)
            fail(ErrorKind::input,
                 "{}: byte {}: {}{} bytes follow the numbers; expected the end "
                 "of the file",
                 source_, shape_.offset + numbers_ * shape_.type.size,
                 got == more.size() ? "at least " : "", got);
    }

    std::unique_ptr<Feed> feed_;
    RawShape shape_;
    std::string source_;
    Columns columns_;
    Provenance provenance_;
    std::size_t set_ = 0;
    std::uint64_t left_ = 0;   ///< points of this set
    std::size_t numbers_ = 0;  ///< that were read
    bool ended_ = false;
    std::string bytes_;
};

}  // namespace

std::vector<PointSet> PointStream::read_all(const RunContext& run) {
    std::vector<PointSet> sets;
    const std::size_t d = dimension();
    const std::size_t step = std::max<std::size_t>(1, (std::size_t{1} << 18) / d) * d;
    while (next_set()) {
        std::vector<double> rows;
        for (std::size_t got = step; got == step;) {
            const std::size_t before = rows.size();
            run.need_memory(8 * static_cast<double>(before + step), "the points");
            rows.resize(before + step);
            got = d * read(std::span(rows).subspan(before));
            rows.resize(before + got);
        }
        sets.emplace_back(std::move(rows), d);
        sets.back().provenance = provenance();
    }
    return sets;
}

std::unique_ptr<PointStream> stream_raw(std::unique_ptr<Feed> feed, const RawShape& shape,
                                        const ReadOptions& options) {
    return std::make_unique<RawStream>(std::move(feed), shape, options);
}

std::unique_ptr<PointStream> open_points(const std::string& path, const ReadOptions& options,
                                         const RunContext& run, const Format* format) {
    auto feed = std::make_unique<Feed>(path, run);
    ReadOptions inner = options;
    if (inner.source == "-") inner.source = path;
    inner.single = options.single || extension_is_single(path);
    const Format& chosen = format != nullptr ? *format : format_for(path, feed->front());
    if (chosen.stream && !feed->ends_in_front())
        if (auto stream = chosen.stream(feed, inner, run)) return stream;
    const std::string bytes = feed->read_all();
    return std::make_unique<HeldSets>(read_sets(bytes, path, inner, run, format));
}

}  // namespace stipple::io
