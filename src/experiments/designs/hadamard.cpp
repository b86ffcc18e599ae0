// SPDX-License-Identifier: MIT
#include "experiments/designs/hadamard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "experiments/designs/hex_digits.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {

/// Hadamard matrix of order 4 v from four functions A, B, C, D with values -1 and 1 on an abelian
/// group of v elements. With R the matrix that maps x to -x, and each function X also denoting the
/// matrix with entries X(y - x), it is
///
///      A    B R     C R     D R
///     -B R  A      -D'R     C'R
///     -C R  D'R     A      -B'R
///     -D R -C'R     B'R     A
///
/// if the autocorrelations of the four functions add up to 0 at each nonzero shift. The group has
/// the integers modulo v, or pairs of integers modulo two numbers with the product v.
///
/// Source  J. M. Goethals, J. J. Seidel, J. Austral. Math. Soc. 11 (1970) 343-344,
///         doi:10.1017/S144678870000673X. v = 47 and 59: Turyn type sequences of D. Best, D. Z.
///         Djokovic, H. Kharaghani, H. Ramp, Discrete Math. 313 (2013) 2444-2455,
///         doi:10.1016/j.disc.2013.07.001. v = 103: D. Z. Djokovic, Australas. J. Combin. 10 (1994)
///         259-264. v = 107: H. Kharaghani, B. Tayfeh-Rezaie, J. Combin. Des. 13 (2005) 435-440,
///         doi:10.1002/jcd.20043. Others were searched for this program: v = 23, 43, 67, 127, 151
///         and 163 among unions of orbits of multipliers; those on pairs are T-sequences of length
///         3, 5, 7 and 9 times Williamson's symmetric quadruples (J. Cooper, J. S. Wallis, Bull.
///         Austral. Math. Soc. 7 (1972) 269-277, doi:10.1017/S0004972700045019).
class GoethalsSeidel {
  public:
    /// @param elements v, for which is_there() holds
    explicit GoethalsSeidel(std::uint64_t elements);

    static bool is_there(std::uint64_t elements);

    /// Whether an entry of the matrix of order 4 v is 1 rather than -1.
    [[nodiscard]] bool positive(std::uint64_t row, std::uint64_t column) const;

  private:
    /// Index of the group element x + y.
    [[nodiscard]] std::uint64_t sum(std::uint64_t x, std::uint64_t y) const;
    [[nodiscard]] std::uint64_t negative(std::uint64_t x) const;

    /// Element i inner_ + j is the pair (i, j), i modulo outer_ and j modulo inner_.
    std::uint64_t outer_ = 1;
    std::uint64_t inner_ = 1;
    std::array<std::vector<bool>, 4> positive_;  ///< elements at which A, B, C and D are 1
};

