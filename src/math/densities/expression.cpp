// SPDX-License-Identifier: MIT
#include "math/densities/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <type_traits>

#include "core/options.hpp"
#include "core/text.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/radians.hpp"
#include "math/functions/roots.hpp"

namespace stipple {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double whole_turn = 2 * std::numbers::pi;
// Functions for formulas: the functions of src/math, extended to arguments outside their domains.

CosSin turned(double x) { return std::isfinite(x) ? precise_cos_sin(x) : CosSin{nan, nan}; }
double tangent(const CosSin& of_angle) { return of_angle.sin / of_angle.cos; }

/// Angle in (-pi, pi], equally precise on both sides of the x axis.
double angle(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    // Treats infinite coordinates as directions.
    const double wide = std::isinf(x) ? std::copysign(1.0, x) : (std::isinf(y) ? 0 : x);
    const double high = std::isinf(y) ? std::copysign(1.0, y) : (std::isinf(x) ? 0 : y);
    return std::copysign(whole_turn * turns_of(wide, std::abs(high)), high);
}

double exp_of(double x) {
    if (std::isnan(x)) return nan;
    if (std::abs(x) <= 708) return exponential(x);
    const double root = exponential(std::clamp(x / 2, -500.0, 500.0));
    return root * root;
}
/// exp(x) / 2, which may be finite where exp(x) is not.
double half_exp(double x) {
    const double root = exp_of(x / 2);
    return 0.5 * root * root;
}
double log_of(double x) {
    if (x == infinity) return infinity;
    return x > 0 ? logarithm(x) : (x == 0 ? -infinity : nan);
}
/// Logarithm in another base, with per_log = 1 / log(base); exact if the result is a whole number.
double log_of(double x, const DoubleDouble& per_log) {
    if (!(x > 0 && x < infinity)) return log_of(x);
    return (logarithm_parts(x) * per_log).high;
}
constexpr DoubleDouble per_log_2 = {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
constexpr DoubleDouble per_log_10 = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
double sinh_of(double x) {
    if (!(std::abs(x) <= 708)) return std::copysign(half_exp(std::abs(x)), x);
    const double rise = exp_minus_1(std::abs(x));
    return std::copysign(0.5 * (rise + rise / (rise + 1)), x);
}
double cosh_of(double x) {
    if (std::abs(x) > 708) return half_exp(std::abs(x));
    const double up = exp_of(std::abs(x));
    return 0.5 * (up + 1 / up);
}
double tanh_of(double x) {
    if (std::isnan(x)) return nan;
    if (std::abs(x) > 350) return x > 0 ? 1 : -1;
    const double rise = exp_minus_1(2 * std::abs(x));
    return std::copysign(rise / (rise + 2), x);
}

/// x^y for a whole number |y| <= 1800, rounded about once: exact if a double holds it.
double whole(double x, double y) {
    int exponent = 0;
    double fraction = std::frexp(x, &exponent);
    if (std::abs(fraction) < std::numbers::sqrt2 / 2) {  // so fraction^|y| is in [2^-900, 2^900]
        fraction *= 2;
        --exponent;
    }
    DoubleDouble square{fraction, 0};
    const auto size = static_cast<int>(std::abs(y));
    DoubleDouble product{1, 0};
    for (int n = size; n > 0; n /= 2) {
        if (n % 2 != 0) product = product * square;
        if (n > 1) square = square * square;
    }
    const int shift = size * exponent;
    return y < 0 ? std::ldexp(1 / product.high, -shift) : std::ldexp(product.high, shift);
}

double power(double x, double y) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    // Small integer exponents use multiplications, as if written out.
    if (y == std::floor(y) && std::abs(y) <= 16) {
        const double up = whole_power(x, static_cast<std::size_t>(std::abs(y)));
        return y < 0 ? 1 / up : up;
    }
    if (y == 0.5) return std::sqrt(x);
    if (y == std::floor(y) && std::abs(y) <= 1800 && std::isnormal(x)) return whole(x, y);
    const bool odd = std::abs(y) < 0x1p53 && std::floor(y / 2) * 2 != y;
    if (x < 0 && y != std::floor(y)) return nan;
    if (!std::isfinite(x) || !std::isfinite(y)) {
        const double size = std::abs(x);
        const bool grows = (size > 1) == (y > 0);
        return size == 1 ? 1 : (grows ? infinity : 0);
    }
    double size = real_power(std::abs(x), y);
    if (x != 0 && (size == 0 || size == infinity)) {  // the true power may be a finite double > 0
        const double root = real_power(std::abs(x), y / 2);
        size = root * root;
    }
    return x < 0 && odd ? -size : size;
}

double hypotenuse(double x, double y) {
    const double squares = x * x + y * y;
    if (squares > 1e-280 && squares < infinity) return std::sqrt(squares);
    const double larger = std::max(std::abs(x), std::abs(y));
    if (!(larger > 0 && larger < infinity)) return std::abs(x) + std::abs(y);
    const int scale = std::ilogb(larger);
    const double a = std::ldexp(x, -scale), b = std::ldexp(y, -scale);
    return std::ldexp(std::sqrt(a * a + b * b), scale);
}

/// Powers, with a fast loop for squares, the most frequent ones.
void powers(double* __restrict x, const double* __restrict y, std::size_t count) {
    if (std::all_of(y, y + count, [](double exponent) { return exponent == 2; }))
        for (std::size_t i = 0; i < count; ++i) x[i] *= x[i];
    else
        for (std::size_t i = 0; i < count; ++i) x[i] = power(x[i], y[i]);
}

/// A function of one or two arguments, applied to blocks of values in a loop.
template <class F>
constexpr FormulaOperation in_blocks(std::string_view name, int binding, F) {
    if constexpr (std::is_invocable_v<F, double>)
        return {name, 1, binding, [](double x, double) -> double { return F()(x); },
                [](double* __restrict x, const double*, std::size_t count) {
                    for (std::size_t i = 0; i < count; ++i) x[i] = F()(x[i]);
                }};
    else
        return {name, 2, binding, [](double x, double y) -> double { return F()(x, y); },
                [](double* __restrict x, const double* __restrict y, std::size_t count) {
                    for (std::size_t i = 0; i < count; ++i) x[i] = F()(x[i], y[i]);
                }};
}

/// A function of any number of arguments: f(f(a, b), c).
template <class F>
constexpr FormulaOperation in_pairs(std::string_view name, F f) {
    return {name, 0, 0, in_blocks(name, 0, f).value, in_blocks(name, 0, f).apply};
}

using D = double;
constexpr int compares = comparison_binding;

constexpr FormulaOperation operations[] = {
    in_blocks("||", 1, [](D x, D y) -> D { return x != 0 || y != 0; }),
    in_blocks("&&", 2, [](D x, D y) -> D { return x != 0 && y != 0; }),
    in_blocks("<=", compares, [](D x, D y) -> D { return x <= y; }),
    in_blocks(">=", compares, [](D x, D y) -> D { return x >= y; }),
    in_blocks("==", compares, [](D x, D y) -> D { return x == y; }),
    in_blocks("!=", compares, [](D x, D y) -> D { return x != y; }),
    in_blocks("<", compares, [](D x, D y) -> D { return x < y; }),
    in_blocks(">", compares, [](D x, D y) -> D { return x > y; }),
    in_blocks("+", 4, [](D x, D y) { return x + y; }),
    in_blocks("-", 4, [](D x, D y) { return x - y; }),
    in_blocks("*", 5, [](D x, D y) { return x * y; }),
    in_blocks("/", 5, [](D x, D y) { return x / y; }),
    in_blocks("negated", 5, [](D x) { return -x; }),
    {"^", 2, 6, power, powers},
    in_blocks("sin", 0, [](D x) { return turned(x).sin; }),
    in_blocks("cos", 0, [](D x) { return turned(x).cos; }),
    in_blocks("tan", 0, [](D x) { return tangent(turned(x)); }),
    in_blocks("asin", 0, [](D x) { return angle(x, std::sqrt((1 - x) * (1 + x))); }),
    in_blocks("acos", 0, [](D x) { return angle(std::sqrt((1 - x) * (1 + x)), x); }),
    in_blocks("atan", 0, [](D x) { return angle(x, 1); }),
    in_blocks("sinh", 0, [](D x) { return sinh_of(x); }),
    in_blocks("cosh", 0, [](D x) { return cosh_of(x); }),
    in_blocks("tanh", 0, [](D x) { return tanh_of(x); }),
    in_blocks("exp", 0, [](D x) { return exp_of(x); }),
    in_blocks("log", 0, [](D x) { return log_of(x); }),
    in_blocks("ln", 0, [](D x) { return log_of(x); }),
    in_blocks("log2", 0, [](D x) { return log_of(x, per_log_2); }),
    in_blocks("log10", 0, [](D x) { return log_of(x, per_log_10); }),
    in_blocks("sqrt", 0, [](D x) { return std::sqrt(x); }),
    in_blocks("cbrt", 0, [](D x) { return std::isfinite(x) ? cube_root(x) : x; }),
    in_blocks("abs", 0, [](D x) { return std::abs(x); }),
    in_blocks("sign", 0, [](D x) { return x > 0 ? 1 : (x < 0 ? -1 : x); }),
    in_blocks("floor", 0, [](D x) { return std::floor(x); }),
    in_blocks("ceil", 0, [](D x) { return std::ceil(x); }),
    in_blocks("round", 0, [](D x) { return std::round(x); }),
    in_blocks("atan2", 0, [](D y, D x) { return angle(y, x); }),
    {"pow", 2, 0, power, powers},
    in_blocks("mod", 0, [](D x, D y) { return std::fmod(x, y); }),  // exact, hence portable
    in_blocks("hypot", 0, [](D x, D y) { return hypotenuse(x, y); }),
    in_pairs("min", [](D x, D y) { return y < x ? y : x; }),
    in_pairs("max", [](D x, D y) { return x < y ? y : x; }),
};

constexpr std::size_t block = 256;
using Places = std::span<const std::uint32_t>;  ///< indices of points

/// Evaluates a formula at blocks of points, each step for a whole block.
struct Evaluation {
    std::span<const FormulaStep> steps;
    const double* points;
    std::size_t dimension;
    std::vector<double>& stack;

