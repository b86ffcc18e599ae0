// SPDX-License-Identifier: MIT
#include "math/polytopes/face_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "core/rng.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_faces = 200'000;
constexpr std::size_t most_facets = 500'000;
constexpr std::size_t most_plane_tests = 400'000'000;  // comparisons: about a second

double dot(const PolytopePoint& a, const PolytopePoint& b, std::size_t d) {
    double sum = 0;
    for (std::size_t k = 0; k < d; ++k) sum += a[k] * b[k];
    return sum;
}

/// Parts of a face below this fraction of its volume are dropped: random numbers hardly reach them.
constexpr double least_share = 1e-14;

/// Rounding error of a point's distance from a plane.
constexpr double rounding = 0x1p-48;

STIPPLE_WIDE void square_roots(double* x, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) x[i] = std::sqrt(x[i]);
}

STIPPLE_WIDE [[gnu::flatten]] void roots(double* x, double m, std::size_t rows) {
    const double share = 1 / m;
    for (std::size_t i = 0; i < rows; ++i)
        x[i] = exponential(share * logarithm(std::max(x[i], 1e-300)));
}

// Uniform weights of a simplex, w_0, w_1, ... >= 0 with sum 1, are split off one after another. If
// the previous weights leave r, and m weights follow, then the next weight leaves r xi^(1 / m).
// Large weights correspond to small xi, where doubles have the finest resolution, so rounding
// errors are below 2^-52 everywhere (M. Rosenblatt, Annals of Mathematical Statistics 23 (1952)
// 470-472, doi:10.1214/aoms/1177729394).

/// Splits the next weight off each row's rest, and stores it in place of xi; takes 6 ns per row.
void break_off(double* xi, double* rest, std::size_t m, std::size_t rows) {
    if (m == 2) square_roots(xi, rows);
    if (m > 2) roots(xi, static_cast<double>(m), rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const double left = rest[i] * xi[i];
        xi[i] = rest[i] - left;
        rest[i] = left;
    }
}

}  // namespace

class FaceTree::Builder {
  public:
    Builder(FaceTree& tree, const PolytopeVertices& polytope) : tree_(tree), of_(polytope) {}

