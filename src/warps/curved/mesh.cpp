// SPDX-License-Identifier: MIT
//
// Unit square onto the surface of a triangle mesh, uniform by area. With the areas A_i of the
// triangles in the order of the file and their sums S_i = (A_0 + ... + A_{i-1}) / A, xi0 selects
// the triangle i with S_i <= xi0 < S_{i+1} and is rescaled for reuse:
//
//     t = (xi0 - S_i) / (S_{i+1} - S_i)
//     lambda0 = 1 - sqrt(t),  lambda1 = xi1 sqrt(t),  lambda2 = (1 - xi1) sqrt(t)
//
// which are the weights of corners 0, 1 and 2, as in the warp triangle. The sums are computed in
// twice the working precision and rounded once.
//
// Shape   2 unit coordinates; 3 coordinates, with the normal 6, with the barycentrics 7: position,
//         index of the triangle from 0, lambda0, lambda1, lambda2.
// Strata  xi0 runs through the triangles in file order, in each from corner 0 to the opposite edge;
//         xi1 runs along that edge from corner 2 to 1. xi are used directly. Strata are compact if
//         the file lists neighbouring triangles one after another.
// Cost    set-up O(n log n) for n triangles; O(1) a point forward, O(log n) inverse; on one core
//         about 22 ns forward, 740 ns inverse for 3600 triangles.
// Promise density 1 / area; a triangle's fraction of the points is exact to 2^-53. Points lie on
//         the mesh up to the rounding stated at contains(). A round trip returns the same point
//         within 1e-15 n of the mesh's size, for n triangles. If triangles coincide, a hash of the
//         point's digits selects one for the inverse, so that each gets its fraction of the points.
//         The same bits on every machine.
// Source  G. Turk, "Generating random points in triangles", in: A. S. Glassner (ed.), Graphics Gems
//         (1990) 24-28.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/densities/guide_table.hpp"
#include "math/functions/powers.hpp"
#include "math/geometry/law_moments.hpp"
#include "media/triangle_mesh.hpp"
#include "warps/curved/placement.hpp"
#include "warps/curved/triangle_tree.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::mesh {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr Param<Path> mesh_file{
    {.name = "file", .help = "PLY (ascii or binary little endian) or OBJ mesh"}};

constexpr Param<Choice> attributes{
    .name = "attributes",
    .fallback = "position",
    .choices = "position|normal|barycentric",
    .help =
        "Columns: position: x, y, z; normal: also the unit normal of the triangle, corners "
        "counter-clockwise; barycentric: also the number of the triangle from 0 and three "
        "barycentric coordinates"};

using Pair = std::array<double, 2>;

// Numbers of columns of a point, by --attributes.
constexpr std::size_t with_normal = 6;
constexpr std::size_t with_barycentrics = 7;

/// Area of a triangle in units of `unit`^2, whose squares neither overflow nor underflow if the
/// unit is a power of 2 near the mesh's size.
double area_in(const TriangleMesh& mesh, std::size_t i, double unit) {
    const auto [a, b, c] = mesh.corners(i);
    return 0.5 * length(cross(times(minus(b, a), 1 / unit), times(minus(c, a), 1 / unit)));
}

/// Cumulative areas of the triangles, in units of `unit`^2. @throws Error(input) if the total is 0
std::vector<double> areas_up_to(const TriangleMesh& mesh, double unit, const std::string& name,
                                const RunContext& run) {
    std::vector<double> areas;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (i % 65536 == 0) run.check_stop();
        areas.push_back(area_in(mesh, i, unit));
    }
    std::vector<double> sums = running_sums(areas);
    if (!(sums.back() > 0)) fail(ErrorKind::input, "{}: the mesh has no area", name);
    return sums;
}

std::uint64_t digits_of(const Vector3& at, std::uint64_t before) {
    for (const double x : at)
        before = Rng(before, 0).bits(std::bit_cast<std::uint64_t>(x + 0.0));  // maps -0 to 0
    return before;
}

/// Warns of triangles that have the same corners as other triangles, in any order.
void note_doubled(const TriangleMesh& mesh, const std::string& name, const RunContext& run) {
    std::vector<std::uint64_t> digits;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (i % 65536 == 0) run.check_stop();
        auto corners = mesh.corners(i);
        std::ranges::sort(corners);
        std::uint64_t all = 0;
        for (const Vector3& corner : corners) all = digits_of(corner, all);
        digits.push_back(all);
    }
    std::ranges::sort(digits);
    const auto doubled = digits.end() - std::unique(digits.begin(), digits.end());
    if (doubled > 0)
        run.notify(
            fmt::format("{}: triangles with the same corners as an earlier one: {}; each of them "
                        "gets points of its own",
                        name, doubled));
}