namespace {

struct Functions {
    std::uint64_t outer;
    std::uint64_t inner;
    /// Bits as hexadecimal digits, the highest first. A bit of 1 is the value 1, a bit of 0 is -1.
    std::array<std::string_view, 4> values;
};

constexpr Functions functions[] = {
    {1, 23, {"48db12", "c57ea2", "1bbdd8", "e9e796"}},
    {3, 13, {"1b64e729e4", "6318db17fa", "586d0086d8", "a0153c98c6"}},
    {1, 43, {"a5f8c936e42", "b02aee75e0c", "b5883a3ee52", "fb7be3b54c6"}},
    {1, 47, {"f2acf353f99e", "0d53f353e482", "0d530cadf99e", "0d53f3521b7c"}},
    {1, 59, {"f4326f7169f3956", "0bcd9f7169facea", "0bcd908e97f3956", "0bcd9f716805314"}},
    {5, 13, {"1b60db27394f25868", "631b18c6d8bfda010", "586ac3680436ce498", "a01500a9e4c639ce0"}},
    {1, 67, {"da2e6fe434a9cf018", "480f71f6cf274755a", "f30d5ca46da888300", "5eff1f4d74a9db08c"}},
    {3,
     27,
     {"c276e42476db8a835ac10", "dc4923b84edc87045a208", "5f294fa7dd2efb09db908",
      "3ee977d41ad60b71248e8"}},
    {3,
     31,
     {"f0a3c50e774b4bba573fcea0", "c45a5a23e1478a1f7b264de8", "6a300c56426cd90bc28f1438",
      "21366c852b9fe75311696888"}},
    {1,
     103,
     {"e2605a55228ef08ebb55a5f9b8", "dc182282d66357e26d7ace165e", "8e89a2978e48061a9fe16d8138",
      "87a5839ec8c4893203ed144470"}},
    {1,
     107,
     {"be9eece91e832e577bc3507b784", "41611316ee832e577b7ca4cf78c", "41611316e17cd1a885c3507b784",
      "41611316ee832e577a835b30872"}},
    {7,
     17,
     {"dc0eee0748fc4dc3b59e6ca051679a", "6e1db70ee478847e2940a530ca5028",
      "a619530c9679b2814dc0ec8f13703a", "6bf5b5fae50294c326e1dee075b876"}},
    {1,
     127,
     {"05666c387cf51e853aa4ef6342b98536", "920814d50775b626406f3f628b781c68",
      "6ce1ec13ece1131fa9a5a957131f57fe", "925d62a33808c91b4f814095b18753de"}},
    {7,
     19,
     {"5c93ab92768db151b62e10873def384218", "a36c546d89724ed1b629ef783def27bde0",
      "1ef783def38421cf7bc5c93ab9275724e8", "61086c210e7bde0f7bca36c4b92768db10"}},
    {1,
     151,
     {"e5d1fc0336b713b7a4b200c55b2d07d2e6b8f0", "44fd7d1d69bd233ad0e7d18be88240d53bf38e",
      "7af098a6bf7db97784aae4c63b6e2657c07848", "60b2910c6f3f2132ad71ca903900d348917654"}},
    {9,
     17,
     {"dc0eee075b877b81d91e22cf365028d7eba6190", "6e1db70ec8fc4dc3bdc0eca0529864b3cd6bf58",
      "a619530ca50294c326bf5ee0764788dc3b23f10", "6bf5b5fae9864d7eb59e6b70ef703a47e291e20"}},
    {1,
     163,
     {"8aa35f6e19534b5ec7267334a04b121e0ba7aa9ee", "04e4f93ffc438adfaa333310b24ad35f08b60b0e6",
      "b170a1a2f8441297a87b889bc962fdd6189047032", "ed4799976797ddf8070afda55beb4f5d1609c988e"}},
};

const Functions* functions_on(std::uint64_t elements) {
    const auto found = std::ranges::find(functions, elements,
                                         [](const Functions& f) { return f.outer * f.inner; });
    return found == std::end(functions) ? nullptr : found;
}

/// Returns p if q is a power of a prime p, otherwise 0.
std::uint64_t prime_of_power(std::uint64_t q) {
    if (q < 2) return 0;
    const std::uint64_t p = smallest_factor(q);
    while (q % p == 0) q /= p;
    return q == 1 ? p : 0;
}

/// Returns a if q = a (a + 2), where a and a + 2 are prime; otherwise 0.
std::uint64_t lower_twin(std::uint64_t q) {
    const std::uint64_t a = floor_root(q, 2);
    return a >= 3 && a * (a + 2) == q && is_prime(a) && is_prime(a + 2) ? a : 0;
}

/// x - y in the field of order p^m; digits of elements in base p are coefficients of t^i.
std::uint64_t difference(std::uint64_t x, std::uint64_t y, std::uint64_t p) {
    std::uint64_t out = 0;
    for (std::uint64_t unit = 1; x != 0 || y != 0; x /= p, y /= p, unit *= p)
        out += (x % p + p - y % p) % p * unit;
    return out;
}

/// Squares of the field, including 0. They are the even powers of t modulo a polynomial that has t
/// as a primitive root: the first such polynomial in the order of coefficients.
std::vector<bool> squares_of_field(std::uint64_t q, std::uint64_t p) {
    for (std::uint64_t polynomial = 1; polynomial < q; ++polynomial) {
        std::vector<bool> square(q);
        square[0] = square[1] = true;
        std::uint64_t power = 1;
        std::uint64_t steps = 0;
        do {
            const std::uint64_t carry = power / (q / p);  // coefficient of t^r = -polynomial
            power = power % (q / p) * p;
            for (std::uint64_t c = 0; c < carry; ++c) power = difference(power, polynomial, p);
            ++steps;
            if (steps % 2 == 0) square[power] = true;
        } while (power > 1 && steps < q);
        if (power == 1 && steps == q - 1) return square;
    }
    return {};
}

/// Squares modulo a prime.
std::vector<bool> squares_of_prime(std::uint64_t p) {
    std::vector<bool> square(p);
    for (std::uint64_t x = 0; x < p; ++x) square[x * x % p] = true;
    return square;
}

/// Sequence of Stanton and Sprott, rotated to give Plackett and Burman's design of 36 runs.
std::vector<bool> twin_sequence(std::uint64_t a) {
    const auto of_a = squares_of_prime(a);
    const auto of_b = squares_of_prime(a + 2);
    const std::uint64_t q = a * (a + 2);
    std::vector<bool> positive(q);
    for (std::uint64_t i = 0; i < q; ++i) {
        const std::uint64_t x = 2 * i % q;
        if (x % (a + 2) == 0) continue;
        positive[i] = x % a == 0 || of_a[x % a] != of_b[x % (a + 2)];
    }
    return positive;
}

/// Whether Miyamoto's construction exists for this order.
bool is_of_miyamoto(std::uint64_t order) {
    const std::uint64_t q = order / 4;
    return order % 16 == 4 && prime_of_power(q) != 0 && has_hadamard(q - 1);
}

/// First of the numbers order, order / 2, order / 4, ... that has a construction other than
/// doubling; 0 if no such number has one.
std::uint64_t base_order(std::uint64_t order) {
    for (; order >= 4 && order % 4 == 0; order /= 2)
        if (prime_of_power(order - 1) != 0 || lower_twin(order - 1) != 0 ||
            (order % 8 == 4 && prime_of_power(order / 2 - 1) != 0) ||
            GoethalsSeidel::is_there(order / 4) || is_of_miyamoto(order))
            return order;
    return 0;
}

std::vector<bool> squares_of(std::uint64_t q) {
    const std::uint64_t p = prime_of_power(q);
    return p == q ? squares_of_prime(q) : squares_of_field(q, p);
}

}  // namespace

