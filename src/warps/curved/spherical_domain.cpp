// SPDX-License-Identifier: MIT
#include "warps/curved/spherical_domain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

std::optional<Moments> SphericalDomain::moments() const {
    constexpr double least = 1e-3;
    if (area_ < least) return std::nullopt;
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
