// SPDX-License-Identifier: MIT
#include "math/densities/affine.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace stipple {
namespace {

/// The function coefficients . x + constant.
struct Affine {
    std::vector<double> coefficients;
    double constant = 0;

    [[nodiscard]] bool is_constant() const {
        return std::ranges::all_of(coefficients, [](double a) { return a == 0; });
    }
    void add(const Affine& other, double factor) {
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            coefficients[k] += factor * other.coefficients[k];
        constant += factor * other.constant;
    }
    template <class Change>
    void change(const Change& change) {
        for (double& a : coefficients) a = change(a);
        constant = change(constant);
    }
};

/// Thrown if a formula is not affine; caught in affine_inequalities().
struct NotAffine {};

/// Thrown if a formula is nested too deeply to be read.
struct TooDeep {};

/// Recursive-descent parser with a function for each level of operators.
class AffineReader {
  public:
    AffineReader(std::string_view text, const VariableNames& variables, std::size_t dimension)
        : variables_(variables), dimension_(dimension) {
        for (const char c : text)
            if (c != ' ' && c != '\t') text_ += c;
    }

    std::vector<HalfSpace> read() {
        std::vector<HalfSpace> all;
        conjunction(all);
        if (at_ != text_.size()) throw NotAffine();
        return all;
    }

  private:
    bool take(std::string_view sign) {
        if (!std::string_view(text_).substr(at_).starts_with(sign)) return false;
        at_ += sign.size();
        return true;
    }

    /// Counts itself as one more level of nested parentheses or signs during its lifetime.
    struct Depth {
        explicit Depth(std::size_t& depth) : count(depth) {
            if (++count > 200) throw TooDeep();
        }
        ~Depth() { --count; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        std::size_t& count;
    };

    void conjunction(std::vector<HalfSpace>& all) {
        const Depth here(depth_);
        do {
            const std::size_t start = at_;
            try {
                all.push_back(comparison());
                continue;
            } catch (const NotAffine&) {
                at_ = start;  // the comparison may be in parentheses
            }
            if (!take("(")) throw NotAffine();
            conjunction(all);
            if (!take(")")) throw NotAffine();
        } while (take("&&"));
    }

    HalfSpace comparison() {
        Affine left = sum();
        const bool below = take("<");
        if (!below && !take(">")) throw NotAffine();
        const bool strict = !take("=");
        left.add(sum(), -1);
        check_finite(left);
        if (!below) left.change([](double x) { return 0 - x; });
        HalfSpace half{std::move(left.coefficients), 0 - left.constant};
        if (std::ranges::all_of(half.normal, [](double a) { return a == 0; }))
            half.bound = half.bound > 0 || (half.bound == 0 && !strict) ? 1 : -1;
        return half;
    }

    Affine sum() {
        Affine all = product();
        while (true) {
            const bool minus = take("-");
            if (!minus && !take("+")) return all;
            all.add(product(), minus ? -1 : 1);
        }
    }

    Affine product() {
        Affine all = factor();
        while (true) {
            const bool by = take("/");
            if (!by && !take("*")) return all;
            Affine other = factor();
            if (!by && all.is_constant()) std::swap(all, other);
            if (!other.is_constant()) throw NotAffine();
            const double number = other.constant;
            all.change([&](double x) { return by ? x / number : x * number; });
            check_finite(all);
        }
    }

    Affine factor() {
        const Depth here(depth_);
        if (take("-")) {
            Affine other = factor();
            other.change([](double x) { return 0 - x; });
            return other;
        }
        if (take("+")) return factor();
        const std::size_t start = at_;
        Affine base = primary();
        if (!take("^")) return base;
        if (!base.is_constant() || !factor().is_constant()) throw NotAffine();
        return constant(start);
    }

    Affine primary() {
        const std::size_t start = at_;
        if (take("(")) {
            Affine inner = sum();
            if (!take(")")) throw NotAffine();
            return inner;
        }
        if (const auto number = this->number()) return *number;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        const std::string_view name = std::string_view(text_).substr(start, at_ - start);
        const auto known = std::ranges::find(variables_, name, &VariableNames::value_type::first);
        if (known != variables_.end()) {
            Affine variable{std::vector<double>(dimension_)};
            variable.coefficients[known->second] = 1;
            return variable;
        }
        if (at_ < text_.size() && text_[at_] == '(') skip_parentheses();
        return constant(start);
    }

    static bool is_letter(char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '_' || c == '@';
    }

    std::optional<Affine> number() {
        if (at_ == text_.size() || (text_[at_] != '.' && !(text_[at_] >= '0' && text_[at_] <= '9')))
            return std::nullopt;
        Affine all{std::vector<double>(dimension_)};
        const auto [end, error] =
            std::from_chars(text_.data() + at_, text_.data() + text_.size(), all.constant);
        if (error != std::errc()) throw NotAffine();
        at_ = static_cast<std::size_t>(end - text_.data());
        return all;
    }

    void skip_parentheses() {
        std::size_t depth = 0;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '(') ++depth;
            if (text_[at_] == ')' && --depth == 0) break;
        }
        at_ = std::min(at_ + 1, text_.size());
    }

    /// Value of the text from `start` to the current position; the text must be a formula without
    /// variables.
    Affine constant(std::size_t start) const {
        Affine all{std::vector<double>(dimension_)};
        try {
            all.constant = Expression("", text_.substr(start, at_ - start), 0).at({});
        } catch (const Error&) {
            throw NotAffine();
        }
        check_finite(all);
        return all;
    }

    static void check_finite(const Affine& all) {
        if (!std::isfinite(all.constant) ||
            !std::ranges::all_of(all.coefficients, [](double a) { return std::isfinite(a); }))
            throw NotAffine();
    }

    std::string text_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    const VariableNames& variables_;
    std::size_t dimension_;
};

}  // namespace

std::optional<std::vector<HalfSpace>> affine_inequalities(std::string_view text,
                                                          const VariableNames& variables,
                                                          std::size_t dimension) {
    try {
        auto all = AffineReader(text, variables, dimension).read();
        for (HalfSpace& half : all) half.text = text;
        return all;
    } catch (const NotAffine&) {
        return std::nullopt;
    } catch (const TooDeep&) {
        return std::nullopt;
    }
}

}  // namespace stipple
