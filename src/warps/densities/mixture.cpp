// SPDX-License-Identifier: MIT
//
// Mixture of other warps with weights w_i that sum to 1:
//
//     component i where w_0 + ... + w_i-1 <= xi0 < w_0 + ... + w_i,
//     its first coordinate xi0' = (xi0 - w_0 - ... - w_i-1) / w_i, the others unchanged;
//     density = sum_i w_i density_i.
//
// Components are specs separated by |:
//
//     mixture:weights=[0.6,0.4],components=[von-mises-fisher:kappa=50,axis=[1,0,0]|sphere]
//
// All components must give directions (unit vectors of the plane or space), or all must fill the
// same number of dimensions. None may drop points, which would change the weights. The domain is
// the whole sphere or space. On the sphere its cells are zones of height and longitude. In space
// they are boxes in the coordinates Phi((x - middle) / (width / 4)), with the middle and width of
// the bounding box.
//
// Shape   as many unit coordinates as the components take, and as many coordinates as they give.
// Strata  xi0 is used directly: of n strata, component i receives n w_i, rounded up or down. Within
//         a component, strata are those of the component for xi0' and the other coordinates.
// Cost    that of the components, plus about 8 ns a point on one core.
// Promise a component of weight 0 never occurs. Probabilities of cells are the weighted sums of the
//         components' probabilities. There is no inverse, since a point may come from several
//         components. The same bits on every machine, if that holds for the components.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/densities/guide_table.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/zone_integral.hpp"
#include "warps/common_options.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::mixture {
namespace {

constexpr Param<Numbers> weights{
    {.name = "weights",
     .fallback = "0.5,0.5",
     .help = "Probability of each component; they must sum to 1 within 1e-12"}};

constexpr Param<Text> components{
    {.name = "components",
     .fallback = "henyey-greenstein:g=0.7|henyey-greenstein:g=-0.3",
     .unit = "warps",
     .help = "Warps as specs, separated by |: 'cone:half-angle=10|hemisphere:method=cosine'"}};

constexpr Param<bool> normalize{.name = "normalize", .help = "Divide the weights by their sum"};

struct Component {
    std::string spec;
    double weight = 0;
    std::unique_ptr<Mapping> mapping;
};

/// Domain of a mixture. The probability of a cell is the sum over components of weight times
/// probability. For boxes this is exact for plane shapes (area) and for distributions of each
/// coordinate (distribution functions). For zones of the sphere it is computed by quadrature, split
/// at the component's rim (math/geometry/zone_integral.hpp).
class MixtureDomain final : public NamedDomain {
  public:
    /// @param parts all give directions or all fill the same number of dimensions; weights sum to 1
    MixtureDomain(const std::vector<Component>& parts, std::string spec)
        : NamedDomain(std::move(spec), parts[0].mapping->domain()->dimension(),
                      parts[0].mapping->domain()->cube_dimension()) {
        for (const Component& part : parts) {
            parts_.push_back(part.mapping->domain());
            weights_.push_back(part.weight);
        }
        box_ = parts_[0]->bounding_box();
        for (const DomainPtr& part : parts_) {
            const Box box = part->bounding_box();
            box_ = stipple::bounding_box(box.low, stipple::bounding_box(box.high, box_));
        }
        fills_box_ = !directions() && std::ranges::all_of(parts_, [&](const DomainPtr& part) {
            return fills(*part);
        });
    }

    /// Measure of the sphere or circle if a component covers it, of the bounding box if every
    /// component fills it; otherwise infinity, since the union of the components is unknown.
    double measure() const override {
        const auto has_all = [&](const DomainPtr& part) {
            return part->measure() > (1 - 1e-12) * all_directions();
        };
        if (directions() && std::ranges::any_of(parts_, has_all)) return all_directions();
        return fills_box_ ? volume_of(box_) : std::numeric_limits<double>::infinity();
    }

