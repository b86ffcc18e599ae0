// SPDX-License-Identifier: MIT
#include "io/point_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// Stream over sets in memory.
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
        if (next_ == sets_.size()) return false;
        at_ = 0;
        ++next_;
        return true;
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
    std::size_t at_ = 0;  ///< numbers of this set already read
};

class RawStream final : public PointStream {
  public:
    RawStream(std::unique_ptr<Feed> feed, const RawShape& shape, const ReadOptions& options)
        : feed_(std::move(feed)),
          shape_(shape),
          source_(source_name(options.source)),
          hint_(options.beside && shape.offset == 0
                    ? fmt::format("{} states their number; remove it if it is of other points",
                                  meta_path(source_))
                    : "") {
        std::vector<std::string> names;
        const CarriedMeta* const beside = options.beside;
        const bool known = beside && shape.count &&
                           beside->fits(shape.sets, *shape.count, shape.width, feed_->front());
        if (known) {
            names = coordinate_names(beside->provenance.dimension, beside->provenance);
            names.insert(names.end(), beside->extras.begin(), beside->extras.end());
            provenance_ = beside->provenance;
        }
        columns_ = choose_columns(names, shape.width, options, source_);
        tell_columns(provenance_, columns_, options);
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
        check_finite(to, shape_, source_, numbers_);
        if (!plain) std::ranges::copy(keep_coordinates(std::move(table), columns_), rows.begin());
        numbers_ += numbers;
        left_ -= numbers / shape_.width;
        check_rest();
        return numbers / shape_.width;
    }

    std::uint64_t skip(std::uint64_t count) override {
        const std::uint64_t point = shape_.width * shape_.type.size;
        constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
        const std::uint64_t wanted = std::min(count, left_);
        const auto bytes = feed_->skip(wanted > most / point ? most : wanted * point);
        if (!bytes) return PointStream::skip(count);
        const std::uint64_t points = *bytes / point;
        numbers_ += static_cast<std::size_t>(points) * shape_.width;
        left_ -= points;
        if (*bytes % point != 0 || (shape_.count && points < wanted)) refuse_end();
        check_rest();
        return points;
    }

  private:
    /// Reports input that ends within a point, or before the announced number of points.
    [[noreturn]] void refuse_end() {
        if (shape_.count) PointStream::skip(1);
        refuse_part(source_);
    }

    /// Checks that `wanted` points were read, or whole points if their number is unknown.
    void check_end(std::size_t wanted) const {
        const std::size_t point = shape_.width * shape_.type.size;
        const std::size_t all = shape_.offset + numbers_ * shape_.type.size + bytes_.size();
        if (bytes_.size() == wanted * point) return;
        if (shape_.count)
            fail_with_hint(ErrorKind::input, hint_,
                           "{}: byte {}: the file ends too soon; expected {} bytes of "
                           "numbers, found {}",
                           source_, all,
                           static_cast<double>(shape_.sets) * static_cast<double>(*shape_.count) *
                               static_cast<double>(point),
                           all - shape_.offset);
        if (bytes_.size() % point != 0) refuse_part(fmt::format("{}: byte {}", source_, all));
    }

    [[noreturn]] void refuse_part(const std::string& place) const {
        fail(ErrorKind::input,
             "{}: the last point is cut off; expected whole points, {} float{} each", place,
             shape_.width, 8 * shape_.type.size);
    }

    /// Rejects bytes after the last point if the number of points is known.
    void check_rest() {
        if (!shape_.count || left_ > 0 || set_ < shape_.sets || ended_) return;
        ended_ = true;
        char next = 0;
        if (feed_->read({&next, 1}) == 0) return;
        std::string more(Feed::front_size, '\0');
        const std::size_t got = 1 + feed_->read(std::span(more).first(more.size() - 1));
        fail_with_hint(ErrorKind::input, hint_,
                       "{}: byte {}: {}{} bytes follow the numbers; expected the end "
                       "of the file",
                       source_, shape_.offset + numbers_ * shape_.type.size,
                       got == more.size() ? "at least " : "", got);
    }

    std::unique_ptr<Feed> feed_;
    RawShape shape_;
    std::string source_;
    std::string hint_;  ///< hint of errors if FILE.meta.json states the number of points
    Columns columns_;
    Provenance provenance_;
    std::size_t set_ = 0;
    std::uint64_t left_ = 0;   ///< points of this set not yet read
    std::size_t numbers_ = 0;  ///< numbers read so far
    bool ended_ = false;
    std::string bytes_;
};

/// Names of the coordinates, and of the density column, if there is one.
std::vector<std::string> names_of(const Provenance& meta, std::size_t width) {
    const bool measured = !meta.density_column.empty();
    auto names = meta.columns.empty() ? coordinate_names(width - (measured ? 1 : 0)) : meta.columns;
    if (measured) names.push_back(meta.density_column);
    return names;
}

