// SPDX-License-Identifier: MIT
//
// Periodogram of n points with strengths s_j (1 unless given): their power at integer frequency
// vectors f,
//
//     P(f) = | sum_j s_j exp(-2 pi i f.x_j) |^2 / sum_j s_j^2,        f in {-F..F}^d,
//
// so that white noise has mean 1. If the domain is not a torus, points may be faded out towards the
// sides by --window hann, w(x) = prod_k sin^2(pi x_k) with the transform W(f):
//
//     P(f) = | sum_j s_j w(x_j) exp(-2 pi i f.x_j) - W(f) sum_j s_j |^2
//            / ((3/8)^d - W(f)^2) / sum_j s_j^2;
//
// the expectation of the sum for uniform points is subtracted, and the mean is 1 again, at every f.
// From the power, always without f = 0:
//
//     radial power       P_k = mean of P over the ring k - 1/2 <= |f| < k + 1/2,  k = 1..F
//     anisotropy         variance of P over the ring (mean squared deviation) / P_k^2, in dB;
//                        at least -100 dB, which rings of equal powers have, and rings without
//                        power above the tolerance. White noise has 0 dB, a mean of R sets of it
//                        -10 log10 R
//     effective Nyquist  R / 2, where R is the largest radius, at most F, for which the disk
//                        |f| < R has a mean power of at most 1/10; 0 if there is no such disk
//     oscillation        10 times the root of the mean of (P_k - 1)^2 over the frequency vectors of
//                        rings a..b. Ring a is the first with P_k >= 0.98 (if none has, the one
//                        with the most power), b = a + 5 n^(1/d), at most F. The oscillation is
//                        complete, and as published, only if P_a >= 0.98 and F >= a + 5 n^(1/d)
//     total variation    half the mean of |P_k - 1| over the frequency vectors of all rings: 0 for
//                        white noise, near 1 for a lattice; for other sets it decreases with F
//     exponent           a in P ~ f^a near 0: slope of log P_k against log k for k <= n^(1/d) / 4
//                        (but at least up to 4), with rings weighted by their numbers of vectors.
//                        Rings without power above the tolerance are left out
//
// Shape   points in [0, 1]^d or a box, d = 1, 2, 3, also in batches; strengths 0 or from 1e-100 to
//         1e100 in size; the 2-D power has row = f_1, column = f_0, -F..F.
// Units   cycles per unit length (for a box: per side). Published tables give the effective Nyquist
//         frequency divided by `regular_nyquist`, n^(1/d) / 2, which is that of a regular grid.
// Cost    O(n w^d + (4F)^d log F), see math/fourier/nufft.hpp; `direct` O(n (2F)^d). Sets of up to
//         2^20 points are kept until their number is known; of larger sets only a batch is kept.
// Promise the same for any number of threads, and whether points arrive at once or in batches. The
//         same in every run, except for last bits with --wisdom, where FFTW measures its plans.
// Beware  one set's power has a standard deviation of 100 % at every frequency: average sets. A
//         mean of anisotropies is not the anisotropy of the mean power; so the report contains the
//         power itself, and refine() recomputes everything else from its mean.
// Source  R. A. Ulichney, Proc. IEEE 76 (1988) 56-79, doi:10.1109/5.3288 (radial mean, anisotropy);
//         D. Heck, T. Schloemer, O. Deussen, ACM Trans. Graph. 32:3 (2013) 25 (effective Nyquist
//         frequency, oscillation; thresholds as in the authors' program psa).

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>

#include "analyzers/analyzer.hpp"
#include "analyzers/outside.hpp"
#include "analyzers/rings.hpp"
#include "core/error.hpp"
#include "core/machine/large_pages.hpp"
#include "core/machine/memory.hpp"
#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/fourier/grid_sum.hpp"
#include "math/fourier/nufft.hpp"
#include "math/fourier/transform.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple::analyzers::periodogram {
namespace {

constexpr Param<std::int64_t> max_frequency{
    .name = "max-frequency",
    .low = 1,
    .high = 1'000'000,
    .optional = true,
    .unit = "cycles a unit length",
    .help =
        "Largest frequency F: frequencies go from -F to F along each axis; default: twice n^(1/d), "
        "rounded up, but at least 16 and at most 65536, 1024 or 64 in 1, 2 or 3 dimensions. The "
        "oscillation needs 5 n^(1/d) above the frequency where power reaches 1, about 6.5 n^(1/d)"};

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "nufft",
    .choices = "nufft|direct",
    .help = "nufft: non-uniform fast Fourier transform; direct: plain sums, slow"};

