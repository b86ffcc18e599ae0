// SPDX-License-Identifier: MIT
#include "experiments/designs/hadamard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "experiments/designs/embedded_table.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {

const char* hadamard_table();  // contents of hadamard.txt

/// Hadamard matrix of order 4 v from four functions A, B, C, D with values -1 and 1 on an abelian
/// group of v elements. With R the matrix that maps x to -x, and each function X also denoting the
/// matrix with entries X(y - x), it is
///
///      A    B R     C R     D R
///     -B R  A      -D'R     C'R
///     -C R  D'R     A      -B'R
///     -D R -C'R     B'R     A
///
/// if the autocorrelations of the four functions add up to 0 at each nonzero shift.
///
/// Source  J. M. Goethals, J. J. Seidel, J. Austral. Math. Soc. 11 (1970) 343-344,
///         doi:10.1017/S144678870000673X; hadamard.txt for the functions.
struct GoethalsSeidel {
    /// Number i * inner + j denotes the pair (i, j), with i modulo `outer` and j modulo `inner`.
    std::uint64_t outer;
    std::uint64_t inner;
    std::array<std::vector<bool>, 4> ones = {};  ///< elements at which A, B, C and D are 1

    [[nodiscard]] std::uint64_t size() const { return outer * inner; }
    [[nodiscard]] std::uint64_t sum(std::uint64_t x, std::uint64_t y) const {
        return (x / inner + y / inner) % outer * inner + (x % inner + y % inner) % inner;
    }
    [[nodiscard]] std::uint64_t negative(std::uint64_t x) const {
        return (outer - x / inner) % outer * inner + (inner - x % inner) % inner;
    }

    [[nodiscard]] bool positive(std::uint64_t row, std::uint64_t column) const {
        const std::uint64_t i = row / size();
        const std::uint64_t k = column / size();
        const std::uint64_t x = row % size();
        const std::uint64_t y = column % size();
        if (i == k) return ones[0][sum(y, negative(x))];
        if (i == 0) return ones[k][negative(sum(x, y))];
        if (k == 0) return !ones[i][negative(sum(x, y))];
        const bool plus = (k + 3 - i) % 3 == 2;
        return ones[6 - i - k][sum(x, y)] == plus;
    }
};