class JoinedStream final : public PointStream {
  public:
    JoinedStream(std::vector<std::string> paths, Opener open, const RunContext& run,
                 std::size_t first)
        : paths_(std::move(paths)), open_(std::move(open)), run_(run), at_(first) {
        part_ = open_(paths_[at_]);
        whole_ = part_->provenance();
        enter();
    }

    std::size_t dimension() const override { return part_->dimension(); }
    std::optional<std::size_t> sets() const override { return 1; }
    const Provenance& provenance() const override { return whole_; }

    bool next_set() override { return !std::exchange(begun_, true); }

    std::size_t read(std::span<double> rows) override {
        const std::size_t d = dimension();
        return static_cast<std::size_t>(through_parts(rows.size() / d, [&](std::uint64_t got) {
            const std::size_t count = part_->read(rows.subspan(got * d));
            number_words(rows.subspan(got * d, count * d));
            return count;
        }));
    }

    std::uint64_t skip(std::uint64_t count) override {
        return through_parts(count, [&](std::uint64_t got) { return part_->skip(count - got); });
    }

    std::vector<PointSet> read_all(const RunContext& run) override {
        auto sets = PointStream::read_all(run);
        for (PointSet& set : sets) set.provenance = whole();
        return sets;
    }

  private:
    /// Advances by `count` points, or to the end; returns by how many. step(done) does it in the
    /// current file, after the first `done` points.
    template <class Step>
    std::uint64_t through_parts(std::uint64_t count, const Step& step) {
        std::uint64_t got = 0;
        while (got < count && !ended_) {
            const std::uint64_t more = step(got);
            got += more;
            ended_ = more == 0 && !next_part();
        }
        count_ += got;
        return got;
    }

    void enter() {
        if (!part_->next_set())
            fail(ErrorKind::input, "{}: it holds no points", source_name(paths_[at_]));
        shards_ = shards_ && !part_->provenance().shard.empty();
    }

    /// Checks that the shard of a file is the one expected in its place. @throws Error(input)
    void require_shard(std::size_t file, const std::string& shard) const {
        const std::string of = shard.substr(shard.find('/') + 1);
        if (shard == fmt::format("{}/{}", file, of)) return;
        const bool more = file < parse_unsigned(of).value_or(0);
        fail(ErrorKind::input, "{}: it is shard {} of its set; expected {}",
             source_name(paths_[file]), shard,
             more ? fmt::format("shard {}/{} in this place", file, of)
                  : fmt::format("no more files, since all {} shards are there", of));
    }

    /// Maps the level names of the next file to indices: known names keep theirs, others get the
    /// next ones. Afterwards `meta` has the level names of all files.
    void join_words(Provenance& meta) {
        const auto names = names_of(meta, dimension());
        numbers_.assign(dimension(), {});
        for (auto& [column, words] : meta.levels) {
            const auto known = std::ranges::find(whole_.levels, column, &Levels::value_type::first);
            const auto c =
                static_cast<std::size_t>(std::ranges::find(names, column) - names.begin());
            if (known == whole_.levels.end() || words == known->second || c >= numbers_.size())
                continue;
            auto& all = known->second;
            std::vector<std::string> told;
            for (const std::string& word : words) {
                const auto at = std::ranges::find(all, word) - all.begin();
                if (static_cast<std::size_t>(at) == all.size()) all.push_back(word);
                numbers_[c].push_back(static_cast<double>(at));
                told.push_back(fmt::format("{} {}", at, word));
            }
            words = all;
            run_.notify(
                fmt::format("{}: the words of '{}' are numbered with those of the files before: {}",
                            source_name(paths_[at_]), column, shown(join(told, ", "))));
        }
    }

    void number_words(std::span<double> rows) const {
        for (std::size_t i = 0; i < rows.size() && !numbers_.empty(); ++i)
            if (const auto& numbers = numbers_[i % numbers_.size()];
                !numbers.empty() && std::isfinite(rows[i])) {
                if (!(rows[i] >= 0 && rows[i] < static_cast<double>(numbers.size())))
                    fail(ErrorKind::input, "{}: {} is not the number of a word",
                         source_name(paths_[at_]), rows[i]);
                rows[i] = numbers[static_cast<std::size_t>(rows[i])];
            }
    }

