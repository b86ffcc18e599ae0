// SPDX-License-Identifier: MIT
//
// What a mixture lives on: see mixture.cpp for its cells. Their probabilities are sums over the
// components of weight times probability: of a box, the exact share of the area for shapes of the
// plane and by the distribution functions for distributions of each coordinate; of a zone of the
// sphere, by quadrature cut at the component's rim (math/geometry/zone_integral.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/zone_integral.hpp"
#include "warps/named_domain.hpp"

namespace stipple::warps {

class MixtureDomain final : public NamedDomain {
  public:
    /// Parts that give directions, or fill the same number of dimensions; weights that sum to 1.
    MixtureDomain(std::vector<DomainPtr> parts, std::vector<double> shares, std::string spec)
        : NamedDomain(std::move(spec), parts[0]->dimension(), parts[0]->cube_dimension()),
          parts_(std::move(parts)),
          weights_(std::move(shares)) {
        box_ = parts_[0]->bounding_box();
        for (const DomainPtr& part : parts_) {
            const Box box = part->bounding_box();
            box_ = stipple::bounding_box(box.low, stipple::bounding_box(box.high, box_));
        }
        fills_box_ = !directions() && std::ranges::all_of(parts_, [&](const DomainPtr& part) {
            return fills(*part);
        });
    }

    /// That of all directions where a part has them all, and of the box that each part fills; else
    /// what the parts cover together is not known, and it is taken as a part of all space.
    double measure() const override {
        const auto has_all = [&](const DomainPtr& part) {
            return part->measure() > (1 - 1e-12) * all_directions();
        };
        if (directions() && std::ranges::any_of(parts_, has_all)) return all_directions();
        return fills_box_ ? volume_of(box_) : std::numeric_limits<double>::infinity();
    }

    /// What any of the parts covers.
    Support support() const override {
        const double all = measure();
        std::vector<Support> supports;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (weights_[i] > 0) supports.push_back(parts_[i]->support());
        const auto covers = [&](const Support& part) {
            return part.whole && part.measure && part.measure->value > (1 - 1e-12) * all;
        };
        if (std::ranges::any_of(supports, covers))
            return {.measure = Estimate{all, 0}, .boxes = {}};
        const bool ends = std::ranges::all_of(supports, &Support::finite);
        return {.whole = false, .finite = ends, .boxes = {}};
    }

    bool contains(std::span<const double> point) const override {
        return std::ranges::any_of(parts_,
                                   [&](const DomainPtr& part) { return part->contains(point); });
    }
    Box bounding_box() const override { return box_; }
    double density(std::span<const double> point) const override {
        double sum = 0;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            sum += weights_[i] * parts_[i]->density(point);
        return sum;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        if (directions()) {
            cube.back() = turns_of(point[0], point[1]);
            if (dimension() == 3) cube[0] = std::clamp(0.5 * (1 - point[2]), 0.0, 1.0);
            return;
        }
        for (std::size_t k = 0; k < cube.size(); ++k) {
            const double z = (point[k] - middle(k)) / scale(k);
            cube[k] = normal_distribution(z);
        }
    }
    bool even() const override { return false; }
    Estimate probability(const Box& cell) const override {
        if (directions())
            return weighted([&](const Domain& part) { return zone_mass(part, cell); });
        Box box;
        for (std::size_t k = 0; k < dimension(); ++k) {
            box.low.push_back(edge(cell.low[k], k));
            box.high.push_back(edge(cell.high[k], k));
        }
        return box_mass(box).value();
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        return weighted([&](const Domain& part) {
            const auto mass = part.box_mass(box);
            if (!mass)
                fail(ErrorKind::limit, "{}: the probabilities of boxes of {} are not known", spec(),
                     part.spec());
            return *mass;
        });
    }
    std::optional<Moments> moments() const override {
        MixedMoments all(std::vector<double>(dimension(), 0.0));
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const auto part = parts_[i]->moments();
            if (!part) return std::nullopt;
            all.add(weights_[i], *part);
        }
        return all.moments();
    }
    std::vector<std::string> cube_axes() const override {
        if (directions() && dimension() == 3) return {"(1 - z) / 2", "longitude in turns"};
        if (directions()) return {"angle in turns"};
        std::vector<std::string> axes;
        for (std::size_t k = 0; k < dimension(); ++k)
            axes.push_back(fmt::format("normal probability of x{}", k + 1));
        return axes;
    }

  private:
    /// Whether a part fills the box around all parts.
    bool fills(const Domain& part) const {
        return part.bounding_box() == box_ &&
               std::abs(part.measure() - volume_of(box_)) <= 1e-12 * volume_of(box_);
    }
    bool directions() const { return cube_dimension() < dimension(); }
    double all_directions() const {
        return dimension() == 3 ? 4 * std::numbers::pi : 2 * std::numbers::pi;
    }
    double middle(std::size_t k) const { return box_.low[k] + 0.5 * box_.extent(k); }
    double scale(std::size_t k) const { return box_.extent(k) > 0 ? 0.25 * box_.extent(k) : 1; }

    /// Where an edge of a cell of the cube is in space.
    double edge(double u, std::size_t k) const {
        if (u <= 0 || u >= 1)
            return std::copysign(std::numeric_limits<double>::infinity(), u - 0.5);
        return middle(k) + scale(k) * normal_quantile(u);
    }

    /// The sum over the parts of their weights times what `mass` says of each.
    template <class Mass>
    Estimate weighted(const Mass& mass) const {
        Estimate sum;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (weights_[i] == 0) continue;
            const Estimate part = mass(*parts_[i]);
            sum.value += weights_[i] * part.value;
            sum.error += weights_[i] * part.error;
        }
        return sum;
    }

    /// Of directions; parts without discontinuities have zones for cells themselves.
    static Estimate zone_mass(const Domain& part, const Box& cell) {
        const auto discontinuities = part.discontinuities();
        if (!discontinuities) return part.probability(cell);
        const Zone zone{1 - 2 * cell.high[0], 1 - 2 * cell.low[0], cell.low[1], cell.high[1]};
        return integrate_zone([&](const Vector3& v) { return part.density(v); }, zone,
                              *discontinuities);
    }

    std::vector<DomainPtr> parts_;
    std::vector<double> weights_;
    Box box_;
    bool fills_box_ = false;  ///< each part does
};

}  // namespace stipple::warps
