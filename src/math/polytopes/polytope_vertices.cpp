// SPDX-License-Identifier: MIT
#include "math/polytopes/polytope_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace stipple {
namespace {

constexpr double tolerance = 1e-11;
constexpr std::size_t most_vertices = 10'000;
constexpr std::size_t most_comparisons = 400'000'000;  // of vertices, a second

/// The place of a vertex as that of the planes on which it lies, by Gauss's elimination with the
/// largest pivots; of more planes than coordinates, those that are told apart best.
class PlaneSystem {
  public:
    PlaneSystem(const PolytopeVertices& polytope, const PlaneSet& on) : d_(polytope.dimension) {
        for (std::size_t j = 0; j < polytope.planes.size(); ++j)
            if (on[j]) rows_.push_back({polytope.planes[j].normal, polytope.planes[j].bound});
    }

    /// False where the planes have more than a point in common.
    bool solve(PolytopePoint& at) {
        for (std::size_t step = 0; step < d_; ++step)
            if (!eliminate(step)) return false;
        for (std::size_t step = 0; step < d_; ++step)
            at[columns_[step]] = rows_[step].bound / rows_[step].normal[columns_[step]];
        return true;
    }

  private:
    struct Row {
        PolytopePoint normal;
        double bound;
    };

    bool eliminate(std::size_t step) {
        std::size_t row = step, column = 0;
        double largest = 1e-8;
        for (std::size_t i = step; i < rows_.size(); ++i)
            for (std::size_t k = 0; k < d_; ++k)
                if (std::abs(rows_[i].normal[k]) > largest) {
                    largest = std::abs(rows_[i].normal[k]);
                    row = i;
                    column = k;
                }
        if (largest == 1e-8) return false;
        std::swap(rows_[step], rows_[row]);
        columns_[step] = column;
        const Row pivot = rows_[step];
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const double factor = rows_[i].normal[column] / pivot.normal[column];
            if (i == step || factor == 0) continue;
            for (std::size_t k = 0; k < d_; ++k) rows_[i].normal[k] -= factor * pivot.normal[k];
            rows_[i].normal[column] = 0;
            rows_[i].bound -= factor * pivot.bound;
        }
        return true;
    }

    std::size_t d_;
    std::vector<Row> rows_;
    std::array<std::size_t, most_polytope_dimensions> columns_{};
};

class DoubleDescription {
  public:
    explicit DoubleDescription(std::size_t d) : d_(d), polytope_{d, {}, {}} {
        for (std::size_t k = 0; k < d; ++k)
            for (const bool top : {false, true}) {
                PolytopePlane face{.normal = {}, .bound = top ? 1.0 : 0.0};
                face.normal[k] = top ? 1 : -1;
                polytope_.planes.push_back(face);
            }
        for (std::size_t corner = 0; corner < (std::size_t{1} << d); ++corner) {
            PolytopeVertex vertex{};
            for (std::size_t k = 0; k < d; ++k) {
                const std::size_t top = corner >> k & 1;
                vertex.at[k] = static_cast<double>(top);
                vertex.planes.set(2 * k + top);
            }
            polytope_.all.push_back(vertex);
        }
    }

    void cut(const HalfSpace& half) {
        const PolytopePlane plane = plane_of(half);
        const std::vector<double> slack = slacks(plane);
        const auto [least, most] = std::ranges::minmax(slack);
        if (least >= -tolerance) return;  // it cuts nothing off
        if (most < -tolerance)
            fail(ErrorKind::usage, "no point in the ranges satisfies '{}'{}", half.text,
                 polytope_.planes.size() > 2 * d_ ? " and those before it" : "");
        if (polytope_.planes.size() == most_polytope_planes)
            fail(ErrorKind::limit, "more than {} inequalities cut something off",
                 most_polytope_planes - 2 * d_);
        if (most <= tolerance && flat_.empty()) flat_ = half.text;
        const std::size_t number = polytope_.planes.size();
        polytope_.planes.push_back(plane);
        keep(slack, number);
    }

    /// What is left.
    PolytopeVertices take() {
        if (!flat_.empty())
            fail(ErrorKind::usage, "the polytope is flat: '{}' can only hold as an equality",
                 flat_);
        for (PolytopeVertex& vertex : polytope_.all) settle(vertex);
        keep_facets();
        std::ranges::sort(polytope_.all, [](const PolytopeVertex& a, const PolytopeVertex& b) {
            const std::size_t of_a = a.planes.count();
            const std::size_t of_b = b.planes.count();
            return of_a != of_b ? of_a > of_b : a.at < b.at;
        });
        return std::move(polytope_);
    }

