// SPDX-License-Identifier: MIT
#include "warps/marginal_mapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "math/functions/powers.hpp"
#include "warps/line_domain.hpp"

namespace stipple::warps {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_number = 1e-300;

/// Copies numbers to u, and then raises those below `least_number` to it.
STIPPLE_WIDE void raise(std::span<double> numbers, double* u) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        u[i] = numbers[i];
        numbers[i] = std::max(u[i], least_number);
    }
}

STIPPLE_WIDE void clamp_all(std::span<double> numbers, double low, double high) {
    for (double& x : numbers) x = std::max(low, std::min(x, high));
}

STIPPLE_WIDE bool all_inside(const double* u, std::size_t count) {
    bool inside = true;
    for (std::size_t i = 0; i < count; ++i) inside &= (u[i] > 0) & (u[i] < 1);
    return inside;
}

/// Adapts a distribution for LineDomain and LineMapping. Unbounded tails end at the range of the
/// random numbers: 0 is replaced by 2^-54, and 1 by 1 - 2^-55; other values below 1e-300 by 1e-300.
class MarginalLine final : public LineDistribution {
  public:
    explicit MarginalLine(MarginalPtr law)
        : law_(std::move(law)),
          discrete_(law_->discrete()),
          ends_(law_->support()),
          inside_(ends_) {
        endless_ = {has_thin_end(ends_.first), has_thin_end(ends_.second)};
        auto& [low, high] = inside_;
        if (std::isinf(low)) low = std::numeric_limits<double>::lowest();
        if (std::isinf(high)) high = std::numeric_limits<double>::max();
        if (!has_density(ends_.first))
            low = low == 0 ? least_number : std::nextafter(low, infinity);
        if (!has_density(ends_.second))
            high = high == 0 ? -least_number : std::nextafter(high, -infinity);
    }

    /// xi = 0 and 1 map to the ends of the support, if these and the density there are finite.
    /// Images of other xi round to an end only if the density there is finite and above 0.
    void forward_all(std::span<double> numbers) const {
        if (discrete_) return law_->quantiles(numbers);
        std::array<double, 256> u;
        for (std::size_t first = 0; first < numbers.size(); first += u.size()) {
            const auto some = numbers.subspan(first, std::min(u.size(), numbers.size() - first));
            raise(some, u.data());
            law_->quantiles(some);
            clamp_all(some, inside_.first, inside_.second);
            if (all_inside(u.data(), some.size())) continue;
            for (std::size_t i = 0; i < some.size(); ++i)
                if (u[i] <= 0 || u[i] >= 1) some[i] = end(u[i] <= 0 ? Tail::lower : Tail::upper);
        }
    }
    bool infinite(double u) const {
        return !discrete_ &&
               ((u <= 0 && std::isinf(ends_.first)) || (u >= 1 && std::isinf(ends_.second)));
    }
    double inverse(double x) const override {
        if (!discrete_) return law_->probability(x);
        const auto [begin, close] = cell(x);
        const double middle = begin + 0.5 * (close - begin);
        return middle < close ? middle : begin;
    }
    double density(double x) const override { return law_->density(x); }
    bool contains(double x) const override {
        if (discrete_) return law_->density(x) > 0;
        return x >= ends_.first && x <= ends_.second && std::isfinite(x);
    }
    double measure() const override {
        if (endless_.first || endless_.second) return infinity;
        return discrete_ ? law_->outcomes() : ends_.second - ends_.first;
    }
    /// Moments; the variance is NaN if it is too small for a double, unless there is only one
    /// outcome.
    LineMoments moments() const override {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        constexpr double least = std::numeric_limits<double>::min();
        const auto [mean, variance, skewness] = law_->moments();
        if (variance < least && law_->outcomes() != 1) return {mean, unknown, unknown};
        const double unit = unit_for(std::sqrt(variance));
        const double own = variance / unit / unit;
        return {mean, own, skewness * own * std::sqrt(own), unit};
    }
    /// An unbounded side ends where the probability beyond is exp(-10) = 4.5e-5, but at most 6
    /// times the width of the middle two thirds away from them.
    std::pair<double, double> range() const override {
        constexpr double beyond = 4.5399929762484854e-5;
        constexpr double sixth = 1 / 6.0;
        const double low = law_->quantile(sixth);
        const double high = law_->quantile(sixth, Tail::upper);
        const double reach = discrete_ ? infinity : 6 * (high - low);
        std::pair<double, double> shown = ends_;
        if (endless_.first) shown.first = std::max(law_->quantile(beyond), low - reach);
        if (endless_.second)
            shown.second = std::min(law_->quantile(beyond, Tail::upper), high + reach);
        return shown;
    }
    Positive positive() const override {
        if (discrete_) return {{}, measure()};
        return {{range()}, measure()};
    }