constexpr Param<double> tolerance{.name = "tolerance",
                                  .fallback = 1e-9,
                                  .low = 0,
                                  .high = 1e-1,
                                  .help =
                                      "For method nufft: largest error of the complex sums, "
                                      "relative to sqrt(n); at least 1e-13, the limit of float64"};

constexpr Param<bool> normalize{
    .name = "normalize-frequency",
    .help = "Give frequencies divided by n^(1/d): cycles per mean distance between points"};

constexpr Param<Choice> window{
    .name = "window",
    .fallback = "none",
    .choices = "none|hann",
    .help =
        "none: for points on a torus; hann: for other points, which are faded out towards the "
        "sides by w = product of sin^2(pi x_k), with the transform W: power is |sum w e - n W|^2 / "
        "((3/8)^d - W^2) / n"};

constexpr Param<Text> weights{
    {.name = "weights",
     .unit = "column",
     .help = "Column with the weight w of each point, by name or number, which is not a "
             "coordinate: power is |sum w e|^2 / sum w^2"}};

constexpr Param<Path> wisdom{{.name = "wisdom",
                              .help = "File from which FFTW's measured plans are read and to which "
                                      "new ones are written; measuring takes seconds, once"}};

constexpr Param<Path> grid_file{
    {.name = "grid",
     .help = "Save the power to this .npy file: row = fy, column = fx, from -F to F; a line in 1 "
             "dimension, a cube [fz][fy][fx] in 3"}};

constexpr Param<Path> image_file{
    {.name = "image",
     .help = "Draw the power to this .png file, with frequency 0 (black) in the centre; the file's "
             "text gives the scale. In 3 dimensions the plane of --slice is drawn"}};

constexpr Param<Choice> image_scale{
    .name = "image-scale",
    .fallback = "ratio",
    .choices = "ratio|linear|log",
    .help =
        "How power becomes grey from 0 to 1; white noise is always middle grey. ratio: P / (1 + "
        "P); linear: P / 2, white from 2 on; log: -20 dB to 20 dB"};

constexpr Param<Choice> image_bits{
    .name = "image-bits", .fallback = "8", .choices = "8|16", .help = "Bits per pixel of --image"};

constexpr Param<std::int64_t> slice{
    .name = "slice",
    .fallback = 0,
    .low = -1'000'000,
    .high = 1'000'000,
    .unit = "cycles a unit length",
    .help = "fz of the plane that --image draws for points in 3 dimensions"};

constexpr double floor_of_floats = 1e-13;
constexpr std::uint64_t buffered_points = std::uint64_t{1} << 20;
/// Number of points for which the transform is planned if a set has more than buffered_points.
constexpr std::uint64_t most_points = std::uint64_t{1} << 30;

/// Sums of the weights and of their squares.
struct Strengths {
    double sum = 0;
    double squares = 0;
};

/// Sums the weights of points that arrive in blocks, possibly in several processes. The sums of
/// blocks are added by ScaledGridSum, so that their order does not matter.
class StrengthSums {
  public:
    void add(double strength) {
        if (points_ == block) close();
        block_.sum += strength;
        block_.squares += strength * strength;
        ++points_;
    }

    [[nodiscard]] Strengths total() {
        if (sum_.empty()) return block_;
        if (points_ > 0) close();
        Strengths all;
        sum_.copy_to({&all.sum, 1}, {});
        squares_.copy_to({&all.squares, 1}, {});
        return all;
    }

    void pack(Packer& to) {
        close();
        sum_.pack(to);
        squares_.pack(to);
    }
    /// Requires that a multiple of `block` points have been added to this object.
    void merge(Unpacker& from) {
        if (points_ > 0) close();
        sum_.merge(from);
        squares_.merge(from);
    }

  private:
    /// Number of points per block; a divisor of the number of points per grid.
    static constexpr std::uint64_t block = std::uint64_t{1} << 21;

    void close() {
        sum_.add({&block_.sum, 1}, std::abs(block_.sum), {});
        squares_.add({&block_.squares, 1}, block_.squares, {});
        block_ = {};
        points_ = 0;
    }

    Strengths block_;
    std::uint64_t points_ = 0;
    ScaledGridSum sum_;
    ScaledGridSum squares_;
};

