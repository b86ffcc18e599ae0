// SPDX-License-Identifier: MIT
#include "study/unit_runner.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "study/time_limit.hpp"

namespace stipple {
namespace {

/// Why there is no result.
struct Failure {
    std::string reason;
    bool limit = false;  ///< of time or memory
    bool memory = false;
};

/// One line, whatever the message was.
std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

/// Runs work within the limit of time. Nothing: it went well. @throws Error(cancelled)
std::optional<Failure> failure_of(const RunContext& run, std::optional<double> limit,
                                  const std::function<void(const RunContext&)>& work) {
    try {
        if (over_time(run, limit, work))
            return Failure{fmt::format("time limit: not done after {} s", *limit), true};
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        const bool limited = e.kind() == ErrorKind::limit;
        return Failure{one_line(fmt::format("{}{}", limited ? "limit: " : "", e.what())), limited,
                       limited && e.hint().find("--max-memory") != std::string::npos};
    } catch (const std::bad_alloc&) {
        return Failure{"limit: out of memory", true, true};
    } catch (const std::exception& e) {
        return Failure{one_line(fmt::format("internal error: {}", e.what()))};
    }
    return std::nullopt;
}

std::size_t leading_scrambles(const std::vector<Spec>& warps) {
    const auto it = std::ranges::find_if(
        warps, [](const Spec& spec) { return scramble_named(spec.name) == nullptr; });
    return static_cast<std::size_t>(it - warps.begin());
}

/// Some points of the unit cube, apart from each other: odd multiples of those of sqrt(2),
/// modulo 1.
std::vector<double> some_points(std::size_t dimension, std::size_t count = 64) {
    constexpr double step = 0.41421356237309515;
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < dimension; ++k) {
            const double turns = static_cast<double>((i + 1) * (2 * k + 1)) * step;
            rows.push_back(turns - std::floor(turns));
        }
    return rows;
}

RunContext silent(RunContext run) {
    run.progress = {};
    run.warn = {};
    return run;
}

PointSet cube_of(std::size_t dimension, std::size_t count = 64) {
    return {some_points(dimension, count), dimension};
}

PointSet image_of(const WarpChain& chain, std::size_t count = 64) {
    PointSet image(chain.forward(some_points(chain.dimension_in(), count)), chain.dimension_out());
    image.domain = chain.domain();
    return image;
}

/// What a measure has against such points, if it says so within so many seconds.
std::optional<Error> refusal(const Chosen<Analyzer>& measure, const PointSet& points,
                             const RunContext& run, std::optional<double> limit = {}) {
    try {
        over_time(silent(run), limit, [&](const RunContext& limited) {
            (void)analyze(*measure.unit, points, measure.values, limited);
        });
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        return e;
    } catch (const std::exception&) {
        return std::nullopt;  // the rows will say what is wrong
    }
    return std::nullopt;
}

bool takes_points(const Chosen<Analyzer>& measure, const PointSet& points, const RunContext& run) {
    const auto error = refusal(measure, points, run);
    return !error || (error->kind() != ErrorKind::input && error->kind() != ErrorKind::usage);
}

/// Whether a measure looks at what the warps made: where it can, and where it cannot take points of
/// the cube, either.
bool takes(const Chosen<Analyzer>& measure, const WarpChain& chain, const RunContext& run) {
    const std::string spec = chain.domain()->spec();
    if (spec == "unit-cube") return true;
    if (measure.unit->traits.unit_cube) return false;
    if (measure.unit->traits.boxed && !spec.starts_with("box")) return false;
    return takes_points(measure, image_of(chain), run) ||
           !takes_points(measure, cube_of(chain.dimension_in()), run);
}

/// One set of points: as it is measured, and before its warps.
class MadeSet {
  public:
    MadeSet(const Sweep& sweep, const Cell& cell, std::uint64_t seed, const RunContext& run) {
        const auto& generator = sweep.generators()[cell.generator];
        const double start = run.seconds ? run.seconds() : 0;
        failure_ = failure_of(run, sweep.request().time_limit, [&](const RunContext& limited) {
            make(sweep, generator, cell, seed, limited);
        });
        seconds_ = run.seconds ? run.seconds() - start : 0;
    }