namespace {

/// The table's functions on a group of v elements; nullptr if it has none.
const GoethalsSeidel* goethals_seidel(std::uint64_t v) {
    static const auto all = [] {
        std::vector<GoethalsSeidel> groups;
        for (const auto& words : table_lines(hadamard_table())) {
            groups.push_back({number_of(words[0]), number_of(words[1])});
            GoethalsSeidel& group = groups.back();
            for (std::size_t f = 0; f < 4; ++f)
                for (std::uint64_t x = 0; x < group.size(); ++x) {
                    const std::uint64_t digit = number_of(words[2 + f].substr(x / 4, 1), 16);
                    group.ones[f].push_back((digit >> (3 - x % 4) & 1) != 0);
                }
        }
        return groups;
    }();
    const auto found = std::ranges::find(all, v, &GoethalsSeidel::size);
    return found == all.end() ? nullptr : &*found;
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

/// x - y, each digit in base p modulo p: elements of a field with the digits as coefficients.
std::uint64_t difference(std::uint64_t x, std::uint64_t y, std::uint64_t p) {
    if (x < p && y < p) return x < y ? x + p - y : x - y;
    std::uint64_t out = 0;
    for (std::uint64_t unit = 1; x != 0 || y != 0; x /= p, y /= p, unit *= p)
        out += (x % p + p - y % p) % p * unit;
    return out;
}

/// Whether each element of the field is a square. Squares are 0 and the even powers of t, modulo
/// the first polynomial for which t is a primitive root.
std::vector<bool> squares_of_field(std::uint64_t q, std::uint64_t p) {
    for (std::uint64_t polynomial = 1; polynomial < q; ++polynomial) {
        std::vector<bool> square(q);
        square[0] = square[1] = true;
        std::uint64_t power = 1;
        std::uint64_t steps = 0;
        do {
            const std::uint64_t carry = power / (q / p);  // coefficient of t^m; t^m = -polynomial
            power = power % (q / p) * p;
            for (std::uint64_t c = 0; c < carry; ++c) power = difference(power, polynomial, p);
            ++steps;
            if (steps % 2 == 0) square[power] = true;
        } while (power > 1 && steps < q);
        if (power == 1 && steps == q - 1) return square;
    }
    return {};
}

std::vector<bool> squares_of_prime(std::uint64_t p) {
    std::vector<bool> square(p);
    for (std::uint64_t x = 0; x < p; ++x) square[x * x % p] = true;
    return square;
}

/// Row 0 from twin primes a and a + 2, rotated so that 36 runs are Plackett and Burman's design.
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

std::vector<bool> squares_of(std::uint64_t q) {
    const std::uint64_t p = prime_of_power(q);
    return p == q ? squares_of_prime(q) : squares_of_field(q, p);
}

/// First construction of hadamard.hpp, apart from doubling, for an order that is a multiple of 4.
HadamardKind kind_of(std::uint64_t order) {
    if (prime_of_power(order - 1) != 0) return HadamardKind::paley_one;
    if (lower_twin(order - 1) != 0) return HadamardKind::twin_primes;
    if (order % 8 == 4 && prime_of_power(order / 2 - 1) != 0) return HadamardKind::paley_two;
    if (goethals_seidel(order / 4) != nullptr) return HadamardKind::four_functions;
    if (order % 16 == 4 && prime_of_power(order / 4) != 0 && has_hadamard(order / 4 - 1))
        return HadamardKind::miyamoto;
    return HadamardKind::none;
}

/// First of order, order / 2, order / 4, ... with a construction; 0 if none has one.
std::uint64_t base_order(std::uint64_t order) {
    while (order % 4 == 0 && order > 0 && kind_of(order) == HadamardKind::none) order /= 2;
    return order % 4 == 0 ? order : 0;
}

}  // namespace

bool has_hadamard(std::uint64_t order) { return order <= most_hadamard && base_order(order) != 0; }

Hadamard::Hadamard(std::uint64_t order) : base_(base_order(order)), kind_(kind_of(base_)) {
    const std::uint64_t q = base_ - 1;
    if (kind_ == HadamardKind::paley_one) {
        take_field(q, "Paley I");
    } else if (kind_ == HadamardKind::twin_primes) {
        const std::uint64_t a = lower_twin(q);
        prime_ = q;
        square_ = twin_sequence(a);
        construction_ = fmt::format("twin primes {} and {}", a, a + 2);
    } else if (kind_ == HadamardKind::paley_two) {
        take_field(base_ / 2 - 1, "Paley II");
    } else if (kind_ == HadamardKind::four_functions) {
        four_ = goethals_seidel(base_ / 4);
        construction_ = fmt::format("Goethals-Seidel, v = {}", base_ / 4);
    } else {
        take_field(base_ / 4, "Miyamoto");
        smaller_ = std::make_shared<const Hadamard>(base_ / 4 - 1);
        for (const bool wanted : {true, false})
            for (std::uint64_t x = 1; x < base_ / 4; ++x)
                if (square_[x] == wanted) elements_.push_back(x);
    }
    for (std::uint64_t n = base_; n < order; n *= 2) construction_ += ", doubled";
}

void Hadamard::take_field(std::uint64_t q, const char* name) {
    prime_ = prime_of_power(q);
    square_ = squares_of(q);
    construction_ = fmt::format("{}, q = {}", name, q);
}

bool Hadamard::positive(std::uint64_t row, std::uint64_t column) const {
    const bool turned = std::popcount((row / base_) & (column / base_)) % 2 != 0;
    return core(row % base_, column % base_) != turned;
}

bool Hadamard::core(std::uint64_t row, std::uint64_t column) const {
    if (column == 0) return true;
    if (four_ != nullptr)  // rows that begin with -1 are negated
        return four_->positive(row, column) == four_->positive(row, 0);
    if (kind_ == HadamardKind::miyamoto) return miyamoto(row, column) == miyamoto(row, 0);
    if (kind_ == HadamardKind::paley_two) return paley_two(row, column);
    return row != base_ - 1 && square_[difference(column - 1, row, prime_)];
}

/// Entry of C (x) (1 1 / 1 -1) + I (x) (1 -1 / -1 -1), where C is the conference matrix and (x)
/// the Kronecker product. Row 1 is negated so that the first column is all 1.
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
/// Two strips meet in four quarters, times signs that make the strips orthogonal:
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