/// Transform of the window on one axis, at the frequency f. Without a window it is 1 at 0; for hann
/// 1/2 at 0 and -1/4 at 1 and -1; at all other frequencies 0.
double window_transform(std::int64_t f, bool hann) {
    if (!hann) return f == 0 ? 1 : 0;
    return f == 0 ? 0.5 : std::abs(f) == 1 ? -0.25 : 0;
}

/// Power at all frequencies from the sums at half of them; P(-f) = P(f) holds exactly.
/// @param hann whether the points were weighted by the Hann window
Grid power_of(const FourierSums& sums, const Strengths& strengths, bool hann,
              const RunContext& run) {
    const std::size_t last = sums.max_frequency;
    const std::size_t width = 2 * last + 1;
    Grid power{.rows = sums.values.size() / (last + 1), .columns = width, .values = {}};
    fill_with_zeros(power.values, power.rows * width);
    const double squared = hann ? whole_power(0.375, sums.dimension) : 1;
    const double scale = 1 / (squared * strengths.squares);
    for (std::size_t row = 0; row < power.rows; ++row) {
        run.check_stop();
        const auto* half = sums.values.data() + row * (last + 1);
        double* values = power.values.data() + row * width;
        double* mirrored = power.values.data() + (power.rows - 1 - row) * width;
        for (std::size_t f = 0; f <= last; ++f)
            values[last + f] = mirrored[last - f] = std::norm(half[f]) * scale;
    }
    const auto line = static_cast<std::int64_t>(width);
    const auto reach = [&](std::size_t axis) { return hann && axis < sums.dimension ? 1 : 0; };
    for (std::int64_t f2 = -reach(2); f2 <= reach(2); ++f2)
        for (std::int64_t f1 = -reach(1); f1 <= reach(1); ++f1)
            for (std::int64_t f0 = -reach(0); f0 <= reach(0); ++f0) {
                if (f0 == 0 && f1 == 0 && f2 == 0) continue;
                double shape = 1;
                const std::int64_t f[] = {f0, f1, f2};
                for (std::size_t k = 0; k < sums.dimension; ++k)
                    shape *= window_transform(f[k], hann);
                const double of = std::norm(sums.at({f0, f1, f2}) - shape * strengths.sum);
                const std::int64_t middle = static_cast<std::int64_t>(power.values.size() / 2);
                const std::int64_t at = middle + (f2 * line + f1) * line + f0;
                power.values[static_cast<std::size_t>(at)] =
                    of / ((squared - shape * shape) * strengths.squares);
            }
    power.values[power.values.size() / 2] = strengths.sum * strengths.sum / strengths.squares;
    return power;
}

std::size_t default_frequency(std::uint64_t count, std::size_t dimension) {
    constexpr double most[] = {0, 65536, 1024, 64};
    const double twice =
        2 * real_power(static_cast<double>(count), 1 / static_cast<double>(dimension));
    // Rounding may leave a root such as 1000^(1/3) a little above its integer value.
    return static_cast<std::size_t>(std::clamp(std::ceil(twice - 1e-9), 16.0, most[dimension]));
}

double regular_nyquist(double count, std::size_t dimension) {
    return real_power(count, 1 / static_cast<double>(dimension)) / 2;
}

/// Adds all results that are derived from the power to the report.
void summarize(Report& report, const Grid& power, std::size_t sets, const Values& options,
               const RunContext& run) {
    const Rings rings = rings_of(power, run);
    const double regular = report.number("regular_nyquist");
    const double unit = options[normalize] ? 2 * regular : 1;
    const double error = report.number("tolerance");
    const double least = error * error;  // powers below this may be due to rounding
    const char* unit_name = options[normalize] ? "cycles a mean distance" : "cycles a unit length";
    Report::Curve frequency;
    Report::Curve anisotropy;
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        frequency.push_back(static_cast<double>(i + 1) / unit);
        anisotropy.push_back(anisotropy_db(rings.variance[i], rings.power[i], least));
    }
    Report radial;
    radial.add("frequency", std::move(frequency), unit_name);
    radial.add("power", rings.power);
    radial.add("anisotropy_db", std::move(anisotropy), "dB");
    radial.add("cells", rings.cells);
    report.add("radial", std::move(radial));
    const double expected = sets > 1 ? -decibels(static_cast<double>(sets)) : 0;
    report.add("expected_anisotropy_db", expected, "dB");
    const double nyquist = effective_nyquist(power, rings, run);
    report.add("effective_nyquist", nyquist / unit, unit_name);
    report.add("relative_nyquist", nyquist / regular);
    const Oscillation swings = oscillation(rings, regular);
    report.add("oscillation", swings.value);
    report.add("oscillation_complete", swings.complete);
    report.add("total_variation", total_variation(rings));
    drop(report, {"low_frequency_exponent"});
    if (const auto slope = low_frequency_exponent(rings, regular, least))
        report.add("low_frequency_exponent", *slope);
}