  private:
    /// Takes out the planes whose vertices all lie on another one.
    void keep_facets() {
        const std::size_t planes = polytope_.planes.size();
        std::vector<std::size_t> vertices(planes);
        std::vector<PlaneSet> shared(planes, PlaneSet().set());  // by all vertices of a plane
        for (const PolytopeVertex& vertex : polytope_.all)
            for (std::size_t j = 0; j < planes; ++j)
                if (vertex.planes[j]) {
                    ++vertices[j];
                    shared[j] &= vertex.planes;
                }
        std::vector<PolytopePlane> facets;
        std::vector<std::size_t> number;  // of the facets, among the planes
        for (std::size_t j = 0; j < planes; ++j) {
            bool within = vertices[j] == 0;
            for (std::size_t i = 0; i < planes && !within; ++i)
                within = i != j && shared[j][i] &&
                         (vertices[i] > vertices[j] || (vertices[i] == vertices[j] && i < j));
            if (within) continue;
            facets.push_back(polytope_.planes[j]);
            number.push_back(j);
        }
        polytope_.planes = std::move(facets);
        for (PolytopeVertex& vertex : polytope_.all) {
            PlaneSet of_facets;
            for (std::size_t k = 0; k < number.size(); ++k) of_facets[k] = vertex.planes[number[k]];
            vertex.planes = of_facets;
        }
    }

    PolytopePlane plane_of(const HalfSpace& half) const {
        double largest = 0;
        for (const double a : half.normal) largest = std::max(largest, std::abs(a));
        double square = 0;
        for (const double a : half.normal) square += a / largest * (a / largest);
        const double length = std::sqrt(square);
        PolytopePlane plane{
            .normal = {}, .bound = half.bound / largest / length, .text = half.text};
        for (std::size_t k = 0; k < d_; ++k) plane.normal[k] = half.normal[k] / largest / length;
        return plane;
    }

    std::vector<double> slacks(const PolytopePlane& plane) const {
        std::vector<double> slack;
        for (const PolytopeVertex& vertex : polytope_.all)
            slack.push_back(plane.slack(vertex.at.data(), d_));
        return slack;
    }

    /// Keeps what is not beyond a plane, and adds the vertices of edges that cross it.
    void keep(const std::vector<double>& slack, std::size_t number) {
        std::vector<PolytopeVertex> kept;
        for (std::size_t i = 0; i < slack.size(); ++i)
            if (slack[i] >= -tolerance) {
                kept.push_back(polytope_.all[i]);
                if (slack[i] <= tolerance) kept.back().planes.set(number);
            }
        for (std::size_t i = 0; i < slack.size(); ++i)
            for (std::size_t j = 0; slack[i] > tolerance && j < slack.size(); ++j)
                if (slack[j] < -tolerance && have_an_edge(i, j))
                    kept.push_back(between(i, j, slack[i] / (slack[i] - slack[j]), number));
        if (kept.size() > most_vertices)
            fail(ErrorKind::limit, "the polytope has more than {} vertices", most_vertices);
        polytope_.all = std::move(kept);
    }

    bool have_an_edge(std::size_t i, std::size_t j) {
        const auto& all = polytope_.all;
        const PlaneSet both = all[i].planes & all[j].planes;
        if (both.count() + 1 < d_) return false;
        std::size_t k = 0;
        while (k < all.size() && (k == i || k == j || (both & ~all[k].planes).any())) ++k;
        comparisons_ += k;
        if (comparisons_ > most_comparisons)
            fail(ErrorKind::limit, "the polytope has {} vertices or more, with too many edges",
                 all.size());
        return k == all.size();
    }

    /// Where an edge crosses the plane of that number.
    PolytopeVertex between(std::size_t i, std::size_t j, double share, std::size_t number) const {
        const PolytopeVertex& a = polytope_.all[i];
        const PolytopeVertex& b = polytope_.all[j];
        PolytopeVertex vertex{.at = {}, .planes = a.planes & b.planes};
        vertex.planes.set(number);
        for (std::size_t k = 0; k < d_; ++k) vertex.at[k] = a.at[k] + share * (b.at[k] - a.at[k]);
        settle(vertex);
        return vertex;
    }

    /// Puts a vertex where its planes meet, as long as they say so clearly.
    void settle(PolytopeVertex& vertex) const {
        PolytopePoint at{};
        if (!PlaneSystem(polytope_, vertex.planes).solve(at)) return;
        for (std::size_t k = 0; k < d_; ++k)
            if (!(std::abs(at[k] - vertex.at[k]) < 1e-7)) return;
        vertex.at = at;
    }

    std::size_t d_;
    PolytopeVertices polytope_;
    std::size_t comparisons_ = 0;
    std::string flat_;  ///< the inequality that left no volume
};

}  // namespace

PolytopeVertices polytope_vertices(std::size_t d, const std::vector<HalfSpace>& cuts) {
    DoubleDescription description(d);
    for (const HalfSpace& half : cuts) description.cut(half);
    return description.take();
}

}  // namespace stipple
