// SPDX-License-Identifier: MIT
#include "math/densities/strip_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/error.hpp"
#include "math/densities/expression.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_patches = std::size_t{1} << 22;
constexpr std::size_t most_in_strip = 8192;
constexpr std::size_t first_strips = 13;
constexpr std::size_t first_patches = 7;
constexpr std::size_t probes_a_side = 512;  // probes along each axis
constexpr std::size_t places_a_look = std::size_t{1} << 17;
constexpr int most_looks = 8;

/// A patch with samples of f at x_low, middle and x_high, at 0, 1/4, 1/2, 3/4 and 1 of its height.
struct SampledPatch {
    double low;
    double high;
    std::array<std::array<double, 5>, 3> f;
    /// Largest known error of the table between the samples; 0 unless it exceeds expected().
    double hidden = 0;
    bool gap = false;  ///< result of has_gap(); if true, the table gives the patch no mass

    [[nodiscard]] double at(double part) const { return low + part * (high - low); }

    /// Bilinear interpolation between the corners, at fractions s of the width and t of the height.
    [[nodiscard]] double bilinear(double s, double t) const {
        return (1 - s) * ((1 - t) * f[0][0] + t * f[0][4]) + s * ((1 - t) * f[2][0] + t * f[2][4]);
    }

    /// Largest difference of a sample from linear interpolation along y.
    [[nodiscard]] double bend() const {
        double worst = 0;
        for (const auto& line : f) worst = std::max(worst, largest_bend(line));
        return worst;
    }

    /// Largest difference of a sample from linear interpolation along x; at least `hidden`.
    [[nodiscard]] double slope() const {
        double worst = hidden;
        for (std::size_t k = 0; k < 5; ++k)
            worst = std::max(worst, std::abs(f[1][k] - 0.5 * (f[0][k] + f[2][k])));
        return worst;
    }

    [[nodiscard]] double top() const {
        double top = 0;
        for (const auto& line : f) top = std::max(top, std::ranges::max(line));
        return top;
    }

    /// Error from giving the patch no mass if it has a gap; otherwise 0.
    [[nodiscard]] double loss() const { return gap ? top() : 0; }

    /// Largest difference from the table that the samples suggest.
    [[nodiscard]] double expected() const {
        constexpr double rounding = 1e-12;
        return 2 * (bend() + slope()) + rounding * top();
    }

    [[nodiscard]] double mean() const { return 0.25 * (f[0][0] + f[0][4] + f[2][0] + f[2][4]); }
};

struct SampledStrip {
    double low;
    double high;
    std::vector<SampledPatch> patches = {};
    double error = 0;
    double mass = 0;

    [[nodiscard]] double width() const { return high - low; }
    [[nodiscard]] double area(const SampledPatch& patch) const {
        return (patch.high - patch.low) * width();
    }
};

/// A point at which f differs from the table by more than expected.
struct Surprise {
    std::array<double, 2> at;
    double f;
    double difference;
};

/// Clamps x below the upper end of its interval.
double within(double low, double high, double x) {
    return x < high ? x : std::nextafter(high, low);
}

class StripTabulator {
  public:
    StripTabulator(const std::string& what, const BlockFunction& f, const Box& box,
                   double tolerance, const RunContext& run)
        : what_(what), f_(f), box_(box), tolerance_(tolerance), run_(run) {}

    std::vector<Strip> tabulate() {
        probe_density();
        for (std::size_t i = 0; i < first_strips; ++i) insert(made(cut(i), cut(i + 1)), i);
        refine_until_nothing_surprises();
        std::ranges::sort(strips_, {}, &SampledStrip::low);
        std::vector<Strip> out;
        double mass = 0;
        for (const SampledStrip& strip : strips_) {
            out.push_back({strip.low, strip.high, {}});
            for (const SampledPatch& patch : strip.patches) {
                StripPatch shape{patch.low, patch.high, {}, {}};
                if (!patch.gap) {
                    shape.left = {patch.f[0][0], patch.f[0][4]};
                    shape.right = {patch.f[2][0], patch.f[2][4]};
                }
                mass += shape.left[0] + shape.left[1] + shape.right[0] + shape.right[1];
                out.back().patches.push_back(shape);
            }
        }
        if (!(mass > 0))
            fail(ErrorKind::usage, "{} is 0 at all points tried in {}", what_, format_box(box_));
        sum_anew();
        require_integral(what_, mass_);
        return out;
    }