Vector3 weighted(const std::array<Vector3, 3>& v, const std::array<double, 3>& w) {
    return {w[0] * v[0][0] + w[1] * v[1][0] + w[2] * v[2][0] + 0.0,  // maps -0 to 0
            w[0] * v[0][1] + w[1] * v[1][1] + w[2] * v[2][1] + 0.0,
            w[0] * v[0][2] + w[1] * v[1][2] + w[2] * v[2][2] + 0.0};
}

class MeshDomain final : public NamedDomain {
  public:
    MeshDomain(TriangleMesh mesh, std::size_t numbers, const std::string& name, std::string spec,
               const RunContext& run)
        : NamedDomain(std::move(spec), numbers, 2), mesh_(std::move(mesh)), tree_(mesh_, run) {
        const Box box = positions();
        for (std::size_t k = 0; k < 3; ++k)
            size_ = std::max({size_, std::abs(box.low[k]), std::abs(box.high[k])});
        const double unit = unit_for(size_);
        std::vector<double> ends = areas_up_to(mesh_, unit, name, run);
        const double total = ends.back();
        area_ = total * unit * unit;
        if (!(area_ >= 1e-300 && area_ <= 1e300))
            fail(ErrorKind::input, "{}: the mesh has an area of {:.3g}; expected [1e-300, 1e300]",
                 name, area_);
        for (double& end : ends) end /= total;
        shares_ = GuideTable(std::move(ends), mesh_.triangles.size());
    }

    double measure() const override { return area_; }

    /// Allows a distance of 16 epsilon of the largest coordinate from a triangle, the rounding
    /// error of generated points. Normals and barycentrics must match such a triangle within 1e-12.
    bool contains(std::span<const double> point) const override { return find(point).has_value(); }

    Box bounding_box() const override {
        Box box = positions();
        if (dimension() == with_normal) {
            box.low.resize(with_normal, -1);
            box.high.resize(with_normal, 1);
        } else if (dimension() == with_barycentrics) {
            box.low.resize(7, 0);
            box.high.push_back(static_cast<double>(mesh_.triangles.size()));
            box.high.resize(7, 1);
        }
        return box;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        std::ranges::copy(find(point).value_or(Pair{}), cube.begin());
    }
    std::optional<Moments> moments() const override {
        MixedMoments all(bounding_box());
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const double area = area_in(mesh_, i, unit_for(size_));
            if (area > 0) all.add(area, triangle_moments(rows_at_corners(i)));
        }
        return all.moments();
    }
    std::vector<std::string> cube_axes() const override {
        return {"fraction of the area in file order", "position between corners 2 and 1"};
    }

    /// A point of the surface, as a triangle and the weights of its corners.
    struct Place {
        std::size_t triangle;
        std::array<double, 3> weights;
    };
    Place place(double u, double v) const {
        const std::size_t i = shares_.at(u);
        const double part = std::min((u - shares_.begin(i)) / shares_.width(i), 1.0);
        const double root = std::sqrt(part);
        return {i, {1 - root, root * v, root * (1 - v)}};
    }
    Vector3 position(const Place& at) const {
        return weighted(mesh_.corners(at.triangle), at.weights);
    }

    /// xi0 and xi1 of a point of the surface; nullopt if the point is not on it.
    std::optional<Pair> find(std::span<const double> point) const {
        const Vector3 at = vector_of(point);
        const double reach = 16 * epsilon * size_;
        if (dimension() == with_barycentrics) return find_by_number(point, reach);
        std::optional<Pair> best;
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t first = 0;
        // Triangles with the point inside: more than one if triangles coincide.
        std::vector<std::pair<std::uint32_t, Pair>> around;
        // Among adjacent triangles, chooses the one whose inverse maps back nearest to the point.
        tree_.visit(at, reach, [&](std::uint32_t i, const Foot& foot) {
            if (dimension() == with_normal &&
                !(largest(minus(normal(i), vector_of(point.subspan(3)))) <= 1e-12))
                return;
            const Pair cube = shares_in({i, foot.weights});
            if (std::ranges::min(foot.weights) > 1e-9) around.emplace_back(i, cube);
            const double off = length(minus(position(place(cube[0], cube[1])), at));
            if (off > least || (off == least && i > first)) return;
            best = cube;
            least = off;
            first = i;
        });
        return around.size() > 1 ? one_of(around, at) : best;
    }

    Vector3 normal(std::size_t triangle) const {
        const auto [a, b, c] = mesh_.corners(triangle);
        const Vector3 n = cross(minus(b, a), minus(c, a));
        return largest(n) > 0 ? normalized(n) : n;
    }

  private:
    /// Selects one of several coinciding triangles by a hash of the point, all equally often.
    static Pair one_of(std::vector<std::pair<std::uint32_t, Pair>>& around, const Vector3& at) {
        std::ranges::sort(around, {}, &std::pair<std::uint32_t, Pair>::first);
        return around[Rng(digits_of(at, 0), 1).below(0, around.size())].second;
    }

    /// Columns of the points at the triangle's corners; other points interpolate them linearly.
    std::array<std::vector<double>, 3> rows_at_corners(std::size_t i) const {
        const auto corners = mesh_.corners(i);
        const auto& [a, b, c] = corners;
        const Vector3 normal = normalized(cross(minus(b, a), minus(c, a)));
        std::array<std::vector<double>, 3> rows;
        for (std::size_t k = 0; k < 3; ++k) {
            rows[k].assign(corners[k].begin(), corners[k].end());
            if (dimension() == with_normal)
                rows[k].insert(rows[k].end(), normal.begin(), normal.end());
            if (dimension() != with_barycentrics) continue;
            rows[k].resize(7, 0.0);
            rows[k][3] = static_cast<double>(i);
            rows[k][4 + k] = 1;
        }
        return rows;
    }

    Box positions() const {
        constexpr double far = std::numeric_limits<double>::infinity();
        Box box{{far, far, far}, {-far, -far, -far}};
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
            for (const Vector3& corner : mesh_.corners(i)) box = stipple::bounding_box(corner, box);
        return box;
    }

    Pair shares_in(const Place& at) const {
        const double sum = at.weights[1] + at.weights[2];
        const double root = std::min(sum, 1.0);
        const double share = shares_.begin(at.triangle) + root * root * shares_.width(at.triangle);
        const double end = shares_.end(at.triangle);  // where the next triangle begins
        return {std::min(share, end == 1 ? 1 : std::nextafter(end, 0)),
                sum > 0 ? std::min(at.weights[1] / sum, 1.0) : 0};
    }

    std::optional<Pair> find_by_number(std::span<const double> point, double reach) const {
        const double number = point[3];
        const auto count = static_cast<double>(mesh_.triangles.size());
        if (!(number >= 0 && number < count && number == std::floor(number))) return {};
        const Place at{static_cast<std::size_t>(number), {point[4], point[5], point[6]}};
        double sum = -1;
        for (const double w : at.weights) {
            if (!(w >= 0 && w <= 1)) return {};
            sum += w;
        }
        const double off = length(minus(vector_of(point), position(at)));
        if (!(std::abs(sum) <= 1e-12 && off <= reach)) return {};
        return shares_in(at);
    }

    TriangleMesh mesh_;
    TriangleTree tree_;
    GuideTable shares_;  ///< cumulative fractions of the area, by triangle
    double area_ = 0;
    double size_ = 0;
};

