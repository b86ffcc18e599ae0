// SPDX-License-Identifier: MIT
//
// A double with the elementary functions of this folder. Boost.Math's functions are templates on
// the number type. With this type they call no function of the C library whose last bit differs
// between machines, and do not promote to wider types on machines that have them.
//
// Promise + - * / and square roots are those of double; exp, log and powers as in exponential.hpp
//         and logarithm.hpp; sine, cosine, and their inverses for x in [0, 1], within 1e-15. The
//         same bits on every machine for the same release of Boost.
#pragma once

#include <boost/math/policies/policy.hpp>
#include <cmath>
#include <compare>
#include <limits>
#include <type_traits>

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/radians.hpp"

namespace stipple {

struct PortableDouble {
    double value = 0;

    PortableDouble() = default;
    template <class Number>
    requires std::is_arithmetic_v<Number>
    constexpr PortableDouble(Number x)
        : value(static_cast<double>(x)) {}  // NOLINT: implicit on purpose
    template <class Number>
    requires std::is_arithmetic_v<Number>
    explicit operator Number() const { return static_cast<Number>(value); }

    PortableDouble& operator+=(PortableDouble b) { return *this = value + b.value; }
    PortableDouble& operator-=(PortableDouble b) { return *this = value - b.value; }
    PortableDouble& operator*=(PortableDouble b) { return *this = value * b.value; }
    PortableDouble& operator/=(PortableDouble b) { return *this = value / b.value; }
    PortableDouble& operator++() { return *this += 1; }
    PortableDouble& operator--() { return *this -= 1; }
    PortableDouble operator-() const { return -value; }
    PortableDouble operator+() const { return *this; }
    friend PortableDouble operator+(PortableDouble a, PortableDouble b) { return a += b; }
    friend PortableDouble operator-(PortableDouble a, PortableDouble b) { return a -= b; }
    friend PortableDouble operator*(PortableDouble a, PortableDouble b) { return a *= b; }
    friend PortableDouble operator/(PortableDouble a, PortableDouble b) { return a /= b; }
    friend auto operator<=>(PortableDouble a, PortableDouble b) { return a.value <=> b.value; }
    friend bool operator==(PortableDouble a, PortableDouble b) { return a.value == b.value; }

    /// Lets Boost print the value in its error messages.
    template <class Stream>
    friend Stream& operator<<(Stream& out, PortableDouble x) {
        out << x.value;
        return out;
    }
};

inline PortableDouble exp(PortableDouble x) {
    return x.value <= 709 ? exponential(x.value) : std::numeric_limits<double>::infinity();
}
inline PortableDouble log(PortableDouble x) {
    return x.value > 0 ? logarithm(x.value) : -std::numeric_limits<double>::infinity();
}
inline PortableDouble pow(PortableDouble x, PortableDouble y) {
    return real_power(x.value, y.value);
}
inline PortableDouble sqrt(PortableDouble x) { return std::sqrt(x.value); }
inline PortableDouble fabs(PortableDouble x) { return std::abs(x.value); }
inline PortableDouble abs(PortableDouble x) { return std::abs(x.value); }
inline PortableDouble floor(PortableDouble x) { return std::floor(x.value); }
inline PortableDouble ceil(PortableDouble x) { return std::ceil(x.value); }
inline PortableDouble fmod(PortableDouble x, PortableDouble y) {
    return std::fmod(x.value, y.value);
}
inline PortableDouble ldexp(PortableDouble x, int exponent) {
    return std::ldexp(x.value, exponent);
}
inline PortableDouble frexp(PortableDouble x, int* exponent) {
    return std::frexp(x.value, exponent);
}

inline PortableDouble cos(PortableDouble x) { return cos_sin_radians(x.value).cos; }
inline PortableDouble sin(PortableDouble x) { return cos_sin_radians(x.value).sin; }
inline PortableDouble acos(PortableDouble x) { return arc_cosine(x.value); }
inline PortableDouble asin(PortableDouble x) { return arc_sine(x.value); }

namespace detail {

namespace policies = boost::math::policies;

/// Boost's functions return infinity or NaN where they have no value, without exceptions.
using NoErrors = policies::policy<policies::domain_error<policies::ignore_error>,
                                  policies::pole_error<policies::ignore_error>,
                                  policies::overflow_error<policies::ignore_error>,
                                  policies::underflow_error<policies::ignore_error>,
                                  policies::denorm_error<policies::ignore_error>,
                                  policies::rounding_error<policies::ignore_error>,
                                  policies::evaluation_error<policies::ignore_error>,
                                  policies::indeterminate_result_error<policies::ignore_error>>;

}  // namespace detail

}  // namespace stipple

template <>
class std::numeric_limits<stipple::PortableDouble> : public std::numeric_limits<double> {
    using Number = stipple::PortableDouble;
    using Double = std::numeric_limits<double>;

  public:
    static Number min() { return Double::min(); }
    static Number max() { return Double::max(); }
    static Number lowest() { return Double::lowest(); }
    static Number epsilon() { return Double::epsilon(); }
    static Number infinity() { return Double::infinity(); }
    static Number quiet_NaN() { return Double::quiet_NaN(); }
    static Number denorm_min() { return Double::denorm_min(); }
};
