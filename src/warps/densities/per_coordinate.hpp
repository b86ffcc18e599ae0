// SPDX-License-Identifier: MIT
//
// A mapping that gives each coordinate a law on the line, by inversion, whatever the others are:
//
//     struct Law {
//         double forward(double u) const;           // [0, 1] to the line; or in two steps, a
//         std::array<double, s> start(double u) const;  // what a search finds, and the rest, for
//         double finish(double u, const std::array<double, s>& start) const;  // many at a time
//         double inverse(double x) const;           // and back
//         double place(double x) const;             // coordinate in the domain's cube
//         double density(double x) const;           // 0 outside
//         bool contains(double x) const;
//         double measure() const;                   // of all that it contains
//         std::pair<double, double> range() const;  // what a picture shows
//         LineMoments moments() const;              // if they are known
//         double mass(double low, double high) const;   // only if places are not even
//         std::vector<std::pair<double, double>> parts() const;  // if the density has gaps: where
//                                                                // it is not 0, side by side
//         double positive_measure() const;              // instead, where it has no length
//     };
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/box_mass.hpp"
#include "core/error.hpp"
#include "core/support.hpp"
#include "core/wide.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/pace.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps {

/// Each coordinate by a law of its own, independent of the others.
template <class Law>
class LineDomain final : public Domain, public Gapped, public Weighable {
  public:
    /// @param what what place() is, for people
    LineDomain(std::vector<Law> laws, std::string spec, std::string what)
        : laws_(std::move(laws)), spec_(std::move(spec)), what_(std::move(what)) {}

    std::string spec() const override { return spec_; }
    std::size_t dimension() const override { return laws_.size(); }
    double measure() const override {
        double product = 1;
        for (const Law& law : laws_) product *= law.measure();
        return product;
    }
    bool contains(std::span<const double> point) const override {
        for (std::size_t k = 0; k < laws_.size(); ++k)
            if (!laws_[k].contains(point[k])) return false;
        return true;
    }
    Box bounding_box() const override {
        Box box;
        for (const Law& law : laws_) {
            const auto [low, high] = law.range();
            box.low.push_back(low);
            box.high.push_back(high);
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        double product = 1;
        for (std::size_t k = 0; k < laws_.size(); ++k) product *= laws_[k].density(point[k]);
        return product;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        for (std::size_t k = 0; k < laws_.size(); ++k)
            cube[k] = std::clamp(laws_[k].place(point[k]), 0.0, 1.0);
    }
    bool even() const override { return !has_masses; }
    Estimate probability(const Box& cell) const override {
        double product = 1;
        for (std::size_t k = 0; k < laws_.size(); ++k) {
            if constexpr (has_masses)
                product *= laws_[k].mass(cell.low[k], cell.high[k]);
            else
                product *= cell.extent(k);
        }
        return {product, 0};
    }
    Estimate box_mass(const Box& box) const override { return box_mass_by_axes(*this, box); }
    std::optional<Moments> moments() const override {
        if constexpr (requires { &Law::moments; }) {
            std::vector<LineMoments> each;
            for (const Law& law : laws_) each.push_back(law.moments());
            return independent_moments(each);
        } else {
            return std::nullopt;
        }
    }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes;
        for (std::size_t k = 0; k < laws_.size(); ++k)
            axes.push_back(laws_.size() == 1 ? what_ : fmt::format("{} of x{}", what_, k + 1));
        return axes;
    }

    Support support() const override {
        Support all{.measure = Estimate{1, 0}, .boxes = {Box{}}};
        for (const Law& law : laws_) {
            if constexpr (requires { &Law::parts; }) {
                const auto parts = law.parts();
                double length = 0;
                for (const auto& [low, high] : parts) length += high - low;
                add_axis(all, parts, length, law.measure());
            } else if constexpr (requires { &Law::positive_measure; }) {
                add_axis(all, {}, law.positive_measure(), law.measure());
            } else {
                add_axis(all, {law.range()}, law.measure(), law.measure());
            }
        }
        all.finite = all.measure->value < std::numeric_limits<double>::infinity();
        if (!all.finite) all.measure.reset();
        return all;
    }

    bool shows_gaps() const override { return true; }

    const std::vector<Law>& laws() const { return laws_; }