class Mesh final : public Mapping {
  public:
    explicit Mesh(const std::shared_ptr<const MeshDomain>& domain)
        : Mapping(domain), surface_(*domain) {}

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        const std::size_t m = surface_.dimension();
        for (std::size_t i = 0; i < cube.size() / 2; ++i)
            write(surface_.place(cube[2 * i], cube[2 * i + 1]), image.subspan(m * i, m));
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        const std::size_t m = surface_.dimension();
        for (std::size_t i = 0; i < image.size() / m; ++i) {
            const auto found = surface_.find(image.subspan(m * i, m));
            if (!found) refuse_outside(image.subspan(m * i, m));
            std::ranges::copy(*found, cube.subspan(2 * i, 2).begin());
        }
    }

  private:
    void write(const MeshDomain::Place& at, std::span<double> image) const {
        std::ranges::copy(surface_.position(at), image.begin());
        if (surface_.dimension() == with_normal)
            std::ranges::copy(surface_.normal(at.triangle), image.begin() + 3);
        if (surface_.dimension() == with_barycentrics) {
            image[3] = static_cast<double>(at.triangle);
            std::ranges::copy(at.weights, image.begin() + 4);
        }
    }

    const MeshDomain& surface_;
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    if (!want.options.given(mesh_file))
        fail(ErrorKind::usage,
             "--file: no file given; expected a PLY or OBJ file with a triangle mesh");
    const std::string how = want.options[attributes];
    const std::size_t numbers = how == "normal"        ? with_normal
                                : how == "barycentric" ? with_barycentrics
                                                       : 3;
    const std::string path = want.options[mesh_file];
    TriangleMesh mesh = read_mesh(path, want.run);
    note_doubled(mesh, path, want.run);
    return std::make_unique<Mesh>(
        std::make_shared<MeshDomain>(std::move(mesh), numbers, path, want.spec(), want.run));
}

}  // namespace

Warp unit() {
    return {.name = "mesh",
            .summary = "Surface of a triangle mesh from a PLY or OBJ file, uniform by area",
            .source = "Turk 1990, in: Graphics Gems",
            .strata =
                "xi1 runs through the triangles in file order by area, within each from its first "
                "corner to the opposite edge; xi2 runs along that edge; both are used directly",
            .options = Schema(mesh_file, attributes),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::mesh
