// SPDX-License-Identifier: MIT
//
// Lobe: a distribution of directions whose density depends only on the angle theta from an axis. u
// is the probability of the cone about the axis whose rim contains the direction.
//
//     struct Lobe {
//         static constexpr bool hemisphere;          // all directions are within 90 degrees
//         double fraction(const Vector3& w) const;   // u of a direction in the frame of the axis
//         double density(const Vector3& w) const;    // with respect to solid angle
//         AxialMoments moments() const;
//         CosSin forward(double u) const;  // cosine and sine of theta; for lobe_mapping()
//         bool level() const;             // hemispheres only: whether uniform
//     };
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/polar_direction.hpp"
#include "math/geometry/vector3.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps {

template <class Lobe>
class LobeDomain final : public NamedDomain {
  public:
    LobeDomain(const Lobe& lobe, const Frame& frame, std::string spec)
        : NamedDomain(std::move(spec), 3, 2), lobe_(lobe), frame_(frame) {}

    double measure() const override { return (Lobe::hemisphere ? 2 : 4) * std::numbers::pi; }

    /// Accepts vectors whose length differs from 1 by at most 8 epsilon, down to 8 epsilon below
    /// the horizon of a hemisphere: the rounding error of generated directions.
    bool contains(std::span<const double> point) const override {
        constexpr double slack = 8 * std::numeric_limits<double>::epsilon();
        const Vector3 v{point[0], point[1], point[2]};
        return std::abs(length(v) - 1) <= slack &&
               (!Lobe::hemisphere || dot(v, frame_.z) >= -slack);
    }
    Box bounding_box() const override {
        Box box{{-1, -1, -1}, {1, 1, 1}};
        for (std::size_t k = 0; k < 3 && Lobe::hemisphere; ++k) {
            const double z = frame_.z[k];
            // half the horizon's extent along axis k
            const double across = std::sqrt(std::max(0.0, 1 - z * z));
            if (z > 0)
                box.low[k] = -across;
            else
                box.high[k] = across;
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        if (!contains(point)) return 0;
        const Vector3 local = frame_.in({point[0], point[1], point[2]});
        return lobe_.density(local);
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const Vector3 local = frame_.in({point[0], point[1], point[2]});
        put_clamped<2>({lobe_.fraction(local), turns_of(local[0], local[1])}, cube);
    }
    /// Returns the horizon of a hemisphere; for other lobes, circles about the axis that contain
    /// between 1 % and almost all of the probability, so that integration does not miss peaks.
    std::optional<SphereShape> sphere_shape() const override {
        if constexpr (Lobe::hemisphere)
            return SphereShape{.circles = {{frame_.z, 0}},
                               .level = lobe_.level(),
                               .pole = SphereShape::Pole{frame_.z, true}};
        else
            return steep_circles();
    }
    std::optional<Moments> moments() const override {
        return axial_moments(lobe_.moments(), frame_);
    }
    std::vector<std::string> cube_axes() const override {
        return {"probability of the cone about the axis", "longitude in turns"};
    }

  private:
    SphereShape steep_circles() const {
        SphereShape found{
            .circles = {}, .level = false, .pole = SphereShape::Pole{frame_.z, false}};
        for (const double u : {0.01, 0.5, 0.99, 1 - 1e-6, 1 - 1e-12})
            found.circles.push_back({frame_.z, lobe_.forward(u).cos});
        return found;
    }

    Lobe lobe_;
    Frame frame_;
};

/// Maps the square to directions of a lobe about the z axis of a frame.
template <class Lobe>
struct ByLobe {
    Lobe lobe;
    Frame frame;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const auto [cosine, sine] = lobe.forward(xi[0]);
        const auto [x, y] = cos_sin_turns(xi[1]);
        return frame.out({sine * x, sine * y, cosine});
    }
};

template <class Lobe>
std::unique_ptr<Mapping> lobe_mapping(const Lobe& lobe, const Frame& frame, std::string spec) {
    return row_mapping(std::make_shared<LobeDomain<Lobe>>(lobe, frame, std::move(spec)),
                       ByLobe<Lobe>{lobe, frame});
}

}  // namespace stipple::warps