STIPPLE_WIDE bool all_inside(std::span<const double> coordinates) {
    std::int64_t outside = 0;
    for (const double x : coordinates) outside += x >= 0 && x <= 1 ? 0 : 1;
    return outside == 0;
}

/// Power spectrum of points that arrive in batches.
class Summation final : public SharedAccumulator {
  public:
    Summation(const Arrival& arrival, const Values& options, const RunContext& run)
        : domain_(arrival.domain),
          options_(options),
          d_(arrival.domain->dimension()),
          cube_(domain_->spec() == "unit-cube"),
          weighted_(options.given(weights)),
          hann_(options[window] == "hann"),
          numbers_(d_ + (weighted_ || hann_ ? 1 : 0)) {
        const std::string spec = domain_->spec();
        if (!cube_ && !spec.starts_with("box:"))
            fail(ErrorKind::input,
                 "periodogram requires points of the unit cube or a box; the domain is {}",
                 domain_->title());
        check_options();
        if (options.given(wisdom)) read_wisdom(options[wisdom]);
        announced_ = arrival.count.value_or(0);
        if (announced_ > buffered_points)
            begin(most_points, run);
        else
            buffer_.reserve(announced_ * numbers_);
    }

    void add(std::span<const double> rows, const RunContext& run) override {
        const std::vector<double> changed = changed_points(rows);
        const auto points = numbers_ == d_ && cube_ ? rows : std::span<const double>(changed);
        n_ += points.size() / numbers_;
        if (outside_.count > 0) return;
        const bool began = nufft_ || direct_;
        if (!began && n_ <= buffered_points) {
            buffer_.insert(buffer_.end(), points.begin(), points.end());
            return;
        }
        if (!began) begin(most_points, run);
        take(points, run);
    }

    Report report(const RunContext& whole) override {
        const RunContext run = fitting(whole);
        if (outside_.count > 0) refuse(outside_, n_, *domain_, outside_hint(*domain_));
        if (n_ < 2) fail(ErrorKind::input, "periodogram needs at least 2 points; there is {}", n_);
        if (!(strengths().squares > 0))
            fail(ErrorKind::input,
                 "--weights: all {} weights are 0; expected at least one other number", n_);
        if (all_equal_)
            run.notify(fmt::format(
                "all {} points are equal, so that they are in phase at every frequency", n_));
        if (!nufft_ && !direct_) begin(n_, run);
        return finished(run);
    }

    void begin_at(std::uint64_t first, std::span<const double>) override { at_ = first; }

    std::string state(const RunContext& run) override {
        Packer packer;
        packer.put(n_).put(all_equal_).put_all(first_);
        outside_.pack(packer);
        if (weighted_) strengths_.pack(packer);
        sum_->pack(packer, run);
        return packer.take();
    }

    void merge(std::string_view state, const RunContext& run) override {
        Unpacker from(state);
        n_ += from.take<std::uint64_t>();
        const bool equal = from.take<bool>();
        all_equal_ = from.take_all<double>() == first_ && all_equal_ && equal;
        outside_.add(Outside::unpacked(from));
        if (weighted_) strengths_.merge(from);
        sum_->merge(from, run);
    }

  private:
    /// Limits the threads for small sets, which are done before other threads have woken up.
    [[nodiscard]] RunContext fitting(const RunContext& run) const {
        if (nufft_ || direct_ || options_[method] == "direct") return run;
        const double values = fourier_sums_size(d_, frequency_for(std::max<std::uint64_t>(n_, 1)));
        return worth_threads(run, 5e-8 * static_cast<double>(n_) + 2e-8 * values);
    }