    [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
    [[nodiscard]] double seconds() const { return seconds_; }
    [[nodiscard]] const PointSet& before() const { return *before_; }
    /// After the warps; nothing where there are none.
    [[nodiscard]] const std::optional<PointSet>& image() const { return image_; }

  private:
    void make(const Sweep& sweep, const Chosen<Generator>& generator, const Cell& cell,
              std::uint64_t seed, const RunContext& run) {
        const Request request{.count = cell.count, .dimension = cell.dimension, .seed = seed};
        before_ = make_points(*generator.unit, request, generator.values, run);
        before_->provenance.generator = generator.unit->name;
        const auto& warps = sweep.warps();
        if (warps.empty()) return;
        const std::size_t scrambles = leading_scrambles(warps);
        const ChainSet set{.seed = seed, .count = before_->count()};
        const std::size_t d = before_->dimension();
        const WarpChain first(std::span<const Spec>(warps).first(scrambles), d, set, run);
        if (!first.empty()) *before_ = image_of(*before_, first, run);
        if (scrambles == warps.size()) return;
        // What a scramble draws depends on seed and coordinates: cut in two, the chain is the same.
        const WarpChain rest(std::span<const Spec>(warps).subspan(scrambles), d, set, run);
        image_ = image_of(*before_, rest, run);
    }

    std::optional<PointSet> before_;
    std::optional<PointSet> image_;
    std::optional<Failure> failure_;
    double seconds_ = 0;
};

void add_numbers(const Report& report, const std::string& path, std::vector<KeyedNumber>& all,
                 std::vector<KeyedNumber>& lists) {
    for (const auto& [name, value, unit] : report.entries()) {
        const std::string key = path + name;
        if (const auto* flag = std::get_if<bool>(&value))
            all.push_back({key, *flag ? 1.0 : 0.0, true});
        if (const auto* whole = std::get_if<std::int64_t>(&value))
            all.push_back({key, static_cast<double>(*whole), true});
        if (const auto* number = std::get_if<double>(&value)) all.push_back({key, *number, false});
        if (const auto* group = std::get_if<Report>(&value))
            add_numbers(*group, key + ".", all, lists);
        const auto add_list = [&](const auto& list, bool whole) {
            for (std::size_t i = 0; i < list.size(); ++i)
                lists.push_back(
                    {fmt::format("{}[{}]", key, i), static_cast<double>(list[i]), whole});
        };
        if (const auto* curve = std::get_if<Report::Curve>(&value)) add_list(*curve, false);
        if (const auto* list = std::get_if<Report::Integers>(&value)) add_list(*list, true);
    }
}

/// Whether a part of a key between dots is meant: centered.value by value, by centered, by both;
/// mean[0] by mean.
bool is_meant(const std::string& key, const std::vector<std::string>& wanted) {
    return std::ranges::any_of(wanted, [&](const std::string& w) {
        for (auto at = key.find(w); at != std::string::npos; at = key.find(w, at + 1)) {
            const std::size_t end = at + w.size();
            const bool begins = at == 0 || key[at - 1] == '.';
            if (begins && (end == key.size() || key[end] == '.' || key[end] == '[')) return true;
        }
        return false;
    });
}

/// What a measure said of a set.
struct Measured {
    std::vector<KeyedNumber> numbers = {};
    std::string domain = {};
    std::optional<std::uint64_t> points = {};
    double seconds = 0;
    std::optional<Failure> failure = {};
};

Measured measured(const SweepRequest& request, const Chosen<Analyzer>& measure,
                  const PointSet& points, const RunContext& run) {
    Measured found;
    found.domain = points.domain->spec();
    found.points = points.count();
    const double start = run.seconds ? run.seconds() : 0;
    Report report;
    found.failure = failure_of(run, request.time_limit, [&](const RunContext& limited) {
        report = analyze(*measure.unit, points, measure.values, limited);
        limited.check_stop();  // what was cut short is no result
    });
    found.seconds = run.seconds ? run.seconds() - start : 0;
    if (found.failure) return found;
    found.numbers = numbers_of(report, request.keys, request.curves);
    if (found.numbers.empty())
        found.failure = Failure{fmt::format("none of its results is asked for; they are {}",
                                            join(report.keys(), ", "))};
    return found;
}

std::string lines_of(const StudyTable& table, StudyRow row, const MadeSet& set,
                     const Measured& found) {
    row.domain = found.domain;
    row.points = found.points;
    row.generate_seconds = set.seconds();
    row.seconds = found.seconds;
    if (found.failure) {
        row.status = "failed";
        row.reason = found.failure->reason;
        return table.line(row);
    }
    std::string text;
    for (const auto& [key, value, whole] : found.numbers) {
        row.key = key;
        row.value = value;
        row.whole = whole;
        text += table.line(row);
    }
    return text;
}

/// The sets of one piece of work: each is made once, and where the seed changes nothing, one is
/// all.
class PieceRunner {
  public:
    PieceRunner(const Sweep& sweep, const StudyTable& table, const UnitRunner& runner,
                bool shares_memory, const RunContext& run)
        : sweep_(sweep), table_(table), runner_(runner), shares_memory_(shares_memory), run_(run) {
        run_.progress = {};
        run_.warn = {};
    }

    void add(std::uint64_t index) {
        run_.check_stop();
        const Unit unit = sweep_.unit(index);
        const Cell cell = sweep_.cell(unit.cell);
        const std::uint64_t variant = sweep_.seeded(cell.generator) ? unit.seed_index : 0;
        if (!set_ || cell_ != unit.cell || variant_ != variant) {
            found_.clear();
            set_.reset();
            set_ = std::make_unique<MadeSet>(sweep_, cell,
                                             sweep_.request().first_seed + unit.seed_index, run_);
            cell_ = unit.cell;
            variant_ = variant;
            done_.seconds += set_->seconds();
        }
        const auto [it, fresh] = found_.try_emplace(unit.measure);
        if (fresh) {
            it->second = find(cell, unit.measure);
            done_.seconds += it->second.seconds;
        }
        keep(index, unit, it->second);
    }

