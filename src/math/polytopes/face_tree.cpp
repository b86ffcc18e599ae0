// SPDX-License-Identifier: MIT
#include "math/polytopes/face_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "math/polytopes/simplex_map.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_faces = 200'000;
constexpr std::size_t most_facets = 2'000'000;
constexpr std::size_t most_plane_tests = 400'000'000;  // of vertices with planes, a second

[[noreturn]] void refuse_close() {
    fail(ErrorKind::limit, "planes of the polytope meet so closely that they are not told apart");
}

double dot(const PolytopePoint& a, const PolytopePoint& b, std::size_t d) {
    double sum = 0;
    for (std::size_t k = 0; k < d; ++k) sum += a[k] * b[k];
    return sum;
}

}  // namespace

/// Lists the faces from the vertices and their planes.
class FaceTree::Builder {
  public:
    Builder(FaceTree& tree, const PolytopeVertices& polytope) : tree_(tree), of_(polytope) {}

    void build() {
        std::vector<std::uint32_t> all(of_.all.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        tree_.volume_ = volumes_[face({.members = all, .planes = planes_of(all)}, {})];
    }

  private:
    struct Node {
        std::vector<std::uint32_t> members;  ///< vertices, rising
        PlaneSet planes;                     ///< that hold all of them
        std::size_t plane = 0;  ///< of those that cut it out of a larger face, the steepest
        double steepness = 0;   ///< the length of its normal within that face
        PolytopePoint normal{};
    };
    /// Orthonormal normals of a face.
    using Normals = std::vector<PolytopePoint>;

    PlaneSet planes_of(const std::vector<std::uint32_t>& members) const {
        PlaneSet planes = of_.all[members[0]].planes;
        for (const std::uint32_t i : members) planes &= of_.all[i].planes;
        return planes;
    }

    std::uint32_t face(const Node& node, const Normals& normals) {
        if (const auto known = numbers_.find(node.planes); known != numbers_.end())
            return known->second;
        const std::size_t dimension = tree_.d_ - normals.size();
        if (dimension == 0 ? node.members.size() != 1 : node.members.size() <= dimension)
            refuse_close();
        double volume = dimension == 0 ? 1 : 0;
        std::vector<Facet> facets;
        if (dimension > 0)
            for (const Node& facet : facets_of(node, normals)) {
                Normals all = normals;
                all.push_back(facet.normal);
                const std::uint32_t number = face(facet, all);
                const double height = slack(node.members[0], facet.plane) / facet.steepness;
                const double part = volumes_[number] * height / static_cast<double>(dimension);
                facets.push_back({number, static_cast<std::uint32_t>(facet.plane), volume, part});
                volume += part;
            }
        if (!(volume > 0)) refuse_close();
        return add({node.members[0], static_cast<std::uint32_t>(dimension), 0, 0}, node.planes,
                   volume, facets);
    }

    std::uint32_t add(Face face, const PlaneSet& planes, double volume,
                      const std::vector<Facet>& facets) {
        const std::size_t number = tree_.faces_.size();
        if (number == most_faces || tree_.facets_.size() > most_facets) refuse_many();
        face.first = tree_.facets_.size();
        face.count = facets.size();
        for (Facet facet : facets) {
            facet.before /= volume;
            facet.share /= volume;
            tree_.facets_.push_back(facet);
        }
        tree_.faces_.push_back(face);
        volumes_.push_back(volume);
        numbers_.emplace(planes, static_cast<std::uint32_t>(number));
        return static_cast<std::uint32_t>(number);
    }

    [[noreturn]] void refuse_many() const {
        fail(ErrorKind::limit, "the polytope has {} vertices, and more than {} faces",
             of_.all.size(), tree_.faces_.size());
    }

    /// The facets of a face that do not hold its apex.
    std::vector<Node> facets_of(const Node& face, const Normals& normals) {
        std::vector<Node> parts;
        for (std::size_t j = 0; j < of_.planes.size(); ++j) {
            if (face.planes[j]) continue;
            Node part{.members = {}, .planes = {}, .plane = j};
            for (const std::uint32_t i : face.members)
                if (of_.all[i].planes[j]) part.members.push_back(i);
            if (part.members.empty()) continue;
            part.planes = planes_of(part.members);
            take_normal(part, normals);
            const auto same = std::ranges::find(parts, part.planes, &Node::planes);
            if (same == parts.end())
                parts.push_back(std::move(part));
            else if (same->steepness < part.steepness)
                *same = std::move(part);
        }
        comparisons_ += of_.planes.size() * face.members.size() + parts.size() * parts.size();
        if (comparisons_ > most_plane_tests) refuse_many();
        std::vector<Node> facets;
        for (const Node& part : parts) {
            const bool within_another = std::ranges::any_of(parts, [&](const Node& other) {
                return other.planes != part.planes && (other.planes & ~part.planes).none();
            });
            if (within_another || part.members[0] == face.members[0]) continue;
            if (part.steepness < 1e-9) refuse_close();
            facets.push_back(part);
        }
        return facets;
    }

    /// The normal of a plane within a face.
    void take_normal(Node& part, const Normals& normals) const {
        const std::size_t d = tree_.d_;
        part.normal = of_.planes[part.plane].normal;
        for (int pass = 0; pass < 2; ++pass)
            for (const PolytopePoint& other : normals) {
                const double along = dot(part.normal, other, d);
                for (std::size_t k = 0; k < d; ++k) part.normal[k] -= along * other[k];
            }
        part.steepness = std::sqrt(dot(part.normal, part.normal, d));
        for (std::size_t k = 0; k < d && part.steepness > 0; ++k) part.normal[k] /= part.steepness;
    }

    double slack(std::size_t vertex, std::size_t plane) const {
        return tree_.slacks_[vertex * of_.planes.size() + plane];
    }

    FaceTree& tree_;
    const PolytopeVertices& of_;
    std::unordered_map<PlaneSet, std::uint32_t> numbers_;
    std::size_t comparisons_ = 0;
    std::vector<double> volumes_;  ///< each within its own space
};

FaceTree::FaceTree(PolytopeVertices polytope) : d_(polytope.dimension) {
    for (const PolytopeVertex& vertex : polytope.all) {
        vertices_.push_back(vertex.at);
        for (std::size_t j = 0; j < polytope.planes.size(); ++j)
            slacks_.push_back(vertex.planes[j]
                                  ? 0
                                  : std::max(polytope.planes[j].slack(vertex.at.data(), d_), 0.0));
    }
    Builder(*this, polytope).build();
    planes_ = std::move(polytope.planes);
}

/// The facet of a face that u in [0, 1) chooses; leaves in u where between its ends u was.
const FaceTree::Facet& FaceTree::chosen(std::size_t face, double& u) const {
    const auto all = facets(face);
    std::size_t i = 0;
    if (all.size() > 16)
        i = static_cast<std::size_t>(std::ranges::upper_bound(all, u, {}, &Facet::before) -
                                     all.begin()) -
            1;
    else
        while (i + 1 < all.size() && all[i + 1].before <= u) ++i;
    u = std::min((u - all[i].before) / all[i].share, one_minus_ulp);
    return all[i];
}

void FaceTree::forward(std::span<double* const> columns, std::size_t rows) const {
    std::array<std::array<std::uint32_t, most_polytope_dimensions + 1>, some_rows> apexes;
    for (std::size_t i = 0; i < rows; ++i) {
        double u = std::min(columns[0][i], one_minus_ulp);
        std::size_t face = faces_.size() - 1;
        for (std::size_t k = 0; k < d_; ++k) {
            apexes[i][k] = faces_[face].apex;
            face = chosen(face, u).face;
        }
        apexes[i][d_] = faces_[face].apex;
        columns[0][i] = u;
    }
    std::array<double, some_rows> rest;
    rest.fill(1);
    for (std::size_t k = 1; k < d_; ++k) break_off(columns[k], rest.data(), d_ - k + 1, rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const double u = columns[0][i];
        PolytopePoint sum{};
        const auto add = [&](double weight, std::uint32_t apex) {
            const PolytopePoint& at = vertices_[apex];
            for (std::size_t k = 0; k < d_; ++k) sum[k] += weight * at[k];
        };
        for (std::size_t k = 1; k < d_; ++k) add(columns[k][i], apexes[i][k - 1]);
        add(rest[i] * (1 - u), apexes[i][d_ - 1]);
        add(rest[i] * u, apexes[i][d_]);
        for (std::size_t k = 0; k < d_; ++k) columns[k][i] = sum[k];
    }
}

/// The facets on the way down to a point, and its place along the last edge.
struct FaceTree::Path {
    std::array<const Facet*, most_polytope_dimensions> facets;
    double last = 0;
};

/// Below 0 where u chooses facets before those of a path, above 0 where behind them.
int FaceTree::side_of(const Path& path, double u) const {
    std::size_t face = faces_.size() - 1;
    for (std::size_t k = 0; k < d_; ++k) {
        const Facet* facet = &chosen(face, u);
        if (facet != path.facets[k]) return facet < path.facets[k] ? -1 : 1;
        face = facet->face;
    }
    return 0;
}

/// xi_1 of a path; where rounding takes it over the end of its simplex, the next one within.
double FaceTree::number_of(const Path& path, double last) const {
    double u = last;
    for (std::size_t k = d_; k-- > 0;) u = path.facets[k]->before + u * path.facets[k]->share;
    u = std::clamp(u, 0.0, 1.0);
    double step = 0x1p-54;
    for (int side = side_of(path, std::min(u, one_minus_ulp)); side != 0 && step < 0x1p-40;
         step *= 2, side = side_of(path, std::min(u, one_minus_ulp)))
        u = std::clamp(side < 0 ? std::max(u + step, std::nextafter(u, 1))
                                : std::min(u - step, std::nextafter(u, 0)),
                       0.0, 1.0);
    return u;
}

void FaceTree::inverse(const double* point, double* cube) const {
    std::array<double, most_polytope_planes> slack;  // of the point, less the apexes' parts
    for (std::size_t j = 0; j < planes_.size(); ++j)
        slack[j] = std::max(planes_[j].slack(point, d_), 0.0);
    Path path{};
    double rest = 1;
    std::size_t face = faces_.size() - 1;
    for (std::size_t k = 0; k < d_; ++k) {
        const double* of_apex = &slacks_[faces_[face].apex * planes_.size()];
        double weight = std::numeric_limits<double>::infinity();
        for (const Facet& facet : facets(face))
            if (const double w = slack[facet.plane] / of_apex[facet.plane]; w < weight) {
                weight = w;
                path.facets[k] = &facet;
            }
        weight = std::clamp(weight, 0.0, rest);
        const double left = rest > 0 ? (rest - weight) / rest : 0;
        if (k + 1 < d_)
            cube[k + 1] = unit_of_share(left, d_ - k);
        else
            cube[0] = number_of(path, left);
        for (std::size_t j = 0; j < planes_.size(); ++j)
            slack[j] = std::max(slack[j] - weight * of_apex[j], 0.0);
        rest -= weight;
        face = path.facets[k]->face;
    }
}

template <class Part>
std::vector<double> FaceTree::over_faces(const Part& part) const {
    std::vector<double> of(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const auto& [apex, dimension, first, count] = faces_[f];
        const auto k = static_cast<double>(dimension);
        if (count == 0) of[f] = part(of, f, apex, 0.0);
        for (const Facet& facet : facets(f)) of[f] += facet.share * part(of, facet.face, apex, k);
    }
    return of;
}

// A point of a face of k dimensions is v (1 - s) + s y, with its apex v, a point y of a facet, and s
// of density k s^(k-1), so that E s^a (1 - s)^b = k (k+a-1)! b! / (k+a+b)!.

std::vector<double> FaceTree::means(std::size_t i) const {
    return over_faces([&](const auto& of, std::size_t face, std::size_t apex, double k) {
        const double v = vertices_[apex][i];
        return k == 0 ? v : (v + k * of[face]) / (k + 1);
    });
}

Moments FaceTree::moments() const {
    Moments m{std::vector<double>(d_), std::vector<double>(d_ * d_), std::vector<double>(d_)};
    std::vector<std::vector<double>> first(d_), second(d_);  // of all faces, about the mean
    for (std::size_t i = 0; i < d_; ++i) {
        first[i] = means(i);
        m.mean[i] = first[i].back();
        for (double& x : first[i]) x -= m.mean[i];
    }
    for (std::size_t i = 0; i < d_; ++i)
        for (std::size_t j = i; j < d_; ++j) {
            auto both =
                over_faces([&](const auto& of, std::size_t face, std::size_t apex, double k) {
                    const double v = vertices_[apex][i] - m.mean[i];
                    const double w = vertices_[apex][j] - m.mean[j];
                    if (k == 0) return v * w;
                    const double mixed = v * first[j][face] + w * first[i][face];
                    return (2 * v * w + k * mixed) / ((k + 1) * (k + 2)) + k * of[face] / (k + 2);
                });
            m.covariance[i * d_ + j] = m.covariance[j * d_ + i] = both.back();
            if (i == j) second[i] = std::move(both);
        }
    for (std::size_t i = 0; i < d_; ++i) {
        const auto third =
            over_faces([&](const auto& of, std::size_t face, std::size_t apex, double k) {
                const double v = vertices_[apex][i] - m.mean[i];
                if (k == 0) return v * v * v;
                const double low = (6 * v * v * v + 6 * k * v * v * first[i][face]) / (k + 1);
                return ((low + 3 * k * v * second[i][face]) / (k + 2) + k * of[face]) / (k + 3);
            });
        const double variance = m.covariance[i * d_ + i];
        m.skewness[i] = third.back() / (variance * std::sqrt(variance));
    }
    return m;
}

}  // namespace stipple