    /// False for discrete distributions: cube_coordinate() is then the middle of an outcome's cell.
    bool even() const override { return !discrete_; }
    bool has_outcomes() const override { return discrete_; }
    double cube_coordinate(double x) const override {
        const auto [begin, close] = cell(x);
        return discrete_ ? begin + 0.5 * (close - begin) : inverse(x);
    }
    Estimate probability(double low, double high) const override {
        if (!discrete_) return {high - low, 0};
        return {std::max(mass_before(high) - mass_before(low), 0.0), 0};
    }

  private:
    /// Whether the end x of the support is infinite or, for a discrete distribution, has a
    /// probability below 1e-9 of the median's: its table of outcomes was cut off there.
    bool has_thin_end(double x) const {
        return std::isinf(x) ||
               (discrete_ && law_->density(x) < 1e-9 * law_->density(law_->quantile(0.5)));
    }
    bool has_density(double x) const {
        const double density = std::isfinite(x) ? law_->density(x) : 1;
        return density > 0 && std::isfinite(density);
    }
    double end(Tail tail) const {
        const double x = tail == Tail::lower ? ends_.first : ends_.second;
        if (std::isinf(x)) return law_->quantile(tail == Tail::lower ? 0x1p-54 : 0x1p-55, tail);
        if (std::isfinite(law_->density(x))) return x;
        return tail == Tail::lower ? inside_.first : inside_.second;
    }
    /// The distribution function just below an outcome, and at the outcome.
    std::pair<double, double> cell(double x) const {
        return {law_->probability(std::nextafter(x, -infinity)), law_->probability(x)};
    }
    /// Probability of the outcomes whose cells have their middle below u.
    double mass_before(double u) const {
        if (u <= 0 || u >= 1) return u <= 0 ? 0 : 1;
        const double x = law_->quantile(u);
        const auto [begin, close] = cell(x);
        return cube_coordinate(x) < u ? close : begin;
    }

    MarginalPtr law_;
    bool discrete_;
    std::pair<double, double> ends_;
    std::pair<bool, bool> endless_;
    /// Ends of the support; the next double inside if end or density is infinite, or density is 0.
    std::pair<double, double> inside_;
};

}  // namespace

Option describe(const ParameterOption& parameter) {
    const MarginalParameter& of = parameter.of;
    std::vector<double> fallback;
    if (of.fallback) fallback.push_back(*of.fallback);
    return {.name = std::string(of.name),
            .type = "numbers",
            .fallback = fallback,
            .optional = fallback.empty(),
            .help = fmt::format("{}: one number for all coordinates, or one for each", of.help)};
}

ParameterOption parameter(std::string_view family, std::string_view name) {
    return {marginal_family(family).parameter(name)};
}

std::vector<MarginalPtr> family_members(std::string_view family, const ParameterLists& lists) {
    std::size_t members = 1;
    for (const auto& [name, numbers] : lists) {
        if (numbers.size() <= 1) continue;
        if (members > 1 && numbers.size() != members)
            fail(ErrorKind::usage,
                 "--{}: {} numbers for {} coordinates; expected one for all, or one for each", name,
                 numbers.size(), members);
        members = numbers.size();
    }
    std::vector<MarginalPtr> laws;
    for (std::size_t k = 0; k < members; ++k) {
        NamedNumbers given;
        for (const auto& [name, numbers] : lists)
            if (!numbers.empty()) given.emplace_back(name, numbers[numbers.size() > 1 ? k : 0]);
        laws.push_back(make_marginal(family, given, "--"));
    }
    return laws;
}

std::unique_ptr<Mapping> marginal_mapping(const std::vector<MarginalPtr>& marginals, std::size_t d,
                                          std::string spec) {
    std::vector<std::shared_ptr<const MarginalLine>> axes;
    for (const MarginalPtr& law : marginals) axes.push_back(std::make_shared<MarginalLine>(law));
    return line_mapping(std::move(axes), d, std::move(spec), "probability below x");
}

std::unique_ptr<Mapping> family_mapping(const WarpRequest& want) {
    ParameterLists lists;
    for (const auto& item : want.options.items())
        lists.emplace_back(item.name, std::get<std::vector<double>>(item.value));
    return marginal_mapping(family_members(want.warp.name, lists), want.given, want.spec());
}

}  // namespace stipple::warps