    /// Opens the next file; returns false after the last one.
    bool next_part() {
        if (part_->next_set())
            fail(ErrorKind::input,
                 "{}: it holds several sets; --concat joins files of one set each",
                 source_name(paths_[at_]));
        if (at_ + 1 == paths_.size()) {
            if (shards_ && !ends_set())
                run_.notify(
                    fmt::format("{}: it is the last file, but shard {}; the others of its "
                                "set are missing",
                                source_name(paths_[at_]), part_->provenance().shard));
            return false;
        }
        const std::string name = source_name(paths_[++at_]);
        auto part = open_(paths_[at_]);
        Provenance meta = part->provenance();
        shards_ = shards_ && !meta.shard.empty() && unsharded(meta) == unsharded(whole_);
        if (shards_) require_shard(at_ - 1, part_->provenance().shard);
        if (shards_) require_shard(at_, meta.shard);
        join_words(meta);
        require_alike({name, part->dimension(), meta},
                      {source_name(paths_.front()), dimension(), whole_});
        same_warps_ = same_warps_ && meta.warps == whole_.warps;
        part_ = std::move(part);
        enter();
        return true;
    }

    /// Whether this file is the last shard of a set with as many shards as there are files.
    [[nodiscard]] bool ends_set() const {
        return part_->provenance().shard == fmt::format("{}/{}", at_, paths_.size());
    }

    /// Provenance that all shards of a set have in common.
    static Provenance unsharded(Provenance meta) {
        const auto typed = meta.command.find(" --shard " + meta.shard);
        if (typed != std::string::npos) meta.command.erase(typed, 9 + meta.shard.size());
        meta.shard.clear();
        meta.count = 0;
        meta.named = false;
        return meta;
    }

    [[nodiscard]] Provenance whole() const {
        Provenance meta;
        meta.domain = whole_.domain;
        if (same_warps_) meta.warps = whole_.warps;
        meta.density_column = whole_.density_column;
        meta.columns = whole_.columns;
        meta.levels = whole_.levels;
        if (shards_ && ends_set()) meta = unsharded(whole_);
        meta.count = count_;
        meta.dimension = dimension();
        return meta;
    }

    std::vector<std::string> paths_;
    Opener open_;
    RunContext run_;
    std::size_t at_;
    std::unique_ptr<PointStream> part_;
    Provenance whole_;  ///< provenance of the first file, with the level names of all so far
    std::vector<std::vector<double>> numbers_;  ///< by coordinate: new indices of its levels
    std::uint64_t count_ = 0;
    bool begun_ = false;
    bool ended_ = false;
    bool same_warps_ = true;
    bool shards_ = true;  ///< all files so far are shards of one set
};

/// The last column of a file, for messages.
std::string told_column(const Provenance& meta) {
    return meta.density_column.empty() ? "a coordinate" : "a " + meta.density_column;
}

/// The words of a column, for messages.
std::string words_of(const Levels& levels, const std::string& column) {
    const auto found = std::ranges::find(levels, column, &Levels::value_type::first);
    return found == levels.end() ? "no words" : "the words " + shown(join(found->second, ", "));
}

}  // namespace

void require_alike(const JoinedFile& file, const JoinedFile& first) {
    const auto& [name, dimension, meta] = file;
    const Provenance& before = first.provenance;
    if (dimension != first.dimension)
        fail(ErrorKind::input, "{}: its points have {} coordinates; those before have {}", name,
             dimension, first.dimension);
    if (meta.domain != before.domain)
        fail(ErrorKind::input, "{}: its points are on {}; those before are on {}", name,
             meta.domain, before.domain);
    if (meta.density_column != before.density_column)
        fail_with_hint(ErrorKind::input, "--column picks the coordinates",
                       "{}: its last column is {}; that of {} is {}", name, told_column(meta),
                       first.name, told_column(before));
    const auto names = names_of(meta, dimension);
    const auto others = names_of(before, first.dimension);
    const auto [at, other] = std::ranges::mismatch(names, others);
    const auto has_names = [](const Provenance& of) { return of.named || !of.columns.empty(); };
    if (has_names(meta) && has_names(before) && at != names.end() && other != others.end())
        fail_with_hint(ErrorKind::input, "--column picks columns by name",
                       "{}: its column {} is {}; that of {} is {}", name, at - names.begin() + 1,
                       *at, first.name, *other);
    for (const std::string& column : names)
        if (const auto words = words_of(meta.levels, column),
            known = words_of(before.levels, column);
            words != known)
            fail_with_hint(ErrorKind::input, "--parameters FILE fixes the numbers of words",
                           "{}: its column {} has {}; that of {} has {}", name, column, words,
                           first.name, known);
}

std::unique_ptr<PointStream> join_points(std::vector<std::string> paths, Opener open,
                                         const RunContext& run, std::size_t first) {
    return std::make_unique<JoinedStream>(std::move(paths), std::move(open), run, first);
}

