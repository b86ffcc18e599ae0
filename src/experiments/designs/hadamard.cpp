// SPDX-License-Identifier: MIT
#include "experiments/designs/hadamard.hpp"

#include <fmt/format.h>

#include <bit>

#include "math/combinatorics/primes.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {
namespace {

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

/// x - y in the field of order p^m; elements are numbered by their digits in base p.
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
            const std::uint64_t carry = power / (q / p);  // t^r = carry times the polynomial
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

/// Sequence of Stanton and Sprott, rotated so that the design of 36 runs is that of Plackett and
/// Burman.
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

/// First one of order, order / 2, order / 4, ... that has a construction other than doubling; 0 if
/// none has.
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