    /// Computes steps at some points; their results begin at index `base` of the stack.
    /// @return the results, valid until the next call
    const double* run(std::size_t first, std::size_t last, Places places, std::size_t base) {
        const std::size_t n = places.size();
        std::size_t top = base;
        for (std::size_t at = first; at < last; ++at) {
            const FormulaStep& step = steps[at];
            if (stack.size() < top + n) stack.resize(2 * (top + n));
            double* const free = stack.data() + top;
            if (step.applied) {
                if (step.applied->arguments != 1) top -= n;
                step.applied->apply(stack.data() + top - n, stack.data() + top, n);
            } else if (step.kind == FormulaStep::number) {
                std::fill_n(free, n, step.value);
                top += n;
            } else if (step.kind == FormulaStep::coordinate) {
                for (std::size_t i = 0; i < n; ++i)
                    free[i] = points[places[i] * dimension + step.index];
                top += n;
            } else if (step.kind == FormulaStep::when) {
                top -= n;
                at = choose(at, places, top);
                if (steps[at].kind == FormulaStep::chosen) top += n;
            } else if (step.kind == FormulaStep::otherwise) {
                at = step.index;
            }
        }
        return stack.data() + base;
    }

    /// Returns the step of c ? a : b after which the evaluation continues. If conditions differ
    /// between points, computes each branch at its points; the results replace the conditions.
    std::size_t choose(std::size_t at, Places places, std::size_t conditions) {
        const std::size_t n = places.size(), otherwise = steps[at].index;
        const double* const c = stack.data() + conditions;
        const auto zeros = static_cast<std::size_t>(std::count(c, c + n, 0));
        if (zeros == 0) return at;
        if (zeros == n) return otherwise;
        std::vector<std::uint32_t> order(n), chosen(n);
        for (std::size_t i = 0, yes = 0, no = n - zeros; i < n; ++i)
            order[c[i] != 0 ? yes++ : no++] = static_cast<std::uint32_t>(i);
        for (std::size_t i = 0; i < n; ++i) chosen[i] = places[order[i]];
        const auto compute = [&](std::size_t first, std::size_t last, std::size_t i, Places some) {
            const double* const results = run(first, last, some, conditions + n);
            for (std::size_t j = 0; j < some.size(); ++j)
                stack[conditions + order[i + j]] = results[j];
        };
        const Places all(chosen);
        compute(at + 1, otherwise, 0, all.first(n - zeros));
        compute(otherwise + 1, steps[otherwise].index, n - zeros, all.last(zeros));
        return steps[otherwise].index;
    }
};

std::vector<double>& stack_of_thread() {
    thread_local std::vector<double> stack;
    return stack;
}

/// Value of the formula's steps [first, last) at one point.
double value_of(std::span<const FormulaStep> all, std::size_t first, std::size_t last,
                const double* point) {
    std::vector<double>& stack = stack_of_thread();
    if (stack.size() <= all.size()) stack.resize(all.size() + 1);
    double* top = stack.data();
    double value = 0;  // top of the stack; the values below it are stored before `top`
    for (std::size_t at = first; at < last; ++at) {
        const FormulaStep& step = all[at];
        if (step.kind == FormulaStep::number || step.kind == FormulaStep::coordinate) {
            *top++ = value;
            value = step.kind == FormulaStep::number ? step.value : point[step.index];
        } else if (step.kind == FormulaStep::added) {
            value = *--top + value;
        } else if (step.kind == FormulaStep::subtracted) {
            value = *--top - value;
        } else if (step.kind == FormulaStep::multiplied) {
            value = *--top * value;
        } else if (step.kind == FormulaStep::operation) {
            value = step.applied->value(step.applied->arguments == 1 ? value : *--top, value);
        } else if (step.kind == FormulaStep::when) {
            if (value == 0) at = step.index;
            value = *--top;
        } else if (step.kind == FormulaStep::otherwise) {
            at = step.index;
        }
    }
    return value;
}

constexpr auto every_place = [] {
    std::array<std::uint32_t, block> all{};
    std::iota(all.begin(), all.end(), 0U);
    return all;
}();

}  // namespace