bool GoethalsSeidel::is_there(std::uint64_t elements) { return functions_on(elements) != nullptr; }

GoethalsSeidel::GoethalsSeidel(std::uint64_t elements) {
    const Functions& of = *functions_on(elements);
    outer_ = of.outer;
    inner_ = of.inner;
    for (std::size_t f = 0; f < 4; ++f)
        for (std::uint64_t x = 0; x < elements; ++x)
            positive_[f].push_back((hex_number(of.values[f].substr(x / 4, 1)) >> (3 - x % 4) & 1) !=
                                   0);
}

std::uint64_t GoethalsSeidel::sum(std::uint64_t x, std::uint64_t y) const {
    return (x / inner_ + y / inner_) % outer_ * inner_ + (x % inner_ + y % inner_) % inner_;
}

std::uint64_t GoethalsSeidel::negative(std::uint64_t x) const {
    return (outer_ - x / inner_) % outer_ * inner_ + (inner_ - x % inner_) % inner_;
}

bool GoethalsSeidel::positive(std::uint64_t row, std::uint64_t column) const {
    const std::uint64_t v = outer_ * inner_;
    const std::uint64_t i = row / v;
    const std::uint64_t k = column / v;
    const std::uint64_t x = row % v;
    const std::uint64_t y = column % v;
    if (i == k) return positive_[0][sum(y, negative(x))];
    if (i == 0) return positive_[k][negative(sum(x, y))];
    if (k == 0) return !positive_[i][negative(sum(x, y))];
    const bool plus = (k + 3 - i) % 3 == 2;
    return positive_[6 - i - k][sum(x, y)] == plus;
}

bool has_hadamard(std::uint64_t order) { return order <= most_hadamard && base_order(order) != 0; }

Hadamard::Hadamard(std::uint64_t order) : base_(base_order(order)) {
    const std::uint64_t q = base_ - 1;
    const std::uint64_t half = base_ / 2 - 1;
    const std::uint64_t fourth = base_ / 4;
    if (prime_of_power(q) == q) {
        square_ = squares_of_prime(q);
        construction_ = fmt::format("Paley I, q = {}", q);
    } else if (lower_twin(q) != 0) {
        square_ = twin_sequence(lower_twin(q));
        construction_ = fmt::format("twin primes {} and {}", lower_twin(q), lower_twin(q) + 2);
    } else if (prime_of_power(q) != 0) {
        kind_ = Kind::field;
        prime_ = prime_of_power(q);
        square_ = squares_of(q);
        construction_ = fmt::format("Paley I, q = {}", q);
    } else if (base_ % 8 == 4 && prime_of_power(half) != 0) {
        kind_ = Kind::conference;
        prime_ = prime_of_power(half);
        square_ = squares_of(half);
        construction_ = fmt::format("Paley II, q = {}", half);
    } else if (GoethalsSeidel::is_there(fourth)) {
        kind_ = Kind::four_functions;
        four_ = std::make_shared<const GoethalsSeidel>(fourth);
        construction_ = fmt::format("Goethals-Seidel, v = {}", fourth);
    } else {
        kind_ = Kind::miyamoto;
        prime_ = prime_of_power(fourth);
        square_ = squares_of(fourth);
        smaller_ = std::make_shared<const Hadamard>(fourth - 1);
        for (const bool wanted : {true, false})
            for (std::uint64_t x = 1; x < fourth; ++x)
                if (square_[x] == wanted) elements_.push_back(x);
        construction_ = fmt::format("Miyamoto, q = {}", fourth);
    }
    for (std::uint64_t n = base_; n < order; n *= 2) construction_ += ", doubled";
}

