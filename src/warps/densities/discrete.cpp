// SPDX-License-Identifier: MIT
//
// Unit cube onto outcomes 0 ... m - 1 with given probabilities p_i, on each coordinate
// independently, or onto values assigned to the outcomes:
//
//     inversion  the first outcome with p_0 + ... + p_i > xi
//     alias      slot i = floor(m xi) gives outcome i if m xi - i < q_i, else its alias a_i, with
//                m p_i = q_i + sum of (1 - q_j) over all slots j with a_j = i
//
// Two coordinates of the same distribution are independent, like two dice: any pair has probability
// 1/36.
//
// Shape   any number of coordinates; 1 to 2^24 outcomes.
// Strata  inversion: xi is used directly, and outcomes are in order, so that n strata give each
//         outcome n p_i times, rounded up or down. alias: strata are preserved only within a slot.
// Cost    O(1) a coordinate on average, with a guide table or aliases; about 5 ns on one core.
// Promise an outcome of probability 0 never occurs, for any xi. With inversion, the inverse returns
//         the middle of the outcome's interval; alias has no inverse. The same bits on every
//         machine.
// Source  A. J. Walker, ACM Trans. Math. Software 3 (1977) 253-256, doi:10.1145/355744.355749;
//         M. D. Vose, IEEE Trans. Software Eng. 17 (1991) 972-975, doi:10.1109/32.92917 (aliases).

#include <numeric>

#include "core/error.hpp"
#include "math/densities/guide_table.hpp"
#include "math/functions/powers.hpp"
#include "warps/common_options.hpp"
#include "warps/line_domain.hpp"

namespace stipple::warps::discrete {
namespace {

constexpr Param<Numbers> probabilities{
    {.name = "probabilities",
     .fallback = "0.5,0.5",
     .help = "Probability of each outcome; they must sum to 1 within 1e-12"}};

constexpr Param<Numbers> outcomes{
    {.name = "values",
     .fallback = {},
     .help = "Value of each outcome, all different; default: 0,1,2,..."}};

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "inversion",
    .choices = "inversion|alias",
    .help = "inversion: outcomes in order, preserves strata; alias: Walker's method, does not"};

constexpr Param<bool> normalize{.name = "normalize",
                                .help = "Divide the probabilities by their sum"};

/// Distribution over the outcomes 0 ... m - 1, or over the values assigned to them.
struct Outcomes : LineDistribution {
    std::vector<double> weight;  ///< probability of each outcome
    std::vector<double> value;
    GuideTable sums;                 ///< cumulative probabilities; the last is 1
    std::vector<std::size_t> order;  ///< indices of the outcomes, sorted by value

    explicit Outcomes(const Values& options);

    std::size_t count() const { return value.size(); }

    /// Index of the outcome with the value x; count() if there is none.
    std::size_t find(double x) const {
        const auto at =
            std::ranges::lower_bound(order, x, {}, [&](std::size_t i) { return value[i]; });
        return at != order.end() && value[*at] == x ? *at : count();
    }

    double inverse(double x) const override {
        const std::size_t i = find(x);
        const double middle = 0.5 * (sums.begin(i) + sums.end(i));
        return middle < sums.end(i) ? middle : sums.begin(i);
    }
    /// False, since all outcomes have cells of the same size in the cube.
    bool even() const override { return false; }
    double cube_coordinate(double x) const override {
        return (static_cast<double>(find(x)) + 0.5) / static_cast<double>(count());
    }
    double density(double x) const override {
        const std::size_t i = find(x);
        return i < count() ? weight[i] : 0;
    }
    bool contains(double x) const override { return find(x) < count(); }
    double measure() const override { return static_cast<double>(count()); }
    /// Number of outcomes with positive probability.
    Positive positive() const override {
        const auto likely = std::ranges::count_if(weight, [](double p) { return p > 0; });
        return {{}, static_cast<double>(likely)};
    }
    std::pair<double, double> range() const override {
        return {value[order.front()], value[order.back()]};
    }
    /// Relative to the likeliest outcome, so that no digits are lost far from 0.
    LineMoments moments() const override {
        const double about =
            value[static_cast<std::size_t>(std::ranges::max_element(weight) - weight.begin())];
        double reach = 0;
        for (const double x : value) reach = std::max(reach, std::abs(x - about));
        LineMoments m{.unit = unit_for(reach)};
        const auto off = [&](std::size_t i) { return (value[i] - about) / m.unit; };
        double mean = 0;
        for (std::size_t i = 0; i < count(); ++i) mean += weight[i] * off(i);
        m.mean = about + m.unit * mean;
        for (std::size_t i = 0; i < count(); ++i) {
            const double from = off(i) - mean;
            m.variance += weight[i] * from * from;
            m.third += weight[i] * from * from * from;
        }
        return m;
    }
    /// Probability of the outcomes whose cube coordinates are in [low, high).
    Estimate probability(double low, double high) const override {
        double sum = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count());
            if (at >= low && at < high) sum += weight[i];
        }
        return {sum, 0};
    }
};