    WorkDone take() { return std::move(done_); }

  private:
    Measured find(const Cell& cell, std::size_t number) {
        if (set_->failure()) return {.failure = set_->failure()};
        const auto& measure = sweep_.measures()[number];
        const auto& image = set_->image();
        if (!image) return measured(sweep_.request(), measure, set_->before(), run_);
        const bool after = runner_.takes_image(cell.dimension, number, run_);
        return measured(sweep_.request(), measure, after ? *image : set_->before(), run_);
    }

    void keep(std::uint64_t index, const Unit& unit, const Measured& found) {
        if (found.failure && found.failure->memory && shares_memory_) {
            done_.too_large.push_back({index, index + 1});
            return;
        }
        auto& segments = done_.segments;
        if (segments.empty() || segments.back().units.last != index)
            segments.push_back({{index, index}, {}});
        segments.back().units.last = index + 1;
        segments.back().lines.push_back(lines_of(table_, row_of(sweep_, unit), *set_, found));
    }

    const Sweep& sweep_;
    const StudyTable& table_;
    const UnitRunner& runner_;
    bool shares_memory_;
    RunContext run_;
    WorkDone done_;
    std::unique_ptr<MadeSet> set_;
    std::uint64_t cell_ = 0;
    std::uint64_t variant_ = 0;
    std::map<std::size_t, Measured> found_;
};

}  // namespace

std::vector<KeyedNumber> numbers_of(const Report& report, const std::vector<std::string>& keys,
                                    bool curves) {
    std::vector<KeyedNumber> numbers;
    std::vector<KeyedNumber> lists;
    add_numbers(report, "", numbers, lists);
    if (curves || !keys.empty() || numbers.empty())
        numbers.insert(numbers.end(), lists.begin(), lists.end());
    if (!keys.empty())
        std::erase_if(numbers, [&](const KeyedNumber& n) { return !is_meant(n.key, keys); });
    return numbers;
}

WorkDone UnitRunner::run(const std::vector<UnitRange>& ranges, const RunContext& run) const {
    PieceRunner runner(sweep_, table_, *this, run.max_memory < whole_memory_, run);
    for (const UnitRange& range : ranges)
        for (std::uint64_t unit = range.first; unit < range.last; ++unit) runner.add(unit);
    return runner.take();
}

std::span<const Spec> UnitRunner::warps_behind_scrambles() const {
    return std::span<const Spec>(sweep_.warps()).subspan(leading_scrambles(sweep_.warps()));
}

std::optional<Error> UnitRunner::refusal_of(std::size_t measure, std::size_t dimension,
                                            std::size_t count, const RunContext& run) const {
    constexpr double soon = 0.2;  // seconds
    PointSet points = cube_of(dimension, count);
    const auto warps = warps_behind_scrambles();
    try {
        if (!warps.empty() && takes_image(dimension, measure, run))
            points = image_of(WarpChain(warps, dimension, {}, run), count);
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        return std::nullopt;  // the rows will say what is wrong
    }
    auto error = refusal(sweep_.measures()[measure], points, run, soon);
    return error && error->kind() == ErrorKind::usage ? error : std::nullopt;
}

bool UnitRunner::takes_image(std::size_t dimension, std::size_t measure,
                             const RunContext& run) const {
    const std::lock_guard lock(mutex_);
    const auto [it, fresh] = takes_image_.try_emplace({dimension, measure}, true);
    const auto rest = warps_behind_scrambles();
    if (!fresh || rest.empty()) return it->second;
    try {
        it->second = takes(sweep_.measures()[measure], WarpChain(rest, dimension, {}, run), run);
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::cancelled) return true;  // the rows will say what is wrong
        takes_image_.erase(it);
        throw;
    }
    return it->second;
}

void UnitRunner::require_options(const RunContext& run) const {
    for (std::size_t m = 0; m < sweep_.measures().size(); ++m) {
        std::optional<Error> first;
        const auto refused = [&](std::size_t d) {
            const auto few = refusal_of(m, d, 64, run);
            if (few && !first) first = few;
            // What depends on the number of points is said with other numbers.
            const auto more = few ? refusal_of(m, d, 149, run) : std::nullopt;
            return more && std::string_view(more->what()) == few->what();
        };
        if (std::ranges::all_of(sweep_.request().dimensions, refused))
            throw Error(
                first->kind(),
                fmt::format("analyze: {}: {}", sweep_.measures()[m].unit->name, first->what()),
                first->hint());
    }
}

std::vector<std::string> UnitRunner::before_warps(const RunContext& run) const {
    std::vector<std::string> sentences;
    for (std::size_t m = 0; m < sweep_.measures().size(); ++m) {
        const auto looks_before = [&](std::size_t d) { return !takes_image(d, m, run); };
        if (std::ranges::any_of(sweep_.request().dimensions, looks_before))
            sentences.push_back(
                fmt::format("{} does not take points of {}: it measures them "
                            "before the warp, on the unit cube",
                            sweep_.measures()[m].spec, sweep_.warp_names()));
    }
    return sentences;
}

}  // namespace stipple