    void check_options() const {
        // The tolerance does not affect direct sums, which are as accurate as float64.
        if (options_[method] != "direct" && options_[tolerance] < floor_of_floats)
            fail(ErrorKind::usage,
                 "--tolerance: {} is below {}, the limit of float64; --method direct is as exact "
                 "as float64",
                 options_[tolerance], floor_of_floats);
        if (options_.given(image_file) && d_ == 1)
            fail(ErrorKind::usage, "--image: requires points of dimension 2 or 3; these have 1");
        if (options_.given(slice) && d_ != 3)
            fail(ErrorKind::usage, "--slice: requires points of dimension 3; these have {}", d_);
        for (const std::string_view name : {image_scale.name, image_bits.name, slice.name})
            if (options_.find(name).given && !options_.given(image_file))
                fail(ErrorKind::usage, "--{}: applies to --image, which is not given", name);
    }

    [[nodiscard]] std::size_t frequency_for(std::uint64_t count) const {
        return options_.given(max_frequency) ? static_cast<std::size_t>(options_[max_frequency])
                                             : default_frequency(count, d_);
    }

    /// Points mapped to the unit cube, each followed by its weight times the window there, unless
    /// all these products are 1. Empty if `rows` can be used unchanged.
    std::vector<double> changed_points(std::span<const double> rows) {
        std::vector<double> points;
        const std::size_t given = d_ + (weighted_ ? 1 : 0);
        const bool same = numbers_ == d_ && cube_;
        if (!same) points.reserve(rows.size() / given * numbers_);
        const bool noted = given == d_ && note_all(rows);
        for (std::size_t at = 0; at < rows.size() && !(same && noted); at += given) {
            const auto point = rows.subspan(at, d_);
            if (!noted) note(point, at_ + n_ + at / given);
            if (same) continue;
            const std::size_t begin = points.size();
            points.insert(points.end(), point.begin(), point.end());
            const std::span<double> here(points.data() + begin, d_);
            if (!cube_) domain_->to_cube(point, here);
            const double strength = weighted_ ? rows[at + d_] : 1;
            if (weighted_) {
                require_fitting(strength, at_ + n_ + at / given);
                strengths_.add(strength);
            }
            if (numbers_ > d_) points.push_back(strength * faded(here));
        }
        return points;
    }

    /// @throws Error(input) for a weight whose square might underflow or overflow the sum; the hint
    /// is to scale all weights, which does not change the power
    static void require_fitting(double strength, std::uint64_t index) {
        constexpr double least = 1e-100;
        constexpr double most = 1e100;
        const double size = std::abs(strength);
        if (size == 0 || (size >= least && size <= most)) return;
        fail_with_hint(ErrorKind::input,
                       "the power does not depend on the scale of the weights: divide all by the "
                       "largest, and replace those that are still too small by 0",
                       "--weights: the weight of point {} is {}; expected 0, or {} to {} in size",
                       index, format_number(strength), format_number(least), format_number(most));
    }

    /// Whether no point needs note(): all are in the unit cube, and earlier points differ.
    [[nodiscard]] bool note_all(std::span<const double> rows) const {
        return cube_ && !all_equal_ && all_inside(rows);
    }

    /// Checks whether the point is in the domain, and whether it differs from the first point.
    void note(std::span<const double> point, std::uint64_t index) {
        bool inside = true;
        for (const double x : point) inside = inside && x >= 0 && x <= 1;
        if (!cube_) inside = domain_->contains(point);
        if (!inside) outside_.add(index, point);
        if (!all_equal_) return;
        if (first_.empty()) first_.assign(point.begin(), point.end());
        all_equal_ = std::ranges::equal(point, first_);
    }

    [[nodiscard]] Strengths strengths() {
        const auto n = static_cast<double>(n_);
        return weighted_ ? strengths_.total() : Strengths{n, n};
    }

    /// Value of the window at a point of the cube.
    [[nodiscard]] double faded(std::span<const double> point) const {
        double product = 1;
        if (hann_)
            for (const double x : point) {
                const double s = cos_sin_turns(x / 2).sin;
                product *= s * s;
            }
        return product;
    }

    void begin(std::uint64_t count, const RunContext& run) {
        planned_ = count;
        frequency_ = frequency_for(count);
        const bool weighted = numbers_ > d_;
        const double sums = 16 * fourier_sums_size(d_, frequency_);
        const double kept = 8 * static_cast<double>(buffer_.size());
        const std::string cause = fmt::format("--max-frequency {}", frequency_);
        if (options_[method] == "direct") {
            run.need_memory(2 * sums + kept, cause);
            direct_ = std::make_unique<DirectSummation>(d_, frequency_, weighted);
        } else {
            nufft_.emplace(count, d_, frequency_, options_[tolerance], weighted);
            run.need_memory(std::max(2 * sums, nufft_->bytes()) + kept, cause);
            if (count == most_points) need_block_sums(run, cause);
            sum_ = std::make_unique<FourierSummation>(*nufft_);
        }
        take(buffer_, run);
        release(buffer_);
    }

