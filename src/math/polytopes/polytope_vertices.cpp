// SPDX-License-Identifier: MIT
#include "math/polytopes/polytope_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "math/arithmetic/double_double.hpp"

namespace stipple {
namespace {

constexpr double on_plane = 1e-13;  // a slack below it counts as 0
constexpr double flat = 1e-11;
constexpr std::size_t most_vertices = 10'000;
constexpr std::size_t most_comparisons = 400'000'000;  // comparisons of vertices: about a second

using Precise = std::array<DoubleDouble, most_polytope_dimensions>;

DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + DoubleDouble{-b.high, -b.low};
}

DoubleDouble full_quotient(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble rest = a - b * DoubleDouble{first};
    const double second = rest.high / b.high;
    return exact_sum(first, second) + DoubleDouble{(rest - b * DoubleDouble{second}).high / b.high};
}

/// A half-space scaled by a power of 2, so that its coefficients are exact and of order 1.
struct Cut {
    PolytopePoint normal{};
    double bound = 0;
    double length = 0;  ///< length of the normal
    std::string text = {};

    explicit Cut(const HalfSpace& half) : text(half.text) {
        double largest = 0;
        for (const double a : half.normal) largest = std::max(largest, std::abs(a));
        const int exponent = -std::ilogb(largest);
        bound = std::ldexp(half.bound, exponent);
        double square = 0;
        for (std::size_t k = 0; k < half.normal.size(); ++k) {
            normal[k] = std::ldexp(half.normal[k], exponent);
            square += normal[k] * normal[k];
        }
        length = std::sqrt(square);
    }

    /// Distance of y from the plane, multiplied by `length`; negative outside the half-space.
    [[nodiscard]] DoubleDouble slack(const Precise& y, std::size_t d) const {
        DoubleDouble sum{bound};
        for (std::size_t k = 0; k < d; ++k) sum = sum - DoubleDouble{normal[k]} * y[k];
        return sum;
    }
};

class DoubleDescription {
  public:
    explicit DoubleDescription(std::size_t d) : d_(d) {
        for (std::size_t k = 0; k < d; ++k)
            for (const double sign : {-1.0, 1.0}) {
                HalfSpace face{.normal = std::vector<double>(d), .bound = sign > 0 ? 1.0 : 0.0};
                face.normal[k] = sign;
                planes_.emplace_back(face);
            }
        for (std::size_t corner = 0; corner < (std::size_t{1} << d); ++corner) {
            Vertex vertex;
            for (std::size_t k = 0; k < d; ++k) {
                const std::size_t top = corner >> k & 1;
                vertex.at[k] = {static_cast<double>(top)};
                vertex.planes.set(2 * k + top);
            }
            vertices_.push_back(vertex);
        }
    }

    void cut(const HalfSpace& half) {
        const Cut cut(half);
        std::vector<DoubleDouble> slack;
        double least = 0, most = -1;
        for (const Vertex& vertex : vertices_) {
            slack.push_back(cut.slack(vertex.at, d_));
            least = std::min(least, slack.back().high / cut.length);
            most = std::max(most, slack.back().high / cut.length);
        }
        if (least >= -on_plane) return;  // cuts nothing off
        if (most <= flat && flat_.empty() && most >= -flat) flat_ = half.text;
        if (most < -on_plane) {
            check_flat();
            fail(ErrorKind::usage, "no point in the ranges satisfies '{}'{}", half.text,
                 planes_.size() > 2 * d_ ? " and the inequalities before it" : "");
        }
        if (planes_.size() == most_polytope_planes)
            fail(ErrorKind::limit, "more than {} inequalities exclude part of the ranges",
                 most_polytope_planes - 2 * d_);
        planes_.push_back(cut);
        keep(slack);
    }

    PolytopeVertices take() {
        check_flat();
        const std::vector<std::size_t> facets = this->facets();
        PolytopeVertices left{.dimension = d_, .planes = {}, .all = {}};
        for (const std::size_t j : facets) {
            const Cut& cut = planes_[j];
            PolytopePlane plane{.normal = {}, .bound = cut.bound / cut.length};
            for (std::size_t k = 0; k < d_; ++k) plane.normal[k] = cut.normal[k] / cut.length;
            left.planes.push_back(plane);
        }
        for (const Vertex& vertex : vertices_) {
            PolytopeVertex rounded{};
            for (std::size_t k = 0; k < d_; ++k) rounded.at[k] = vertex.at[k].high;
            for (std::size_t j = 0; j < facets.size(); ++j)
                rounded.planes[j] = vertex.planes[facets[j]];
            left.all.push_back(rounded);
        }
        std::ranges::sort(left.all, [](const PolytopeVertex& a, const PolytopeVertex& b) {
            const std::size_t of_a = a.planes.count();
            const std::size_t of_b = b.planes.count();
            return of_a != of_b ? of_a > of_b : a.at < b.at;
        });
        return left;
    }