  private:
    [[nodiscard]] double cut(std::size_t i) const {
        const double part = static_cast<double>(i) / first_strips;
        return i == first_strips ? box_.high[0] : box_.low[0] + part * box_.extent(0);
    }

    /// Sets values_ to f at points_, and checks that they are densities.
    void look_at_points() {
        values_.resize(points_.size() / 2);
        f_(points_, values_);
        for (std::size_t i = 0; i < values_.size(); ++i)
            require_density(what_, std::span(points_).subspan(2 * i, 2), values_[i]);
    }

    /// Evaluates f at the samples `which` (numbers from 0 to 4) on each of the patch's three lines.
    void sample(const SampledStrip& strip, SampledPatch& patch,
                std::initializer_list<std::size_t> which) {
        points_.clear();
        for (std::size_t line = 0; line < 3; ++line)
            for (const std::size_t k : which) {
                points_.push_back(line == 0   ? strip.low
                                  : line == 2 ? strip.high
                                              : strip.low + 0.5 * strip.width());
                points_.push_back(k == 4 ? patch.high : patch.at(0.25 * static_cast<double>(k)));
            }
        look_at_points();
        std::size_t i = 0;
        for (auto& line : patch.f)
            for (const std::size_t k : which) line[k] = values_[i++];
        patch.gap = has_gap(strip, patch);
    }

    /// Coordinate of a probe along an axis; probes form a grid all over the box.
    [[nodiscard]] double probe_at(std::size_t axis, std::size_t i) const {
        const double part = (static_cast<double>(i) + 0.5) / double{probes_a_side};
        return box_.low[axis] + part * box_.extent(axis);
    }