std::uint64_t PointStream::skip(std::uint64_t count) {
    const std::size_t d = dimension();
    const std::uint64_t step = std::max<std::uint64_t>(1, (std::uint64_t{1} << 16) / d);
    std::vector<double> rows(static_cast<std::size_t>(std::min(step, count)) * d);
    std::uint64_t done = 0;
    while (done < count) {
        const auto some = static_cast<std::size_t>(std::min(step, count - done));
        const std::size_t got = read(std::span(rows).first(some * d));
        done += got;
        if (got < some) break;
    }
    return done;
}

std::vector<PointSet> PointStream::read_all(const RunContext& run) {
    std::vector<PointSet> sets;
    const std::size_t d = dimension();
    const std::size_t step = std::max<std::size_t>(1, (std::size_t{1} << 18) / d) * d;
    while (next_set()) {
        const std::uint64_t all = count() ? d * *count() : ~std::uint64_t{0};
        std::vector<double> rows;
        if (count()) rows.reserve(static_cast<std::size_t>(std::min(all, std::uint64_t{1} << 28)));
        while (rows.size() < all) {
            const std::size_t before = rows.size();
            const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(step, all - before));
            run.need_memory(8 * static_cast<double>(before + more), "holding the points");
            rows.resize(before + more);
            const std::size_t got = d * read(std::span(rows).subspan(before));
            rows.resize(before + got);
            if (got < more) break;
        }
        sets.emplace_back(std::move(rows), d);
    }
    tell_origin(sets, provenance());
    return sets;
}

std::unique_ptr<PointStream> stream_raw(std::unique_ptr<Feed> feed, const RawShape& shape,
                                        const ReadOptions& options) {
    return std::make_unique<RawStream>(std::move(feed), shape, options);
}

void check_finite(std::span<const double> numbers, const RawShape& shape, const std::string& source,
                  std::size_t before) {
    const auto it = std::ranges::find_if_not(numbers, [](double x) { return std::isfinite(x); });
    if (it == numbers.end()) return;
    const auto index = before + static_cast<std::size_t>(it - numbers.begin());
    const std::string point =
        shape.width == 0 ? std::string() : fmt::format(" in point {}", index / shape.width);
    fail(ErrorKind::input, "{}: byte {}: {}{}; expected finite numbers", source,
         shape.offset + index * shape.type.size, *it, point);
}

std::size_t width_of_given(std::string_view option, const std::string& path) {
    require_file(option, path);
    const auto stream = open_points(path, {}, {});
    if (!stream->next_set()) fail(ErrorKind::input, "{}: 0 sets of points; expected one", path);
    return stream->dimension();
}

std::unique_ptr<PointStream> open_points(const std::string& path, const ReadOptions& options,
                                         const RunContext& run, const Format* format) {
    return open_points(std::make_unique<Feed>(path, run), path, options, run, format);
}

namespace {

/// Provenance in the file's sidecar, if wanted. Warns if the sidecar holds no provenance.
std::optional<CarriedMeta> usable_beside(const std::string& path, const ReadOptions& options,
                                         const RunContext& run) {
    try {
        if (options.meta_beside) return meta_beside(path, run);
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::input) throw;
        run.notify(std::string(e.what()) + "; it is not used");
    }
    return std::nullopt;
}

}  // namespace

std::unique_ptr<PointStream> open_points(std::unique_ptr<Feed> feed, const std::string& path,
                                         const ReadOptions& options, const RunContext& run,
                                         const Format* format) {
    ReadOptions inner = options;
    if (inner.source == "-") inner.source = path;
    inner.single = options.single || extension_is_single(path);
    const auto beside = usable_beside(path, options, run);
    const bool usable = beside && beside->begins(feed->front());
    if (usable && !format && !format_of_extension(path)) format = &format_named(beside->of);
    const Format& chosen = format != nullptr ? *format : format_for(path, feed->front());
    const bool raw_size = chosen.name == "bin" && !options.dimension;  // is to be read from beside
    if (beside && !usable && raw_size)
        fail_with_hint(ErrorKind::input,
                       "remove that file, or give --dimension, if it is of other points",
                       "{}: its bytes are not those that {} records", path, meta_path(path));
    if (usable) {
        inner.beside = &*beside;
        inner.single |= beside->single;
        if (raw_size) inner.dimension = beside->width;
    }
    std::unique_ptr<PointStream> points;
    if (chosen.stream && !feed->ends_in_front()) points = chosen.stream(feed, inner, run);
    if (!points) {
        const std::string whole = feed->ends_in_front() ? std::string() : feed->read_all();
        points = std::make_unique<HeldSets>(
            read_sets(feed->ends_in_front() ? feed->front() : whole, path, inner, run, format));
    }
    if (beside && (!usable || points->provenance().count == 0))
        run.notify(fmt::format("{}: not used, since {}", meta_path(path),
                               usable && beside->sets == 0
                                   ? "it does not state where its sets of different sizes end"
                                   : "it is of other points"));
    return points;
}

}  // namespace stipple::io
