// SPDX-License-Identifier: MIT
#include "math/densities/affine.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace stipple {
namespace {

/// A part of a formula: a constant, an affine function coefficients . x + number, or inequalities.
struct Part {
    std::size_t begin;  ///< index of its first step
    bool constant;      ///< no variables; compute() sets `number` when it is needed
    std::vector<double> coefficients = {};  ///< empty if constant or not affine
    double number = 0;
    std::vector<HalfSpace> inequalities = {};

    [[nodiscard]] bool finite() const {
        return !coefficients.empty() && std::isfinite(number) &&
               std::ranges::all_of(coefficients, [](double a) { return std::isfinite(a); });
    }
    [[nodiscard]] bool flat() const {
        return std::ranges::all_of(coefficients, [](double a) { return a == 0; });
    }
    template <class Change>
    void change(const Change& change) {
        for (double& a : coefficients) a = change(a);
        number = change(number);
    }
    void add(const Part& other, double factor) {
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            coefficients[k] += factor * other.coefficients[k];
        number += factor * other.number;
    }
};

/// Replays the steps of a formula on a stack of parts.
class Affine {
  public:
    explicit Affine(const Expression& formula) : formula_(formula) {}

    std::optional<std::vector<HalfSpace>> read() {
        for (; at_ < formula_.steps().size(); ++at_)
            if (!take(formula_.steps()[at_])) return std::nullopt;
        if (parts_.back().inequalities.empty()) return std::nullopt;
        return std::move(parts_.back().inequalities);
    }

  private:
    /// Adds a step; false if the formula cannot be affine.
    bool take(const FormulaStep& step) {
        if (step.kind == FormulaStep::when || step.kind == FormulaStep::otherwise) return true;
        if (step.kind == FormulaStep::number || step.kind == FormulaStep::coordinate) {
            parts_.push_back({at_, step.kind == FormulaStep::number});
            if (step.kind == FormulaStep::number) return true;
            parts_.back().coefficients.resize(formula_.dimension());
            parts_.back().coefficients[step.index] = 1;
            return true;
        }
        const bool chosen = step.kind == FormulaStep::chosen;
        const std::size_t count = chosen ? 3 : (step.applied->arguments == 1 ? 1 : 2);
        const auto last = std::span(parts_).last(count);
        const bool constant = std::ranges::all_of(last, &Part::constant);
        Part& left = last.front();
        const bool understood = !chosen && (count == 1 ? negate(left, *step.applied)
                                                       : join(left, last[1], *step.applied));
        if (!understood) left.inequalities.clear();
        left.constant = constant;
        if (constant) left.coefficients.clear();
        parts_.resize(parts_.size() + 1 - count, {0, false});
        return understood || constant;
    }

    static bool negate(Part& part, const FormulaOperation& operation) {
        if (operation.name != "negated" || part.coefficients.empty()) return false;
        part.change([](double x) { return 0 - x; });
        return true;
    }

    bool join(Part& left, Part& right, const FormulaOperation& operation) const {
        const char sign = operation.name[0];
        if (operation.name == "&&") {
            if (left.inequalities.empty() || right.inequalities.empty()) return false;
            std::ranges::move(right.inequalities, std::back_inserter(left.inequalities));
            return true;
        }
        const bool compares = sign == '<' || sign == '>';
        // An operation on two constants, except a comparison, gives a constant, computed later.
        if (left.constant && right.constant && !compares) return false;
        compute(left, right.begin);
        compute(right, at_);
        if (left.coefficients.empty() || right.coefficients.empty()) return false;
        if (compares) return compare(left, right, operation.name);
        if (sign == '*' && left.flat()) {
            std::swap(left.coefficients, right.coefficients);
            std::swap(left.number, right.number);
        }
        if (operation.name == "+" || operation.name == "-") {
            left.add(right, sign == '-' ? -1 : 1);
            return true;
        }
        if (!right.flat() || (operation.name != "*" && operation.name != "/")) return false;
        left.change([&](double x) { return sign == '/' ? x / right.number : x * right.number; });
        return left.finite();
    }

    /// Turns `left` into the inequality left < right, or <=, >, >=; false if a number overflows.
    static bool compare(Part& left, const Part& right, std::string_view sign) {
        left.add(right, -1);
        if (!left.finite()) return false;
        if (sign[0] == '>') left.change([](double x) { return 0 - x; });
        HalfSpace half{std::exchange(left.coefficients, {}), 0 - left.number};
        if (std::ranges::all_of(half.normal, [](double a) { return a == 0; }))
            half.bound = half.bound > 0 || (half.bound == 0 && sign.size() == 2) ? 1 : -1;
        left.inequalities.push_back(std::move(half));
        return true;
    }

    /// Computes the value of a constant part whose steps end before `end`.
    void compute(Part& part, std::size_t end) const {
        if (!part.constant) return;
        part.number = formula_.constant(part.begin, end);
        if (std::isfinite(part.number)) part.coefficients.assign(formula_.dimension(), 0);
        part.inequalities.clear();
    }

    const Expression& formula_;
    std::size_t at_ = 0;
    std::vector<Part> parts_;
};

}  // namespace

std::optional<std::vector<HalfSpace>> affine_inequalities(const Expression& formula) {
    auto all = Affine(formula).read();
    for (std::size_t i = 0; all && i < all->size(); ++i) (*all)[i].text = formula.text();
    return all;
}

}  // namespace stipple