  private:
    struct Vertex {
        Precise at{};
        PlaneSet planes{};
    };

    void check_flat() const {
        if (!flat_.empty())
            fail(ErrorKind::usage, "the polytope is flat: '{}' can only hold as an equality",
                 flat_);
    }

    /// Keeps the vertices not beyond the last plane, and adds one for each edge that crosses it.
    void keep(const std::vector<DoubleDouble>& slack) {
        const double near = on_plane * planes_.back().length;
        std::vector<Vertex> kept;
        for (std::size_t i = 0; i < slack.size(); ++i)
            if (slack[i].high >= -near) {
                kept.push_back(vertices_[i]);
                if (slack[i].high <= near) kept.back().planes.set(planes_.size() - 1);
            }
        for (std::size_t i = 0; i < slack.size(); ++i)
            for (std::size_t j = 0; slack[i].high > near && j < slack.size(); ++j)
                if (slack[j].high < -near && have_an_edge(i, j))
                    kept.push_back(between(i, j, full_quotient(slack[i], slack[i] - slack[j])));
        if (kept.size() > most_vertices)
            fail(ErrorKind::limit, "the polytope has more than {} vertices", most_vertices);
        vertices_ = std::move(kept);
    }

    bool have_an_edge(std::size_t i, std::size_t j) {
        const PlaneSet both = vertices_[i].planes & vertices_[j].planes;
        if (both.count() + 1 < d_) return false;
        std::size_t k = 0;
        while (k < vertices_.size() && (k == i || k == j || (both & ~vertices_[k].planes).any()))
            ++k;
        comparisons_ += k;
        if (comparisons_ > most_comparisons)
            fail(ErrorKind::limit, "the polytope has at least {} vertices and too many edges",
                 vertices_.size());
        return k == vertices_.size();
    }

    /// Intersection of an edge with the last plane.
    Vertex between(std::size_t i, std::size_t j, const DoubleDouble& share) const {
        const Vertex& a = vertices_[i];
        const Vertex& b = vertices_[j];
        Vertex vertex{.at = {}, .planes = a.planes & b.planes};
        vertex.planes.set(planes_.size() - 1);
        for (std::size_t k = 0; k < d_; ++k) vertex.at[k] = a.at[k] + share * (b.at[k] - a.at[k]);
        return vertex;
    }

    /// Indices of planes that contain a facet; if several contain the same facet, the first one.
    std::vector<std::size_t> facets() const {
        std::vector<std::size_t> vertices(planes_.size());
        // For each plane, the planes that contain all of its vertices.
        std::vector<PlaneSet> shared(planes_.size(), PlaneSet().set());
        for (const Vertex& vertex : vertices_)
            for (std::size_t j = 0; j < planes_.size(); ++j)
                if (vertex.planes[j]) {
                    ++vertices[j];
                    shared[j] &= vertex.planes;
                }
        std::vector<std::size_t> facets;
        for (std::size_t j = 0; j < planes_.size(); ++j) {
            bool within = vertices[j] == 0;
            for (std::size_t i = 0; i < planes_.size() && !within; ++i)
                within = i != j && shared[j][i] &&
                         (vertices[i] > vertices[j] || (vertices[i] == vertices[j] && i < j));
            if (!within) facets.push_back(j);
        }
        return facets;
    }

    std::size_t d_;
    std::vector<Cut> planes_;  ///< those of the cube first
    std::vector<Vertex> vertices_;
    std::size_t comparisons_ = 0;
    std::string flat_;  ///< text of the inequality that left no volume
};

}  // namespace

PolytopeVertices polytope_vertices(std::size_t d, const std::vector<HalfSpace>& cuts) {
    DoubleDescription description(d);
    for (const HalfSpace& half : cuts) description.cut(half);
    return description.take();
}

}  // namespace stipple