    /// Requires the memory to sum a large set block by block, which takes a second grid.
    void need_block_sums(const RunContext& run, const std::string& cause) const {
        if (announced_ > 0 && announced_ <= FourierSummation::block_of(*nufft_)) return;
        run.need_memory(nufft_->bytes() + 16 * std::pow(static_cast<double>(nufft_->side()), d_),
                        cause);
    }

    void take(std::span<const double> points, const RunContext& run) {
        if (direct_)
            direct_->add(points, run);
        else
            sum_->add(points, run);
    }

    FourierSums sums(const RunContext& run) {
        if (direct_) return direct_->finish();
        const Planning planning = options_.given(wisdom) ? Planning::measured : Planning::estimated;
        FourierSums found = sum_->finish(planning, run);
        sum_.reset();
        return found;
    }

    Report finished(const RunContext& run) {
        const auto n = static_cast<double>(n_);
        Report report;
        report.add("max_frequency", static_cast<std::int64_t>(frequency_));
        report.add("regular_nyquist", regular_nyquist(n, d_), "cycles a unit length");
        const double worst =
            nufft_ ? std::max(options_[tolerance], n_ > planned_ ? nufft_->error(n) : 0) : 0;
        report.add("tolerance", std::max(worst, rounding_floor(n_)));
        Grid power = power_of(sums(run), strengths(), hann_, run);
        summarize(report, power, 1, options_, run);
        report.add("method", options_[method]);
        report.add("window", options_[window]);
        report.add("boundary", hann_ ? "faded out" : "torus");
        report.add("grid", std::move(power));
        return report;
    }

    DomainPtr domain_;
    Values options_;
    std::size_t d_;
    bool cube_;  ///< whether the domain is the unit cube
    bool weighted_;
    bool hann_;
    std::size_t numbers_;   ///< numbers per point in the sums: coordinates, and a strength if used
    std::uint64_t at_ = 0;  ///< index of the first point to arrive
    std::size_t frequency_ = 0;
    std::uint64_t n_ = 0;
    std::uint64_t announced_ = 0;  ///< announced number of points; 0 if unknown
    std::uint64_t planned_ = 0;    ///< number of points for which the transform was chosen
    std::vector<double> buffer_;
    std::vector<double> first_;  ///< first point of the set
    bool all_equal_ = true;
    StrengthSums strengths_;
    Outside outside_;
    std::optional<Nufft> nufft_;
    std::unique_ptr<FourierSummation> sum_;
    std::unique_ptr<DirectSummation> direct_;
};

/// Number of points summed on one grid, for Sharing::grain; a small set is not divided.
std::uint64_t grain(const Arrival& arrival, const Values& options) {
    if (options[method] == "direct")
        fail(ErrorKind::usage, "periodogram: ranks can share --method nufft only; use one process");
    if (arrival.count.value_or(0) <= buffered_points) return buffered_points;
    const std::size_t d = arrival.dimension();
    const std::size_t frequency = options.given(max_frequency)
                                      ? static_cast<std::size_t>(options[max_frequency])
                                      : default_frequency(most_points, d);
    return FourierSummation::block_of(Nufft(most_points, d, frequency, options[tolerance]));
}

void refine(Report& mean, std::size_t sets, const Values& options) {
    const auto* grid = mean.find("grid");
    if (grid == nullptr)
        fail_with_hint(ErrorKind::usage, "set one --max-frequency for all",
                       "--average: the spectra have different frequencies");
    const Grid power = std::get<Grid>(*grid);
    summarize(mean, power, sets, options, {});
}

/// Rejects spectra at different normalized frequencies, which cannot be averaged.
void combine(Report&, std::span<const Report> sets, const Values& options) {
    if (options[normalize] && !alike(sets, "regular_nyquist"))
        fail_with_hint(ErrorKind::usage,
                       "use the same number of points, or omit --normalize-frequency",
                       "--average: the sets differ in number of points, and therefore in their "
                       "normalised frequencies");
}