  private:
    /// Makes boxes of those before and the parts of one more coordinate.
    static void add_axis(Support& all, const std::vector<std::pair<double, double>>& parts,
                         double length, double whole) {
        constexpr std::size_t many = 64;
        all.whole = all.whole && length >= whole;
        all.measure->value *= length;
        std::vector<Box> boxes;
        if (all.boxes.size() * parts.size() <= many)
            for (const Box& before : all.boxes)
                for (const auto& [low, high] : parts) {
                    boxes.push_back(before);
                    boxes.back().low.push_back(low);
                    boxes.back().high.push_back(high);
                }
        all.boxes = std::move(boxes);
    }

    static constexpr bool has_masses = requires { &Law::mass; };

    std::vector<Law> laws_;
    std::string spec_;
    std::string what_;
};

template <class Law>
double image_of(const Law& law, double u) {
    if constexpr (HasStart<Law>)
        return law.finish(u, law.start(u));
    else
        return law.forward(u);
}

/// Up to `paced` numbers, with room of their own in between: what is written there is none of the
/// law's tables.
template <class Law>
inline void map_in_steps(const Law& law, const double* in, double* out, std::size_t count) {
    StartColumns<Law> starts;
    std::array<double, paced> images;
    Pace<std::uint32_t> pace;
    for (std::size_t i = 0; i < count; ++i) starts.put(i, law.start(in[i]));
    for (std::size_t i = 0; i < count; ++i) {
        images[i] = law.finish(in[i], starts.get(i));
        pace.mark(i);
    }
    pace.end();
    std::copy_n(images.data(), count, out);
}

// The law is taken by value: what is written to the image cannot change it, so that its constants
// stay in registers. All calls are inlined: one that is not keeps the loop from being widened.
template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void map_numbers(const Law law, std::span<const double> cube,
                                               std::span<double> image) {
    Pace<> pace;
    for (std::size_t first = 0; first < cube.size(); first += paced) {
        const double* in = cube.data() + first;
        double* out = image.data() + first;
        const std::size_t count = std::min(paced, cube.size() - first);
        if constexpr (HasStart<Law>) {
            map_in_steps(law, in, out, count);
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = image_of(law, in[i]);
            pace.mark(i);
        }
        pace.end();
    }
}

template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void map_column(const Law law, std::span<const double> cube,
                                              std::span<double> image, std::size_t first,
                                              std::size_t step) {
    for (std::size_t i = first; i < cube.size(); i += step) image[i] = image_of(law, cube[i]);
}

template <class Law>
class LineMapping final : public Mapping {
  public:
    /// @param way_back why there is no inverse; empty where there is one
    explicit LineMapping(std::shared_ptr<const LineDomain<Law>> domain, std::string way_back = {})
        : domain_(std::move(domain)), no_way_back_(std::move(way_back)) {
        const auto& laws = domain_->laws();
        same_ = std::ranges::all_of(laws, [&](const Law& law) { return law == laws[0]; });
    }

    DomainPtr domain() const override { return domain_; }
    std::size_t cube_dimension() const override { return domain_->dimension(); }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        const auto& laws = domain_->laws();
        if (same_) return map_numbers(laws[0], cube, image);
        for (std::size_t k = 0; k < laws.size(); ++k)
            map_column(laws[k], cube, image, k, laws.size());
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        if (!no_way_back_.empty()) fail(ErrorKind::usage, "--inverse: {}", no_way_back_);
        const auto& laws = domain_->laws();
        const std::size_t d = laws.size();
        for (std::size_t i = 0; i < image.size(); i += d) {
            const auto point = image.subspan(i, d);
            if (!domain_->contains(point)) refuse_outside(point, *domain_);
            for (std::size_t k = 0; k < d; ++k)
                cube[i + k] = std::clamp(laws[k].inverse(point[k]), 0.0, 1.0);
        }
    }

  private:
    std::shared_ptr<const LineDomain<Law>> domain_;
    std::string no_way_back_;
    bool same_ = true;
};

/// One of a list that holds one number for all coordinates or one for each.
inline double number_for(const std::vector<double>& numbers, std::size_t k) {
    return numbers.size() == 1 ? numbers[0] : numbers[k];
}

}  // namespace stipple::warps
