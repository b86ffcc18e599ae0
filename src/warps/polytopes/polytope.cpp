// SPDX-License-Identifier: MIT
//
// Unit cube onto the polytope of all points in a box that satisfy linear inequalities; exactly
// uniform, with no point dropped:
//
//     { x in box : a_i . x <= b_i for all i }
//
// The polytope is divided into simplices (math/polytopes/face_tree.hpp): xi_1 selects one in
// proportion to its volume, and the coordinates then determine the weights of its vertices by stick
// breaking. Coordinates that the inequalities do not couple are independent of each other.
//
// Shape   as many coordinates as --bounds has ranges, or as are given; inequalities may couple up
//         to 12, with up to 200000 faces and 10000 vertices.
// Strata  a coordinate in no inequality uses its xi directly. Among d coupled ones, the first xi
//         selects the simplex, and its remainder is the position along the simplex's last edge;
//         each other xi determines the weight of one vertex and is 0 at this vertex. So strata of
//         the first xi are pieces of adjacent simplices, and strata of several xi are cut where
//         simplices meet.
// Cost    about 20 ns a coordinate forward; about 500 ns a point in 4 dimensions for the inverse.
//         Vertices and faces are computed once: below a millisecond for dozens, a second for the
//         maximum.
// Promise density 1 / volume. Points are in the closed polytope up to rounding, and always in its
//         bounding box. The same bits on every machine.
// Beware  < and <= mean the same: points may lie on the boundary. Inequalities that differ by more
//         than rounding, but by less than 1e-9, may be rejected.
// Source  pulling triangulation: C. W. Lee, Handbook of Discrete and Computational Geometry (1997),
//         section 14.3; vertices: K. Fukuda, A. Prodon, LNCS 1120 (1996) 91-111,
//         doi:10.1007/3-540-61576-8_77.

#include "math/polytopes/polytope.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/densities/affine.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::polytope {
namespace {

constexpr Param<Text> constraints{
    {.name = "constraints",
     .help = "Linear inequalities in x, y, z or x1, x2, ..., separated by ; or ,: 'x + 2*y <= 1; x "
             "- y >= -0.5' (stipple help formulas)"}};
constexpr Param<Text> bounds{
    {.name = "bounds",
     .fallback = "0..1",
     .help =
         "Box to which the inequalities apply: lo..hi for all coordinates, or lo..hi,lo..hi,..."}};

class PolytopeDomain final : public NamedDomain {
  public:
    PolytopeDomain(Polytope polytope, std::string spec)
        : NamedDomain(std::move(spec), polytope.dimension(), polytope.dimension()),
          polytope_(std::move(polytope)) {}

    double measure() const override { return polytope_.volume(); }
    bool contains(std::span<const double> point) const override {
        return polytope_.contains(point);
    }
    Box bounding_box() const override { return polytope_.bounding_box(); }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        polytope_.to_cube(point, cube);
    }
    std::optional<Moments> moments() const override { return polytope_.moments(); }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes;
        for (std::size_t k = 0; k < dimension(); ++k) axes.push_back(polytope_.cube_axis(k));
        return axes;
    }

    void from_cube(std::span<const double> cube, std::span<double> image) const {
        polytope_.from_cube(cube, image);
    }

  private:
    Polytope polytope_;
};

std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (const auto some : split_outside("()", text, ";"))
        for (const auto part : split_outside("()", some, ","))
            if (!trim(part).empty()) parts.push_back(trim(part));
    return parts;
}

/// Parses the inequalities. @param plain receives their text without blanks
std::vector<HalfSpace> half_spaces(std::string_view text, std::size_t d, std::string& plain) {
    std::vector<HalfSpace> all;
    for (const auto part : parts_of(text)) {
        const Expression formula(constraints.name, part, d);
        auto cuts = affine_inequalities(formula);
        if (!cuts)
            fail(ErrorKind::usage,
                 "--constraints: '{}' is not a linear inequality; expected one such as "
                 "x1 + 2*x2 <= 1",
                 formula.text());
        for (HalfSpace& cut : *cuts) all.push_back(std::move(cut));
        plain += (plain.empty() ? "" : ",") + formula.text();
    }
    return all;
}

Polytope polytope_of(const Box& box, const std::vector<HalfSpace>& cuts) {
    try {
        return Polytope(box, cuts);
    } catch (const Error& e) {
        throw Error(e.kind(), fmt::format("--constraints: {}", e.what()), e.hint());
    }
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const std::string text = want.options.given(constraints) ? want.options[constraints] : "";
    if (parts_of(text).empty())
        fail(ErrorKind::usage,
             "--constraints: none given; expected linear inequalities, such as 'x + y <= 1'");
    const Box box = parse_box(want.options[bounds], want.given);
    std::string plain;
    const auto cuts = half_spaces(text, box.dimension(), plain);
    Values known = want.options;
    known.put(constraints.name, plain);
    return domain_mapping<PolytopeDomain>(polytope_of(box, cuts),
                                          format_spec(want.warp.name, known, want.warp.options));
}

}  // namespace

Warp unit() {
    return {
        .name = "polytope",
        .summary = "Polytope: a box cut by linear inequalities that couple up to 12 coordinates",
        .source =
            "Fukuda and Prodon 1996, doi:10.1007/3-540-61576-8_77 (vertices); Rosenblatt "
            "1952, doi:10.1214/aoms/1177729394 (simplices)",
        .related = {"constraints", "inequalities", "half-spaces", "mixture-design", "convex"},
        .strata =
            "among coordinates coupled by inequalities, the first xi selects a simplex and the "
            "position along its last edge, the others the fractions of its vertices; xi of other "
            "coordinates is used directly",
        .options = Schema(constraints, bounds),
        .mapping = make};
}

}  // namespace stipple::warps::polytope