    /// First probe along an axis at or after `place`.
    [[nodiscard]] std::size_t first_probe_from(std::size_t axis, double place) const {
        const double at =
            (place - box_.low[axis]) / box_.extent(axis) * double{probes_a_side} - 0.5;
        return static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, double{probes_a_side}));
    }

    /// Sets seen_ to f at all probes.
    void probe_density() {
        for (std::size_t i = 0; i < probes_a_side; ++i) {
            run_.check_stop();
            points_.clear();
            for (std::size_t j = 0; j < probes_a_side; ++j) {
                points_.push_back(probe_at(0, i));
                points_.push_back(probe_at(1, j));
            }
            look_at_points();
            seen_.insert(seen_.end(), values_.begin(), values_.end());
        }
    }

    void refine_as_asked() {
        while (error_ > tolerance_ * mass_) split_worst();
    }

    /// Samples f at new points until they show hardly any mass that the table misses.
    void refine_until_nothing_surprises() {
        refine_as_asked();
        for (int look = 0;; ++look) {
            const std::vector<Surprise> met = surprises(look);
            double missed = 0;
            for (const Surprise& one : met) missed += one.difference;
            missed *= box_.extent(0) * box_.extent(1) / double{places_a_look};
            const bool little = missed <= 0.25 * tolerance_ * mass_;
            note(met);
            refine_as_asked();
            if (little) return;
            if (look == most_looks)
                fail(ErrorKind::limit,
                     "{} has features too narrow for a table: it is {:.4g} at {}, which values "
                     "nearby do not suggest",
                     what_, met[0].f, place_text(met[0].at));
        }
    }

    /// Compares f with the table at 2^17 points that are not probes: part `look` of a Kronecker
    /// sequence. Returns those where the difference exceeds the patch's expected().
    std::vector<Surprise> surprises(int look) {
        constexpr std::array<double, 2> step{0.7548776662466927, 0.5698402909980532};
        constexpr std::size_t at_once = 4096;
        sort_strips();
        std::vector<Surprise> met;
        for (std::size_t first = 0; first < places_a_look; first += at_once) {
            run_.check_stop();
            points_.clear();
            for (std::size_t i = first; i < first + at_once; ++i)
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    const auto index =
                        static_cast<double>(places_a_look * static_cast<std::size_t>(look) + i);
                    const double turns = 0.5 + step[axis] * index;
                    points_.push_back(box_.low[axis] +
                                      (turns - std::floor(turns)) * box_.extent(axis));
                }
            look_at_points();
            for (std::size_t i = 0; i < at_once; ++i) {
                Surprise here{{points_[2 * i], points_[2 * i + 1]}, values_[i], 0};
                const auto [strip, patch] = patch_of(here.at);
                here.difference = difference(*strip, *patch, here);
                if (here.difference > patch->expected()) met.push_back(here);
            }
        }
        return met;
    }

    /// Sorts the strips, and rebuilds the queue of their errors.
    void sort_strips() {
        std::ranges::sort(strips_, {}, &SampledStrip::low);
        worst_ = {};
        for (std::size_t i = 0; i < strips_.size(); ++i) worst_.emplace(strips_[i].error, i);
    }

    /// Strip and patch that contain a point; strips must be sorted.
    std::pair<SampledStrip*, SampledPatch*> patch_of(const std::array<double, 2>& at) {
        const auto strip = std::ranges::upper_bound(strips_, at[0], {}, &SampledStrip::low) - 1;
        const auto patch =
            std::ranges::upper_bound(strip->patches, at[1], {}, &SampledPatch::low) - 1;
        return {&*strip, &*patch};
    }

    /// Difference of f from the table at a point.
    static double difference(const SampledStrip& strip, const SampledPatch& patch,
                             const Surprise& place) {
        return std::abs(place.f -
                        patch.bilinear((place.at[0] - strip.low) / strip.width(),
                                       (place.at[1] - patch.low) / (patch.high - patch.low)));
    }

    /// Updates `hidden` of the patches that contain the points `met`, and keeps these points for
    /// strips made later.
    void note(const std::vector<Surprise>& met) {
        for (const Surprise& one : met) {
            SampledPatch* const patch = patch_of(one.at).second;
            patch->hidden = std::max(patch->hidden, one.difference);
        }
        met_.insert(met_.end(), met.begin(), met.end());
        std::ranges::sort(met_, {}, &Surprise::at);
        for (SampledStrip& strip : strips_) put_error(strip);
        sort_strips();
        sum_anew();
    }

    /// Sets `hidden` to the largest known error of a patch between its samples, if it exceeds the
    /// error that the samples suggest.
    void note_hidden_error(const SampledStrip& strip, SampledPatch& patch) const {
        const double worst = std::max(
            {probe_error(strip, patch), parent_error(strip, patch), met_error(strip, patch)});
        if (worst > patch.expected()) patch.hidden = worst;
    }

    /// Largest error of the patch at those points of met_ that it contains.
    [[nodiscard]] double met_error(const SampledStrip& strip, const SampledPatch& patch) const {
        double worst = 0;
        const std::array<double, 2> low{strip.low, -std::numeric_limits<double>::infinity()};
        for (auto p = std::ranges::lower_bound(met_, low, {}, &Surprise::at);
             p != met_.end() && p->at[0] < strip.high; ++p)
            if (p->at[1] >= patch.low && p->at[1] < patch.high)
                worst = std::max(worst, difference(strip, patch, *p));
        return worst;
    }

    /// Largest error of the patch at the probes in it.
    [[nodiscard]] double probe_error(const SampledStrip& strip, const SampledPatch& patch) const {
        double worst = 0;
        const std::size_t last_x = first_probe_from(0, strip.high);
        const std::size_t last_y = first_probe_from(1, patch.high);
        for (std::size_t i = first_probe_from(0, strip.low); i < last_x; ++i) {
            const double s = (probe_at(0, i) - strip.low) / strip.width();
            for (std::size_t j = first_probe_from(1, patch.low); j < last_y; ++j) {
                const double t = (probe_at(1, j) - patch.low) / (patch.high - patch.low);
                worst =
                    std::max(worst, std::abs(seen_[i * probes_a_side + j] - patch.bilinear(s, t)));
            }
        }
        return worst;
    }

    /// Largest error of the patch on its two sides, at samples of the parent strip.
    [[nodiscard]] double parent_error(const SampledStrip& strip, const SampledPatch& patch) const {
        if (parent_ == nullptr) return 0;
        // The parent's line at the strip's left side.
        const std::size_t left = strip.low == parent_->low ? 0 : 1;
        const auto behind =
            std::ranges::upper_bound(parent_->patches, patch.low, {}, &SampledPatch::high);
        double worst = 0;
        for (auto p = behind; p != parent_->patches.end() && p->low < patch.high; ++p)
            for (std::size_t k = 0; k < 5; ++k) {
                const double y = p->at(0.25 * static_cast<double>(k));
                if (!(y >= patch.low && y <= patch.high)) continue;
                const double t = (y - patch.low) / (patch.high - patch.low);
                worst = std::max({worst, std::abs(p->f[left][k] - patch.bilinear(0, t)),
                                  std::abs(p->f[left + 1][k] - patch.bilinear(1, t))});
            }
        return worst;
    }

    SampledStrip made(double low, double high) {
        SampledStrip strip{low, high};
        for (std::size_t j = 0; j < first_patches; ++j) {
            const auto y = [&](std::size_t i) {
                const double part = static_cast<double>(i) / first_patches;
                return i == first_patches ? box_.high[1] : box_.low[1] + part * box_.extent(1);
            };
            SampledPatch patch{.low = y(j), .high = y(j + 1), .f = {}};
            sample(strip, patch, {0, 1, 2, 3, 4});
            note_hidden_error(strip, patch);
            strip.patches.push_back(patch);
        }
        refine(strip);
        return strip;
    }

    /// Stores a strip at an index, or appends it.
    void insert(SampledStrip strip, std::size_t index) {
        error_ += strip.error;
        mass_ += strip.mass;
        count_ += strip.patches.size();
        worst_.emplace(strip.error, index);
        if (index == strips_.size())
            strips_.push_back(std::move(strip));
        else
            strips_[index] = std::move(strip);
    }

    /// Halves patches until their bend along y is small compared with their change along x, or
    /// compared with the tolerance.
    void refine(SampledStrip& strip) {
        std::priority_queue<std::pair<double, std::size_t>> worst;
        double bend = 0;
        double slope = 0;
        double mass = 0;
        const auto account = [&](std::size_t j, double sign) {
            const SampledPatch& patch = strip.patches[j];
            const double area = strip.area(patch);
            bend += sign * area * bend_of(strip, patch);
            slope += sign * area * patch.slope();
            mass += sign * area * patch.mean();
            if (sign > 0) worst.emplace(area * bend_of(strip, patch), j);
        };
        for (std::size_t j = 0; j < strip.patches.size(); ++j) account(j, 1);
        const double share = strip.width() / box_.extent(0);
        while (strip.patches.size() < most_in_strip) {
            const double goal = 0.25 * tolerance_ * std::max(mass_ * share, mass);
            if (!(bend > std::max(goal, 0.5 * slope)) || worst.empty()) break;
            const auto [error, j] = worst.top();
            worst.pop();
            if (error <= 0 || !halve(strip, j, account)) break;
        }
        put_error(strip);
        strip.mass = std::max(mass, 0.0);
        std::ranges::sort(strip.patches, {}, &SampledPatch::low);
    }

    /// Error that halving along y may reduce. In a patch that is tall for its width, this includes
    /// hidden errors, and gaps that do not show along x. In a flat one it does not: in the even
    /// flatter halves, no known point might show the feature any more.
    [[nodiscard]] double bend_of(const SampledStrip& strip, const SampledPatch& patch) const {
        const bool tall =
            (patch.high - patch.low) * box_.extent(0) > strip.width() * box_.extent(1);
        if (!tall) return patch.bend();
        const double loss = patch.loss();
        return std::max({patch.bend(), patch.hidden, loss > 2 * patch.slope() ? loss : 0});
    }

    void put_error(SampledStrip& strip) const {
        strip.error = 0;
        for (const SampledPatch& patch : strip.patches)
            strip.error +=
                strip.area(patch) * std::max(bend_of(strip, patch) + patch.slope(), patch.loss());
    }

    template <class Account>
    bool halve(SampledStrip& strip, std::size_t j, const Account& account) {
        const SampledPatch whole = strip.patches[j];
        const double middle = whole.at(0.5);
        if (!(whole.low < middle && middle < whole.high)) return false;
        account(j, -1);
        SampledPatch lower{.low = whole.low, .high = middle, .f = {}};
        SampledPatch upper{.low = middle, .high = whole.high, .f = {}};
        for (std::size_t line = 0; line < 3; ++line) {
            lower.f[line] = {whole.f[line][0], 0, whole.f[line][1], 0, whole.f[line][2]};
            upper.f[line] = {whole.f[line][2], 0, whole.f[line][3], 0, whole.f[line][4]};
        }
        sample(strip, lower, {1, 3});
        sample(strip, upper, {1, 3});
        note_hidden_error(strip, lower);
        note_hidden_error(strip, upper);
        strip.patches[j] = lower;
        strip.patches.push_back(upper);
        account(j, 1);
        account(strip.patches.size() - 1, 1);
        return true;
    }

    void split_worst() {
        run_.check_stop();
        const auto [error, index] = worst_.top();
        worst_.pop();
        const SampledStrip strip = std::move(strips_[index]);
        const double middle = strip.low + 0.5 * strip.width();
        if (!(strip.low < middle && middle < strip.high) || count_ > most_patches) refuse(strip);
        if (count_ > planned_) {
            planned_ = count_ + count_ / 4 + 4096;
            constexpr double bytes_a_patch = 300;  // in this table and the final one together
            run_.need_memory(bytes_a_patch * static_cast<double>(planned_),
                             "the table of " + what_);
        }
        error_ -= strip.error;
        mass_ -= strip.mass;
        count_ -= strip.patches.size();
        parent_ = &strip;
        insert(made(strip.low, middle), index);
        insert(made(middle, strip.high), strips_.size());
        parent_ = nullptr;
        if (strips_.size() % 1024 == 0) sum_anew();
    }

    void sum_anew() {
        error_ = 0;
        mass_ = 0;
        for (const SampledStrip& strip : strips_) {
            error_ += strip.error;
            mass_ += strip.mass;
        }
    }

    [[noreturn]] void refuse(const SampledStrip& strip) const {
        fail_with_hint(
            ErrorKind::limit, "raise --tolerance",
            "{}: --tolerance {} cannot be reached; the error is {:.2g}, largest near x = {}", what_,
            tolerance_, error_ / mass_, strip.low);
    }

    /// True if f is 0 at a sample inside the patch, but not at all samples. A 0 on an edge counts
    /// only if f is also 0 at a point close to an edge.
    bool has_gap(const SampledStrip& strip, const SampledPatch& patch) {
        if (patch.top() == 0) return false;
        if (patch.f[1][1] == 0 || patch.f[1][2] == 0 || patch.f[1][3] == 0) return true;
        const auto has_zero = [](const auto& line) { return std::ranges::min(line) == 0; };
        if (std::ranges::none_of(patch.f, has_zero)) return false;
        constexpr double near = 0x1p-12;
        points_.clear();
        for (const double s : {near, 0.5, 1 - near})
            for (const double t : {near, 0.5, 1 - near}) {
                points_.push_back(strip.low + s * strip.width());
                points_.push_back(patch.at(t));
            }
        look_at_points();
        return has_zero(values_);
    }

    const std::string& what_;
    const BlockFunction& f_;
    const Box& box_;
    double tolerance_;
    const RunContext& run_;
    std::vector<SampledStrip> strips_;
    std::priority_queue<std::pair<double, std::size_t>> worst_;
    std::vector<double> points_;
    std::vector<double> values_;
    std::vector<double> seen_;              ///< values at the probes
    std::vector<Surprise> met_;             ///< results of surprises(), sorted by x
    const SampledStrip* parent_ = nullptr;  ///< the strip being halved
    std::size_t count_ = 0;
    std::size_t planned_ = 0;  ///< number of patches for which memory was checked
    double error_ = 0;
    double mass_ = 0;
};

}  // namespace

