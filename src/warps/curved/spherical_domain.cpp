// SPDX-License-Identifier: MIT
#include "warps/curved/spherical_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/densities/quadrature.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/radians.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple::warps {

double corner_volume(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 ab = minus(b, a);
    const Vector3 bc = minus(c, b);
    const Vector3 ca = minus(a, c);
    // Starts from the corner between the two shorter edges, since rounding of the longest edge's
    // difference is large relative to the short edges.
    const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
    if (dot(bc, bc) == longest) return dot(a, cross(ca, ab));
    if (dot(ca, ca) == longest) return dot(b, cross(ab, bc));
    return dot(c, cross(bc, ca));
}

double half_area_turns(const Vector3& a, const Vector3& b, const Vector3& c) {
    return turns_of(1 + dot(a, b) + dot(b, c) + dot(c, a), std::abs(corner_volume(a, b, c)));
}

SphericalDomain::SphericalDomain(std::string spec, std::vector<Vector3> corners,
                                 std::vector<Vector3> inward, Cells cells, double area,
                                 double slack, std::vector<std::string> axes)
    : NamedDomain(std::move(spec), 3, 2),
      corners_(std::move(corners)),
      inward_(std::move(inward)),
      cells_(std::move(cells)),
      area_(area),
      slack_(slack),
      axes_(std::move(axes)) {
    const std::size_t n = corners_.size();
    double largest_turn = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3 edge = minus(corners_[(i + 1) % n], corners_[i]);
        Vector3 normal = normalized(cross(corners_[i], edge));
        if (dot(normal, minus(corners_[(i + 2) % n], corners_[i])) < 0) normal = times(normal, -1);
        if (i == inward_.size()) inward_.push_back(normal);
        const double turn = dot(cross(corners_[i], edge), inward_[i]);
        if (std::abs(turn) > std::abs(largest_turn)) largest_turn = turn;
    }
    turn_ = std::copysign(1.0, largest_turn);
}

std::optional<SphereShape> SphericalDomain::sphere_shape() const {
    SphereShape found{.circles = {}};
    for (const Vector3& normal : inward_) found.circles.push_back({normal, 0});
    return found;
}

bool SphericalDomain::holds(const Vector3& v, double slack) const {
    if (!(std::abs(length(v) - 1) <= slack)) return false;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        if (!(dot(inward_[i], minus(v, corners_[i])) >= -slack)) return false;
    return true;
}

double SphericalDomain::edge_top(std::size_t i, const Vector3& up) const {
    const Vector3& from = corners_[i];
    const Vector3& to = corners_[(i + 1) % corners_.size()];
    const Vector3& normal = inward_[i];
    // The point of the edge's great circle that is highest along `up`, before normalization.
    const Vector3 highest = minus(up, times(normal, dot(normal, up)));
    // Whether that point is on the edge, between its ends.
    const bool passes = turn_ * dot(cross(from, highest), normal) > 0 &&
                        turn_ * dot(cross(highest, to), normal) > 0;
    return passes ? length(highest) : std::max(dot(from, up), dot(to, up));
}

std::array<double, 3> SphericalDomain::axial(const Vector3& w) const {
    // Sums over the edges of w . n times the integrals of (w . v)^0, ^1, ^2 along the edge.
    std::array<double, 3> along{};
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Vector3& from = corners_[i];
        const Vector3& to = corners_[(i + 1) % corners_.size()];
        const double sine = length(cross(from, to));
        const double cosine = dot(from, to);
        const double angle = signed_angle(sine, cosine);
        // On the edge w . v = a cos(s) + b sin(s), for s from 0 to the angle.
        const double a = dot(w, from);
        const double b = (dot(w, to) - cosine * a) / sine;
        const double bend = 0.5 * sine * cosine;
        const double side = dot(w, inward_[i]);
        along[0] += side * angle;
        along[1] += side * (a * sine + b * (1 - cosine));
        along[2] += side * (a * a * (0.5 * angle + bend) + a * b * sine * sine +
                            b * b * (0.5 * angle - bend));
    }
    const double ww = dot(w, w);
    const double first = along[0] / 2;
    return {first, (ww * area_ + along[1]) / 3, (2 * ww * first + along[2]) / 4};
}