    /// Union of the components' supports.
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
                fail(ErrorKind::limit, "{}: the probabilities of boxes in {} cannot be computed",
                     spec(), part.spec());
            return *mass;
        });
    }
    std::optional<Moments> moments() const override {
        MixedMoments all(box_);
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
    /// Whether a component fills the bounding box of all components.
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

    /// Coordinate k, in space, of a cell's edge with the cube coordinate u.
    double edge(double u, std::size_t k) const {
        if (u <= 0 || u >= 1)
            return std::copysign(std::numeric_limits<double>::infinity(), u - 0.5);
        return middle(k) + scale(k) * normal_quantile(u);
    }

    /// Sum over the components of weight times mass(component).
    template <class Mass>
    Estimate weighted(const Mass& mass) const {
        Estimate sum;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (weights_[i] != 0) sum += weights_[i] * mass(*parts_[i]);
        return sum;
    }

    /// Probability of a zone of directions; zones are cells also for parts without sphere_shape().
    static Estimate zone_mass(const Domain& part, const Box& cell) {
        const auto shape = part.sphere_shape();
        if (!shape) return part.probability(cell);
        const Zone zone{1 - 2 * cell.high[0], 1 - 2 * cell.low[0], cell.low[1], cell.high[1]};
        Estimate mass =
            integrate_zone([&](const Vector3& v) { return part.density(v); }, zone, *shape);
        // The rounded rim of a small shape.
        const double size = std::sqrt(part.measure() / (4 * std::numbers::pi));
        if (mass.value > 0 && size < 1 / 16.0)
            mass.error += 8 * std::numeric_limits<double>::epsilon() / size;
        return mass;
    }

    std::vector<DomainPtr> parts_;
    std::vector<double> weights_;
    Box box_;
    bool fills_box_ = false;  ///< whether every component fills the box
};

class Mixture final : public Mapping {
  public:
    /// @param sums cumulative weights; the last is 1
    Mixture(std::vector<Component> parts, std::vector<double> sums, std::string spec)
        : Mapping(std::make_shared<MixtureDomain>(parts, std::move(spec)),
                  "this warp has no inverse"),
          parts_(std::move(parts)),
          shares_(std::move(sums), 2 * parts_.size()) {}

    /// Processes rows grouped by component, in batches small enough for the nearest caches.
    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        constexpr std::size_t some = 512;
        const std::size_t d = cube_dimension();
        const std::size_t count = cube.size() / d;
        std::vector<std::vector<std::uint32_t>> rows_of(parts_.size());
        Work work;
        for (std::size_t first = 0; first < count; first += some) {
            for (auto& rows : rows_of) rows.clear();
            const auto from = cube.subspan(first * d);
            for (std::uint32_t i = 0; i < std::min(some, count - first); ++i)
                rows_of[shares_.at(from[i * d])].push_back(i);
            for (std::size_t c = 0; c < parts_.size(); ++c)
                if (!rows_of[c].empty())
                    move(c, rows_of[c], from, image.subspan(first * domain()->dimension()), work);
        }
    }

    bool infinite(std::span<const double> row) const override {
        const std::size_t c = shares_.at(row[0]);
        std::vector<double> own(row.size());
        stretch(c, row, own);
        return parts_[c].mapping->infinite(own);
    }

    bool biased() const override {
        return std::ranges::any_of(parts_, [](const auto& part) { return part.mapping->biased(); });
    }

    double density(std::span<const double> point) const override {
        double sum = 0;
        for (const Component& part : parts_) sum += part.weight * part.mapping->density(point);
        return sum;
    }

  private:
    /// Buffers for the rows of one component.
    struct Work {
        std::vector<double> from;
        std::vector<double> to;
        std::vector<std::uint8_t> keep;
    };

    /// Copies a row of the cube, with its first coordinate rescaled for component c.
    void stretch(std::size_t c, std::span<const double> row, std::span<double> to) const {
        std::ranges::copy(row, to.begin());
        const double u = (row[0] - shares_.begin(c)) / shares_.width(c);
        to[0] = std::max(0.0, std::min(u, one_minus_ulp));
    }

    void move(std::size_t c, std::span<const std::uint32_t> rows, std::span<const double> cube,
              std::span<double> image, Work& work) const {
        const std::size_t d = cube_dimension();
        const std::size_t m = domain()->dimension();
        work.from.resize(rows.size() * d);
        work.to.resize(rows.size() * m);
        work.keep.assign(rows.size(), 1);
        for (std::size_t j = 0; j < rows.size(); ++j)
            stretch(c, cube.subspan(rows[j] * d, d), std::span(work.from).subspan(j * d, d));
        parts_[c].mapping->forward(work.from, work.to, work.keep);
        for (std::size_t j = 0; j < rows.size(); ++j)
            for (std::size_t k = 0; k < m; ++k) image[rows[j] * m + k] = work.to[j * m + k];
    }

    std::vector<Component> parts_;
    GuideTable shares_;  ///< cumulative weights of the components
};