bool Hadamard::positive(std::uint64_t row, std::uint64_t column) const {
    const bool turned = std::popcount((row / base_) & (column / base_)) % 2 != 0;
    return core(row % base_, column % base_) != turned;
}

bool Hadamard::core(std::uint64_t row, std::uint64_t column) const {
    if (column == 0) return true;
    if (kind_ == Kind::four_functions)  // each row is divided by its first entry
        return four_->positive(row, column) == four_->positive(row, 0);
    if (kind_ == Kind::miyamoto) return miyamoto(row, column) == miyamoto(row, 0);
    if (kind_ == Kind::conference) return paley_two(row, column);
    const std::uint64_t q = base_ - 1;
    if (row == q) return false;
    const std::uint64_t k = column - 1;
    return square_[kind_ == Kind::field ? difference(k, row, prime_) : (k + q - row) % q];
}

/// Entry of C (x) (1 1 / 1 -1) + I (x) (1 -1 / -1 -1), where C is the conference matrix. Row 1 is
/// negated so that the first column is all 1.
bool Hadamard::paley_two(std::uint64_t row, std::uint64_t column) const {
    const std::uint64_t i = row / 2;
    const std::uint64_t k = column / 2;
    const bool low = row % 2 != 0 && column % 2 != 0;
    const bool turned = row == 1;
    if (i == k) return (row % 2 == 0 && column % 2 == 0) != turned;
    const bool character = i == 0 || k == 0 || square_[difference(k - 1, i - 1, prime_)];
    return (character != low) != turned;
}

/// Entry of Miyamoto's matrix: four strips of q rows and columns. The first line of a strip is a
/// border of 1 and -1; the others form two halves of m lines. C1, C2 and C4 are characters of
/// differences: between squares, from squares to nonsquares, and between nonsquares. K1, ..., K4
/// are the quarters of the smaller matrix, and ' is the transpose. These are the blocks of U and V
/// for each pair of strips:
///
///           -C1  C2   0   0              I    0   K1  K2
///      U =  C2'  C4   0   0         V =  0    I  -K3  K4
///            0   0  -C1  C2             K1' -K3'  I   0
///            0   0  C2'  C4             K2'  K4'  0   I
///
/// Two strips meet in the following four quarters, made of their blocks U and V, times signs that
/// make the strips orthogonal:
///
///     U + V  U - V
///     U - V  U + V
bool Hadamard::miyamoto(std::uint64_t row, std::uint64_t column) const {
    constexpr bool minus[4][4] = {{false, false, false, false},
                                  {true, false, false, true},
                                  {true, true, false, false},
                                  {true, false, true, false}};
    const std::uint64_t q = base_ / 4;
    const std::uint64_t m = (q - 1) / 2;
    const std::uint64_t s = row / q;
    const std::uint64_t t = column / q;
    const bool border_row = row % q == 0;
    const bool border_column = column % q == 0;
    if (border_row || border_column)
        return border_row == border_column || s != t ? !minus[s][t] : false;
    const std::uint64_t i = (row % q - 1) % m + s % 2 * m;
    const std::uint64_t k = (column % q - 1) % m + t % 2 * m;
    const bool plus = ((row % q - 1) < m) == ((column % q - 1) < m);
    if (s / 2 == t / 2) {
        if (i == k) return plus != minus[s][t];
        const bool character = square_[difference(elements_[k], elements_[i], prime_)];
        return (character != (i < m && k < m)) != minus[s][t];
    }
    const std::uint64_t of_row = s < 2 ? i : k;
    const std::uint64_t of_column = s < 2 ? k : i;
    const bool turned = of_row >= m && of_column < m;
    return (smaller_->positive(of_row, of_column) != turned) == (plus != minus[s][t]);
}

}  // namespace stipple::generators