    void build() {
        std::vector<std::uint32_t> all(of_.all.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        const Node polytope{.members = all, .planes = planes_of(all)};
        tree_.volume_ = built_[face(polytope, tree_.d_)].volume;
    }

  private:
    struct Node {
        std::vector<std::uint32_t> members;  ///< indices of vertices, increasing
        PlaneSet planes;                     ///< planes that contain all members
    };
    /// A facet of a face, and the plane of the facet within the face.
    struct Part {
        Facet facet;
        PolytopePoint normal;  ///< unit vector within the face, from the facet towards the apex
        double offset;         ///< normal . x on the facet
    };
    struct Built {
        double volume;           ///< k-dimensional volume of a face of dimension k
        std::uint32_t heaviest;  ///< facet with the largest volume; for a vertex the vertex itself
    };

    PlaneSet planes_of(const std::vector<std::uint32_t>& members) const {
        PlaneSet planes = of_.all[members[0]].planes;
        for (const std::uint32_t i : members) planes &= of_.all[i].planes;
        return planes;
    }

    std::uint32_t face(const Node& node, std::size_t dimension) {
        if (const auto known = numbers_.find(node.planes); known != numbers_.end())
            return known->second;
        double volume = dimension == 0 ? 1 : 0;
        std::vector<Part> parts;
        if (dimension > 0 && node.members.size() > dimension)
            for (const Node& facet : facets_of(node)) {
                Part part = part_of(node.members[0], face(facet, dimension - 1));
                part.facet.share *= part.facet.height / static_cast<double>(dimension);
                if (!(part.facet.share > 0)) continue;
                volume += part.facet.share;
                parts.push_back(part);
            }
        return add({node.members[0], static_cast<std::uint32_t>(dimension), 0, 0}, node.planes,
                   volume, std::move(parts));
    }

    std::uint32_t add(Face face, const PlaneSet& planes, double volume, std::vector<Part> parts) {
        const std::size_t number = tree_.faces_.size();
        if (number == most_faces || tree_.facets_.size() > most_facets) refuse_many();
        std::erase_if(parts, [&](const Part& p) { return p.facet.share < least_share * volume; });
        double sum = 0;
        Built built{volume, static_cast<std::uint32_t>(number)};
        double heaviest = 0;
        for (Part& part : parts) {
            part.facet.before = sum;
            sum += part.facet.share;
            if (part.facet.share > heaviest) built.heaviest = part.facet.face;
            heaviest = std::max(heaviest, part.facet.share);
        }
        face.first = tree_.facets_.size();
        face.count = parts.size();
        for (Part& part : parts) {
            part.facet.before /= sum;
            part.facet.share /= sum;
            tree_.facets_.push_back(part.facet);
            for (std::size_t k = 0; k < tree_.d_; ++k) tree_.normals_.push_back(part.normal[k]);
            tree_.normals_.push_back(part.offset);
        }
        tree_.faces_.push_back(face);
        built_.push_back(built);
        numbers_.emplace(planes, static_cast<std::uint32_t>(number));
        return static_cast<std::uint32_t>(number);
    }

    /// Describes a facet; `share` is set to its volume. The facet's space is spanned by the apexes
    /// along the path through the heaviest facets, because these are far apart.
    Part part_of(std::size_t apex, std::uint32_t number) const {
        const std::size_t d = tree_.d_;
        std::vector<PolytopePoint> span;  // orthonormal directions from the facet's apex
        const std::size_t origin = tree_.faces_[number].apex;
        const auto across = [&](std::size_t vertex, double& length) {
            PolytopePoint way{};
            for (std::size_t k = 0; k < d; ++k)
                way[k] = of_.all[vertex].at[k] - of_.all[origin].at[k];
            for (int pass = 0; pass < 2; ++pass)
                for (const PolytopePoint& other : span) {
                    const double along = dot(way, other, d);
                    for (std::size_t k = 0; k < d; ++k) way[k] -= along * other[k];
                }
            length = std::sqrt(dot(way, way, d));
            for (std::size_t k = 0; k < d && length > 0; ++k) way[k] /= length;
            return way;
        };
        double length = 0;
        for (std::uint32_t face = number; built_[face].heaviest != face;) {
            face = built_[face].heaviest;
            span.push_back(across(tree_.faces_[face].apex, length));
        }
        const PolytopePoint normal = across(apex, length);
        return {.facet = {number, 0, built_[number].volume, length},
                .normal = normal,
                .offset = dot(normal, of_.all[origin].at, d)};
    }

    [[noreturn]] void refuse_many() const {
        fail(ErrorKind::limit, "the polytope has {} vertices, and more than {} faces",
             of_.all.size(), tree_.faces_.size());
    }

    /// Facets of a face that do not contain its apex.
    std::vector<Node> facets_of(const Node& face) {
        std::vector<Node> parts;
        for (std::size_t j = 0; j < of_.planes.size(); ++j) {
            if (face.planes[j]) continue;
            Node part;
            for (const std::uint32_t i : face.members)
                if (of_.all[i].planes[j]) part.members.push_back(i);
            if (part.members.empty()) continue;
            part.planes = planes_of(part.members);
            if (std::ranges::find(parts, part.planes, &Node::planes) == parts.end())
                parts.push_back(std::move(part));
        }
        comparisons_ += of_.planes.size() * face.members.size() + parts.size() * parts.size();
        if (comparisons_ > most_plane_tests) refuse_many();
        std::vector<Node> facets;
        for (const Node& part : parts) {
            const bool within_another = std::ranges::any_of(parts, [&](const Node& other) {
                return other.planes != part.planes && (other.planes & ~part.planes).none();
            });
            if (!within_another && part.members[0] != face.members[0]) facets.push_back(part);
        }
        return facets;
    }

    FaceTree& tree_;
    const PolytopeVertices& of_;
    std::unordered_map<PlaneSet, std::uint32_t> numbers_;
    std::vector<Built> built_;
    std::size_t comparisons_ = 0;
};

FaceTree::FaceTree(const PolytopeVertices& polytope) : d_(polytope.dimension) {
    for (const PolytopeVertex& vertex : polytope.all) vertices_.push_back(vertex.at);
    Builder(*this, polytope).build();
}

/// Selects a facet of the face by u in [0, 1), and replaces u by (u - before) / share.
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

/// Facets on the path from the polytope to a point, and the position along the last edge.
struct FaceTree::Path {
    std::array<const Facet*, most_polytope_dimensions> facets;
    double last = 0;
};

/// Position of the path that u selects relative to `path`, in the order of increasing u: -1 before
/// it, 1 after it, 0 if they are the same.
int FaceTree::side_of(const Path& path, double u) const {
    std::size_t face = faces_.size() - 1;
    for (std::size_t k = 0; k < d_; ++k) {
        const Facet* facet = &chosen(face, u);
        if (facet != path.facets[k]) return facet < path.facets[k] ? -1 : 1;
        face = facet->face;
    }
    return 0;
}

/// Computes xi_1, the number that selects the path; corrects it if rounding changed the path.
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
    PolytopePoint left{};  // the point minus the apexes times their weights
    std::copy_n(point, d_, left.begin());
    Path path{};
    double rest = 1;
    std::size_t face = faces_.size() - 1;
    for (std::size_t k = 0; k < d_; ++k) {
        double least = std::numeric_limits<double>::infinity();
        double weight = 0;
        path.facets[k] = facets(face).data();
        const double* normal = &normals_[faces_[face].first * (d_ + 1)];
        for (const Facet& facet : facets(face)) {
            double above = -rest * normal[d_];
            for (std::size_t j = 0; j < d_; ++j) above += normal[j] * left[j];
            normal += d_ + 1;
            // Adding `rounding` avoids facets whose plane is almost through the apex.
            if (const double w = (above + rounding) / facet.height; w < least) {
                least = w;
                weight = above / facet.height;
                path.facets[k] = &facet;
            }
        }
        weight = std::clamp(weight, 0.0, rest);
        const double share = rest > 0 ? (rest - weight) / rest : 0;
        if (k + 1 < d_)
            cube[k + 1] = whole_power(share, d_ - k);
        else
            cube[0] = number_of(path, share);
        const PolytopePoint& apex = vertices_[faces_[face].apex];
        for (std::size_t j = 0; j < d_; ++j) left[j] -= weight * apex[j];
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

// A point of a face of k dimensions is v (1 - s) + s y, where v is its apex, y a point of a facet,
// and s has the density k s^(k-1), so that E s^a (1 - s)^b = k (k+a-1)! b! / (k+a+b)!.

std::vector<double> FaceTree::means(std::size_t i) const {
    return over_faces([&](const auto& of, std::size_t face, std::size_t apex, double k) {
        const double v = vertices_[apex][i];
        return k == 0 ? v : (v + k * of[face]) / (k + 1);
    });
}

Moments FaceTree::moments() const {
    Moments m{std::vector<double>(d_), std::vector<double>(d_ * d_), std::vector<double>(d_)};
    std::vector<std::vector<double>> first(d_), second(d_);  // moments of each face about m.mean
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
