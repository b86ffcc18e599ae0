// SPDX-License-Identifier: MIT
#include "pipeline/reproduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/decimal.hpp"
#include "io/formats/binary.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple {
namespace {

/// Rows as the numbers that come back when they were written and read.
void rows_as_read(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
                  std::string& out) {
    if (!layout.single && !layout.precision) return io::append_raw(out, numbers, false);
    std::vector<double> read(numbers.begin(), numbers.end());
    std::string text;
    for (double& number : read) {
        if (layout.single) number = io::to_single(number);
        if (!layout.precision) continue;
        text.clear();
        io::append_number(text, number, layout.precision);
        io::read_number(text.data(), text.data() + text.size(), number);
    }
    io::append_raw(out, read, false);
}

std::vector<double> numbers_in(std::string_view bytes) {
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// Numbers that are written so, but to a sink.
Target redirected(Target written, const Format& format, decltype(Target::sink) sink) {
    written.format = &format;
    written.sink = std::move(sink);
    return written;
}

/// All sets, in memory.
std::vector<PointSet> collect(const Making& making, const Target& written, const RunContext& run) {
    std::vector<std::vector<double>> sets;
    Layout layout;
    const Format format{
        .name = "memory",
        .summary = {},
        .source = {},
        .extensions = {},
        .traits = {},
        .head = [&](const Layout& of, std::string&) { layout = of; },
        .begin_set = [&](const Layout&, std::size_t, std::string&) { sets.emplace_back(); },
        .rows = rows_as_read};
    making(redirected(written, format, [&](std::string_view bytes) {
        const auto numbers = numbers_in(bytes);
        run.need_memory(8 * static_cast<double>(sets.back().size() + numbers.size()),
                        "the points before their last warp");
        sets.back().insert(sets.back().end(), numbers.begin(), numbers.end());
        return true;
    }));
    std::vector<PointSet> out;
    DomainPtr domain = unit_cube(layout.width());
    if (const std::string& text = layout.provenance.domain; !text.empty() && text != "unit-cube")
        domain = parse_domain(text, layout.width(), run);
    for (auto& rows : sets) {
        out.emplace_back(std::move(rows), layout.width());
        out.back().domain = domain;
        out.back().provenance = layout.provenance;
    }
    return out;
}

/// Made-again points on one side, the file's on the other.
class Comparer {
  public:
    Comparer(io::PointStream& file, bool unmarked) : file_(file), unmarked_(unmarked) {}

    /// Goes to the next set on both sides.
    void begin(const Layout& layout) {
        if (result_.sets == 0) result_.made = layout.provenance;
        const std::size_t width = layout.width();
        if (result_.sets == 0 && file_.dimension() != width)
            return end(fmt::format("its points have {} numbers; made again they have {}",
                                   file_.dimension(), width));
        if (result_.sets > 0 && unmarked_) {
            count_ = layout.counts.at(result_.sets++);
            at_ = 0;
            return;
        }
        if (result_.sets > 0) expect_end_of_set();
        if (done_) return;
        const bool there = file_.next_set();
        // A file of one set may be one of many that were written together.
        if (!there && result_.sets == 1) done_ = true;
        if (!there && result_.sets > 1)
            end(fmt::format("it has {} sets; made again there are {}", result_.sets,
                            layout.counts.size()));
        if (!there) return;
        count_ = layout.counts.at(result_.sets++);
        at_ = 0;
    }

    /// The next rows of the set that began. False: all is known.
    bool take(std::string_view bytes) {
        if (done_) return false;
        const auto made = numbers_in(bytes);
        const std::size_t width = file_.dimension();
        std::vector<double> found(made.size());
        const std::size_t got = file_.read(found) * width;
        const auto [m, f] = std::mismatch(
            made.begin(), made.begin() + static_cast<std::ptrdiff_t>(got), found.begin());
        const auto place = static_cast<std::size_t>(m - made.begin());
        result_.points += place / width;
        if (place < got) {
            result_.difference = {.set = result_.sets - 1,
                                  .point = at_ + place / width,
                                  .column = place % width,
                                  .found = *f,
                                  .made = *m};
            done_ = true;
            return false;
        }
        at_ += got / width;
        if (got < made.size())
            end(fmt::format("{} has {} points; made again it has {}", set_name(), at_, count_));
        return !done_;
    }

    Comparison finish() {
        if (!done_) expect_end_of_set();
        if (!done_ && file_.next_set())
            end(fmt::format("it has more sets than {}, which are made again", result_.sets));
        return std::move(result_);
    }

  private:
    void end(std::string mismatch) {
        result_.mismatch = std::move(mismatch);
        done_ = true;
    }

    [[nodiscard]] std::string set_name() const {
        return result_.sets > 1 ? fmt::format("set {}", result_.sets - 1) : "it";
    }

    void expect_end_of_set() {
        std::vector<double> row(file_.dimension());
        if (file_.read(row) > 0)
            end(fmt::format("{} has more than {} points, which are made again", set_name(), at_));
    }

    io::PointStream& file_;
    bool unmarked_;
    Comparison result_;
    std::uint64_t count_ = 0;  ///< points of this set, made again
    std::uint64_t at_ = 0;     ///< of these, compared
    bool done_ = false;
};

}  // namespace

Making making_of(Production production, const RunContext& run) {
    const auto job = std::make_shared<const Production>(std::move(production));
    return [job, run](const Target& target) { produce(*job, target, run); };
}

Making after_step(Making before, const std::string& step, std::uint64_t replications,
                  const RunContext& run) {
    if (step == cut_to_single || step.starts_with(cut_to_digits)) {
        Target cut{.single = step == cut_to_single};
        if (!cut.single) {
            const auto digits = parse_integer(std::string_view(step).substr(cut_to_digits.size()));
            cut.precision = static_cast<int>(std::clamp<std::int64_t>(digits.value_or(0), 0, 1000));
        }
        return [=](const Target& target) { write_sets(collect(before, cut, run), target, run); };
    }
    constexpr std::string_view inverse = "inverse ";
    const bool back = step.starts_with(inverse);
    Spec spec = parse_spec(std::string_view(step).substr(back ? inverse.size() : 0));
    if (scramble_named(spec.name) == nullptr)
        return [=](const Target& target) {
            write_warped(collect(before, {}, run), spec, back, target, run);
        };
    std::uint64_t seed = 1;
    for (const auto& [name, text] : spec.settings)
        if (name == scramble_seed.name) seed = parse_unsigned(text).value_or(1);
    std::erase_if(spec.settings, [](const auto& s) { return s.first == scramble_seed.name; });
    return [=](const Target& target) {
        write_scrambled(collect(before, {}, run), spec, seed, replications, target, run);
    };
}

Comparison compare(const Making& making, const Target& written, io::PointStream& file,
                   bool unmarked) {
    Comparer comparer(file, unmarked);
    const Format format{.name = "comparison",
                        .summary = {},
                        .source = {},
                        .extensions = {},
                        .traits = {},
                        .begin_set = [&](const Layout& layout, std::size_t,
                                         std::string&) { comparer.begin(layout); },
                        .rows = rows_as_read};
    making(
        redirected(written, format, [&](std::string_view bytes) { return comparer.take(bytes); }));
    return comparer.finish();
}

std::string bytes_of(const Making& making, Target target) {
    std::string bytes;
    target.sink = [&](std::string_view more) {
        bytes += more;
        return true;
    };
    making(target);
    return bytes;
}

}  // namespace stipple