/// Central moments by quadrature over flat triangles between the corners p_0, p_i, p_i+1: with
/// p = p_0 + e, the direction differs from p_0 by (e - p_0 (|p| - 1)) / |p|, and its solid angle is
/// the triangle's volume with the centre over |p|^3.
Moments SphericalDomain::close_moments() const {
    using Term = std::function<double(const Vector3&)>;
    const Vector3& from = corners_[0];
    const auto integral = [&](const Term& term) {
        double sum = 0;
        for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
            const Vector3 b = minus(corners_[i], from);
            const Vector3 c = minus(corners_[i + 1], from);
            const auto at = [&](double s, double t) {
                const Vector3 e = plus(times(b, s), times(c, t));
                const double size = length(plus(from, e));
                const double excess = (2 * dot(from, e) + dot(e, e)) / (size + 1);
                const Vector3 off = times(minus(e, times(from, excess)), 1 / size);
                return term(off) / (size * size * size);
            };
            const auto row = [&](double s) {
                return gauss_kronrod([&](double t) { return at(s, t); }, 0, 1 - s).value;
            };
            sum += std::abs(corner_volume(from, corners_[i], corners_[i + 1])) *
                   gauss_kronrod(row, 0, 1).value;
        }
        return sum;
    };
    const double all = integral([](const Vector3&) { return 1.0; });
    Moments m{std::vector<double>(3), std::vector<double>(9), std::vector<double>(3)};
    Vector3 mean{};
    for (std::size_t k = 0; k < 3; ++k)
        mean[k] = integral([k](const Vector3& v) { return v[k]; }) / all;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            m.covariance[3 * i + j] = m.covariance[3 * j + i] =
                integral([&](const Vector3& v) { return (v[i] - mean[i]) * (v[j] - mean[j]); }) /
                all;
    for (std::size_t k = 0; k < 3; ++k) {
        const double deviation = std::sqrt(m.covariance[4 * k]);
        m.mean[k] = from[k] + mean[k];
        m.skewness[k] = integral([&](const Vector3& v) {
                            return whole_power((v[k] - mean[k]) / deviation, 3);
                        }) /
                        all;
    }
    return m;
}

/// Small domains by quadrature, others by integrals along the edges.
std::optional<Moments> SphericalDomain::moments() const {
    double nearest = 1;  // cosine of the largest distance between corners
    for (const Vector3& a : corners_)
        for (const Vector3& b : corners_) nearest = std::min(nearest, dot(a, b));
    // Within 96 degrees the integrand is smooth enough for one interval.
    const bool close = nearest > -0.1 && area_ < 0.5;
    const double least = close ? 1e-9 : 1e-3;
    if (area_ < least) return std::nullopt;
    if (close) return close_moments();
    Moments m{std::vector<double>(3), std::vector<double>(9), std::vector<double>(3)};
    std::array<double, 3> squares;
    for (std::size_t k = 0; k < 3; ++k) {
        Vector3 w{};
        w[k] = 1;
        const auto [first, second, third] = axial(w);
        const double mean = first / area_;
        squares[k] = second / area_;
        m.mean[k] = mean;
        m.covariance[4 * k] = squares[k] - mean * mean;
        m.skewness[k] = (third / area_ - 3 * mean * squares[k] + 2 * mean * mean * mean) /
                        (m.covariance[4 * k] * std::sqrt(m.covariance[4 * k]));
        // Of slivers, rounding of the integrals leaves little of third moments.
        const double error = std::numeric_limits<double>::epsilon() / area_;
        if (error > 1e-8 * m.covariance[4 * k] * std::sqrt(m.covariance[4 * k]))
            m.skewness[k] = std::numeric_limits<double>::quiet_NaN();
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Vector3 w{};
            w[i] = w[j] = 1;
            const double both = axial(w)[1] / area_;
            m.covariance[3 * i + j] = m.covariance[3 * j + i] =
                0.5 * (both - squares[i] - squares[j]) - m.mean[i] * m.mean[j];
        }
    return m;
}

Box SphericalDomain::bounding_box() const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k)
        for (const double sign : {-1.0, 1.0}) {
            Vector3 up{};
            up[k] = sign;
            double top = holds(up, 0) ? 1 : -1;
            for (std::size_t i = 0; i < corners_.size(); ++i) top = std::max(top, edge_top(i, up));
            (sign < 0 ? box.low : box.high).push_back(sign * top);
        }
    return box;
}

}  // namespace stipple::warps