const Warp& warp_of(const Spec& spec) {
    std::vector<std::string> names;
    for (const Warp& warp : all()) {
        if (warp.name == spec.name || std::ranges::count(warp.aliases, spec.name) > 0) return warp;
        names.push_back(warp.name);
    }
    fail_with_hint(ErrorKind::usage, suggest(spec.name, names),
                   "--components: there is no warp '{}'", spec.name);
}

/// Tests with random points whether all images are unit vectors.
bool gives_directions(const Mapping& mapping) {
    constexpr std::size_t n = 16;
    const std::size_t m = mapping.domain()->dimension();
    std::vector<double> cube(n * mapping.cube_dimension()), image(n * m);
    std::vector<std::uint8_t> keep(n, 1);
    Rng(1).fill(0, cube);
    mapping.forward(cube, image, keep);
    for (std::size_t i = 0; i < n; ++i) {
        double square = 0;
        for (std::size_t k = 0; k < m; ++k) square += image[i * m + k] * image[i * m + k];
        if (!(std::abs(square - 1) <= 1e-14)) return false;
    }
    return true;
}

/// Describes the points of a component; components can be mixed if the texts are equal.
std::string space_of(const Component& part, const Warp& warp) {
    const Domain& domain = *part.mapping->domain();
    const std::size_t m = domain.dimension();
    const bool full = domain.cube_dimension() == m;
    if (part.mapping->drops())
        fail(ErrorKind::usage, "--components: {} drops points, which would change the weights",
             part.spec);
    if (warp.traits.discrete || (!full && !gives_directions(*part.mapping)))
        fail(ErrorKind::usage,
             "--components: {} gives neither directions nor points that fill a space; expected one "
             "of these",
             part.spec);
    if (full) return fmt::format("points that fill {} dimension{}", m, m == 1 ? "" : "s");
    return m == 2 ? "directions in the plane" : "directions in space";
}

Component component_of(std::string_view text, std::size_t given, const RunContext& run,
                       std::string& space) {
    const Spec spec = parse_spec(text);
    if (!spec.coordinates.empty())
        fail(ErrorKind::usage, "--components: {} names coordinates, which components cannot choose",
             text);
    const Warp& warp = warp_of(spec);
    Component part{.spec = std::string(text),
                   .mapping = warp.make(spec.values(warp.options), given, run)};
    space = space_of(part, warp);
    return part;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const std::vector<double> given_weights = want.options[weights];
    const std::string all = want.options[components];
    const auto texts = split_outside("[]", all, "|");
    if (given_weights.size() != texts.size())
        fail(ErrorKind::usage, "--weights: {} given for {} component{}; expected one for each",
             given_weights.size(), texts.size(), texts.size() == 1 ? "" : "s");
    const auto shares = checked_weights(weights, given_weights, want.options[normalize]);

    std::vector<Component> parts;
    std::string first;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        std::string space;
        parts.push_back(component_of(texts[i], want.given, want.run, space));
        parts.back().weight = shares[i];
        if (i == 0) first = space;
        if (space != first ||
            parts[i].mapping->cube_dimension() != parts[0].mapping->cube_dimension())
            fail(ErrorKind::usage,
                 "--components: all must be of one kind; {} gives {}, from {} unit coordinates, "
                 "but {} gives {}, from {}",
                 texts[0], first, parts[0].mapping->cube_dimension(), texts[i], space,
                 parts[i].mapping->cube_dimension());
    }
    return std::make_unique<Mixture>(std::move(parts), sums_to_1(shares), want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "mixture",
            .summary = "Weighted mixture of other warps",
            .source = "Composition: the weighted sum of the components' densities",
            .strata =
                "xi1 selects the component by the weights, in order, and is rescaled for it; all "
                "else is as in the components",
            .traits = {.invertible = false},
            .options = Schema(weights, components, normalize),
            .mapping = make};
}

}  // namespace stipple::warps::mixture