struct ByInversion final : Outcomes {
    using Outcomes::Outcomes;

    void forward_all(std::span<double> numbers) const {
        for (double& u : numbers) u = value[sums.at(u)];
    }
};

struct ByAlias final : Outcomes {
    explicit ByAlias(const Values& options);

    std::vector<double> share;  ///< q of each slot
    std::vector<std::uint32_t> alias;

    void forward_all(std::span<double> numbers) const {
        for (double& u : numbers) {
            const double at = u * static_cast<double>(count());
            const std::size_t i = std::min(static_cast<std::size_t>(at), count() - 1);
            u = value[at - static_cast<double>(i) < share[i] ? i : alias[i]];
        }
    }
};

std::vector<double> probabilities_of(const Values& options) {
    const std::vector<double> p = options[probabilities];
    if (p.size() > (std::size_t{1} << 24))
        fail(ErrorKind::usage, "--probabilities: {} outcomes; expected at most {}", p.size(),
             1 << 24);
    return checked_weights(probabilities, p, options[normalize]);
}

std::vector<double> values_of(const Values& options, std::size_t m) {
    std::vector<double> values = options[outcomes];
    if (values.empty()) {
        values.resize(m);
        std::iota(values.begin(), values.end(), 0.0);
    }
    if (values.size() != m)
        fail(ErrorKind::usage, "--values: {} number{} for {} probabilit{}; expected as many",
             values.size(), values.size() == 1 ? "" : "s", m, m == 1 ? "y" : "ies");
    for (double& x : values) x += 0.0;  // + 0.0 avoids -0 in the points
    return values;
}

Outcomes::Outcomes(const Values& options)
    : weight(probabilities_of(options)), value(values_of(options, weight.size())), order(count()) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return value[i]; });
    for (std::size_t i = 1; i < count(); ++i)
        if (value[order[i]] == value[order[i - 1]])
            fail(ErrorKind::usage, "--values: {} is given twice", value[order[i]]);
    sums = GuideTable(sums_to_1(weight), 2 * count());
}

/// Vose's method: slots i with m p_i < 1 are filled up by outcomes with m p_i > 1.
ByAlias::ByAlias(const Values& options) : Outcomes(options) {
    const std::size_t m = count();
    share.resize(m);
    alias.resize(m);
    std::iota(alias.begin(), alias.end(), 0U);
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < m; ++i) {
        share[i] = weight[i] * static_cast<double>(m);
        (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    const auto likeliest = std::ranges::max_element(weight) - weight.begin();
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back();
        const std::uint32_t l = large.back();
        small.pop_back();
        alias[s] = l;
        share[l] -= 1 - share[s];
        if (share[l] >= 1) continue;
        large.pop_back();
        small.push_back(l);
    }
    for (const std::uint32_t i : large) share[i] = 1;
    for (const std::uint32_t i : small) {  // only rounding left these below 1
        if (weight[i] > 0)
            share[i] = 1;
        else
            alias[i] = static_cast<std::uint32_t>(likeliest);
    }
}

template <class Law>
std::unique_ptr<Mapping> mapping_by(const WarpRequest& want, std::string no_way_back) {
    return line_mapping(std::vector{std::make_shared<const Law>(want.options)}, want.given,
                        want.spec({probabilities.name, outcomes.name, normalize.name}),
                        "outcome, (i + 1/2) / m", std::move(no_way_back));
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    if (std::string(want.options[method]) == "alias")
        return mapping_by<ByAlias>(want, "discrete by method alias has no inverse");
    return mapping_by<ByInversion>(want, {});
}

}  // namespace

Warp unit() {
    return {.name = "discrete",
            .summary = "Outcomes with given probabilities, on each coordinate",
            .source = "Walker 1977, doi:10.1145/355744.355749; Vose 1991 (alias)",
            .related = {"categorical", "alias-method"},
            .strata =
                "inversion: xi is used directly, and outcomes are in order; alias: strata are "
                "preserved only within a slot",
            .traits = {.discrete = true},
            .options = Schema(probabilities, outcomes, method, normalize),
            .mapping = make};
}

}  // namespace stipple::warps::discrete