std::vector<Strip> tabulate_strips(const std::string& what, const BlockFunction& f, const Box& box,
                                   double tolerance, const RunContext& run) {
    return StripTabulator(what, f, box, tolerance, run).tabulate();
}

StripTable::StripTable(const std::vector<Strip>& strips) {
    double top = 0;
    std::size_t count = 0;
    for (const Strip& strip : strips) count += strip.patches.size();
    patches_.reserve(count);
    for (const Strip& strip : strips)
        for (const StripPatch& patch : strip.patches)
            top = std::max({top, patch.left[0], patch.left[1], patch.right[0], patch.right[1]});
    std::vector<double> sums;
    double sum = 0;
    for (const Strip& strip : strips) {
        Column column{strip.x_low, strip.x_high, patches_.size(), 0, 0};
        for (StripPatch shape : strip.patches) {
            // Scales the largest density to 1, so that squares are finite.
            for (auto* side : {&shape.left, &shape.right})
                for (double& density : *side) density /= top;
            const double height = 0.5 * (shape.y_high - shape.y_low);
            column.left += height * (shape.left[0] + shape.left[1]);
            column.right += height * (shape.right[0] + shape.right[1]);
            patches_.push_back({shape, column.left, column.right});
        }
        sums.push_back(sum += 0.5 * (column.left + column.right) * (column.x_high - column.x_low));
        columns_.push_back(column);
    }
    columns_.push_back({0, 0, patches_.size(), 0, 0});
    masses_ = GuideTable(std::move(sums), strips.size());
}