void FormulaNames::add(const std::string& name, std::vector<std::string> words) {
    places_.emplace(name, names_.size());
    names_.push_back(name);
    words_.push_back(std::move(words));
}

std::optional<std::size_t> FormulaNames::find(std::string_view name) const {
    const auto at = places_.find(std::string(name));
    return at != places_.end() ? std::optional(at->second) : std::nullopt;
}

double Expression::at(std::span<const double> point) const {
    return value_of(steps_, 0, steps_.size(), point.data());
}

void Expression::evaluate(std::span<const double> points, std::span<double> values) const {
    Evaluation all{steps_, points.data(), dimension_, stack_of_thread()};
    for (std::size_t first = 0; first < values.size(); first += block) {
        const std::size_t count = std::min(block, values.size() - first);
        const double* results = all.run(0, steps_.size(), Places(every_place).first(count), 0);
        std::copy_n(results, count, values.data() + first);
        all.points += block * dimension_;
    }
}

double Expression::constant(std::size_t first, std::size_t last) const {
    return value_of(steps_, first, last, nullptr);
}

double formula_value(std::string_view option, std::string_view text) {
    return Expression(option, text, 0).at({});
}

std::span<const FormulaOperation> formula_operations() { return operations; }

std::string place_text(std::span<const double> point) {
    if (point.size() == 1) return fmt::format("x = {}", point[0]);
    return fmt::format("({})", join(point, ", "));
}

}  // namespace stipple