/// Uses the first set's frequencies for sets of other sizes, so that spectra can be averaged.
void follow(const Report& first, Values& options) {
    if (options.given(max_frequency)) return;
    options.put(max_frequency.name, static_cast<std::int64_t>(first.number("max_frequency")));
}

std::vector<ResultKey> results() {
    return {{"max_frequency", "F: frequencies go from -F to F"},
            {"regular_nyquist", "n^(1/d) / 2, the Nyquist frequency of a regular grid"},
            {"tolerance",
             "bound of the error of the complex sums, relative to sqrt(n); at least the rounding "
             "error if all points are in phase"},
            {"radial.frequency", "frequency k of each ring, k - 1/2 <= |f| < k + 1/2"},
            {"radial.power", "mean power over the ring; 1 for white noise"},
            {"radial.anisotropy_db",
             "variance over the ring / squared mean, in dB; at least -100, the value of rings with "
             "equal powers or powers below tolerance^2; for averaged sets, that of their mean "
             "power, without a standard error"},
            {"radial.cells", "number of frequency vectors in the ring"},
            {"expected_anisotropy_db",
             "anisotropy of white noise: 0 minus 10 log10 of the number of averaged sets"},
            higher({"effective_nyquist",
                    "half the largest radius R, at most F, for which the mean power over |f| < R "
                    "is at most 0.1; for averaged sets, that of their mean power, without a "
                    "standard error"}),
            {.key = "relative_nyquist",
             .help = "effective_nyquist / regular_nyquist, as in published tables; the program psa "
                     "computes a different one from its pair correlation",
             .better = Better::higher,
             .any_count = true},
            {.key = "oscillation",
             .help = "10 x root mean square of radial power - 1, weighted by cells, over 5 n^(1/d) "
                     "frequencies from where it first reaches 0.98, or up to F; for averaged sets, "
                     "that of their mean power, without a standard error, as for the next two",
             .better = Better::lower,
             .any_count = true},
            {"oscillation_complete",
             "whether F is large enough for all these frequencies; only then the oscillation is "
             "comparable with published ones",
             true, true_or_false},
            {"total_variation",
             "half the mean of |radial power - 1| over the rings, weighted by their cells: 0 for "
             "white noise; depends on F"},
            higher({"low_frequency_exponent",
                    "a in power ~ frequency^a near 0: slope of log radial power against log "
                    "frequency, weighted by cells, over the lowest n^(1/d) / 4 rings, at least 4, "
                    "that have power"}),
            {"method", "nufft or direct", true, "nufft|direct"},
            {"window", "none or hann", true, "none|hann"},
            {"boundary", "torus, or faded out by the window", true, "torus|faded out"}};
}

}  // namespace

Analyzer unit() {
    return {
        .name = "periodogram",
        .summary = "Power spectrum at integer frequencies, its radial mean and anisotropy",
        .source =
            "Ulichney 1988, doi:10.1109/5.3288; Heck, Schloemer, Deussen 2013, ACM TOG 32(3):25",
        .related = {"spectrum", "fft", "fourier", "power-spectrum", "psd", "structure-factor",
                    "radial", "radial-mean"},
        .traits = {.min_dimension = 1, .max_dimension = 3, .unit_cube = false, .boxed = true},
        .options = Schema(max_frequency, method, tolerance, normalize, window, weights, grid_file,
                          image_file, image_scale, image_bits, slice, wisdom),
        .results = results(),
        .curves = {{"radial.power", "radial.frequency", "1", "radial power", "", false,
                    "Radial power over frequency; white noise has 1"},
                   {"radial.anisotropy_db", "radial.frequency", "", "anisotropy (dB)"}},
        .part = PagePart::spectrum,
        .page = {{"Power spectrum",
                  {{"effective_nyquist", "Effective Nyquist frequency"},
                   {"relative_nyquist", "Relative Nyquist frequency"},
                   {"oscillation", "Oscillation"}}}},
        .charts = {{"spectrum", "Power spectrum"}, {"radial", ""}},
        .strengths = weights.name,
        .accumulate =
            [](const Arrival& arrival, const Values& options, const RunContext& run) {
                return std::make_unique<Summation>(arrival, options, run);
            },
        .sharing = {.grain = grain},
        .refine = refine,
        .follow = follow,
        .combine = combine};
}

}  // namespace stipple::analyzers::periodogram