std::array<double, 2> StripTable::quantile(double u, double v) const {
    const double wanted = u * masses_.total();
    const std::size_t i = masses_.at(wanted);
    const Column& column = columns_[i];
    const double share = width_share(column.left, column.right,
                                     std::min((wanted - masses_.begin(i)) / masses_.width(i), 1.0));
    const double x =
        within(column.x_low, column.x_high, column.x_low + share * (column.x_high - column.x_low));
    // Recomputed from the rounded x, as fraction() does, so that the two are inverse functions.
    const double t = column.side((x - column.x_low) / (column.x_high - column.x_low));

    const auto patches = patches_of(i);
    const double total = patches.back().sum_at(t);
    const double mass = std::min(v * total, std::nextafter(total, 0.0));
    // Binary search without branches, which would be mispredicted half of the time.
    const Patch* above = patches.data();
    for (std::size_t left = patches.size(); left > 1;) {
        const std::size_t half = left / 2;
        above += above[half - 1].sum_at(t) <= mass ? half : 0;
        left -= half;
    }
    const double below = above == patches.data() ? 0 : (above - 1)->sum_at(t);
    const StripPatch& shape = above->shape;
    const auto [low, high] = shape.ends(t);
    const double part =
        width_share(low, high, std::min((mass - below) / (above->sum_at(t) - below), 1.0));
    return {x,
            within(shape.y_low, shape.y_high, shape.y_low + part * (shape.y_high - shape.y_low))};
}

std::pair<std::size_t, double> StripTable::column_at(double x) const {
    const auto columns = std::span(columns_).first(columns_.size() - 1);
    const auto next = std::ranges::upper_bound(columns, x, {}, &Column::x_low);
    const auto i =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - columns.begin(), 1) - 1);
    const Column& column = columns_[i];
    return {i, std::clamp((x - column.x_low) / (column.x_high - column.x_low), 0.0, 1.0)};
}

std::size_t StripTable::patch_at(std::span<const Patch> patches, double y) {
    const auto above = std::ranges::upper_bound(
        patches, y, {}, [](const Patch& patch) { return patch.shape.y_low; });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - patches.begin(), 1) - 1);
}

std::array<double, 2> StripTable::fraction(double x, double y) const {
    const auto [i, width] = column_at(x);
    const Column& column = columns_[i];
    const double part = mass_share(column.left, column.right, width);
    const double u = (masses_.begin(i) + part * masses_.width(i)) / masses_.total();
    const double t = column.side(width);

    const auto patches = patches_of(i);
    const std::size_t at = patch_at(patches, y);
    const double below = at == 0 ? 0 : patches[at - 1].sum_at(t);
    const StripPatch& shape = patches[at].shape;
    const auto [low, high] = shape.ends(t);
    const double share = mass_share(
        low, high, std::clamp((y - shape.y_low) / (shape.y_high - shape.y_low), 0.0, 1.0));
    const double total = patches.back().sum_at(t);
    const double v = total > 0 ? (below + share * (patches[at].sum_at(t) - below)) / total : 0;
    return {std::min(u, 1.0), std::min(v, 1.0)};
}

double StripTable::density(double x, double y) const {
    const auto [i, t] = column_at(x);
    const auto patches = patches_of(i);
    const StripPatch& shape = patches[patch_at(patches, y)].shape;
    const auto [low, high] = shape.ends(t);
    const double share = std::clamp((y - shape.y_low) / (shape.y_high - shape.y_low), 0.0, 1.0);
    return ((1 - share) * low + share * high) / masses_.total();
}

}  // namespace stipple
