// SPDX-License-Identifier: MIT
//
// Unit cube onto the named parameters of a parameter file. Each parameter is a quantile of its
// distribution, which may depend on preceding parameters; a copula may join parameters; points that
// violate a constraint are dropped.
//
//     x_k = F_k^-1(v_k | x_1 ... x_(k-1)),    v = copula(u)
//
// Linear constraints on uniform parameters restrict these to a polytope (LinearPart), so that
// densities remain known. If it is less than a tenth of the ranges' volume, the cube is mapped onto
// it, and no point is dropped. Otherwise points are rejected, which keeps neighbours and strata.
//
// Shape   one unit coordinate per parameter.
// Strata  preserved without a copula, even if sets are reordered; with a copula, for the first
//         joined parameter. On a polytope, the first unit coordinate selects a simplex.
// Cost    that of the quantiles, and d^2 / 2 multiplications for a copula; about 50 ns per
//         constraint; for a polytope, about 20 ns a coordinate.
// Promise no point violates a constraint. The inverse of an outcome is the middle of its interval.
//         The same bits on every machine.
// Beware  with nonlinear constraints, or linear ones on parameters that are not uniform, densities
//         are known only up to a factor, and requests for them or for probabilities of cells fail.

#include <algorithm>
#include <limits>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/spec.hpp"
#include "experiments/parameters/parameter_space.hpp"
#include "warps/marginal_mapping.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::parameters {
namespace {

using stipple::parameters::LinearPart;
using stipple::parameters::ParameterSpace;

constexpr Param<Path> file{{.name = "file", .help = "Parameter file (stipple help parameters)"}};
constexpr Param<Text> json{
    {.name = "json", .help = "Contents of a parameter file, given directly instead of --file"}};
constexpr Param<bool> unit_cube{
    .name = "unit-cube",
    .help = "Output points of the unit cube; points that violate a constraint are dropped"};

class ParameterDomain final : public NamedDomain {
  public:
    ParameterDomain(std::string spec, ParameterSpace space)
        : NamedDomain(std::move(spec), space.parameters().size(), space.parameters().size()),
          space_(std::move(space)) {
        if (space_.conditional()) return;
        std::vector<MarginalPtr> laws;
        for (const auto& parameter : space_.parameters()) laws.push_back(parameter.law);
        each_ = marginal_mapping(laws, laws.size(), this->spec());
        axes_ = each_->domain().get();
    }

    /// Mapping of each parameter alone; null unless at most linear constraints join parameters.
    const Mapping* by_axes() const {
        return axes_ != nullptr && !space_.has_copula() && space_.density_known() ? each_.get()
                                                                                  : nullptr;
    }

    const ParameterSpace& space() const { return space_; }

    std::string title() const override { return std::string(parse_spec(spec()).name); }
    double measure() const override {
        if (axes_ == nullptr) return std::numeric_limits<double>::infinity();
        return axes_->measure() * (linear() ? linear()->share() : 1);
    }
    bool contains(std::span<const double> point) const override { return space_.contains(point); }
    Box bounding_box() const override {
        if (axes_ == nullptr) return box_of_images();
        Box box = axes_->bounding_box();
        for (std::size_t i = 0; linear() && i < linear()->coordinates().size(); ++i) {
            const std::size_t k = linear()->coordinates()[i];
            box.low[k] = linear()->polytope().bounding_box().low[i];
            box.high[k] = linear()->polytope().bounding_box().high[i];
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        require_known();
        return contains(point) ? space_.density(point) : 0;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        to_own_cube(point, cube);
        if (linear()) linear()->to_cube(point, cube);
    }
    /// Inverse of the parameters' distributions; ignores constraints.
    void to_own_cube(std::span<const double> point, std::span<double> cube) const {
        by_axes() ? axes_->to_cube(point, cube) : space_.to_cube(point, cube);
    }
    bool even() const override {
        return by_axes() ? axes_->even() : !space_.discrete() && !space_.reordering();
    }
    bool has_outcomes() const override { return by_axes() && axes_->has_outcomes(); }
    Estimate probability(const Box& cell) const override {
        require_known();
        if (by_axes()) return axes_->probability(cell);
        if (!even())
            fail(ErrorKind::input,
                 "the probabilities of cells are not known for parameters that depend on each "
                 "other if some of them are discrete");
        return NamedDomain::probability(cell);
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        return by_axes() && !linear() ? axes_->box_mass(box) : std::nullopt;
    }
    std::optional<Moments> moments() const override {
        if (!by_axes()) return std::nullopt;
        auto all = axes_->moments();
        if (!all || !linear()) return all;
        const auto& coordinates = linear()->coordinates();
        const Moments& own = linear()->polytope().moments();
        for (std::size_t i = 0; i < coordinates.size(); ++i) {
            const std::size_t k = coordinates[i];
            all->mean[k] = own.mean[i];
            all->skewness[k] = own.skewness[i];
            for (std::size_t j = 0; j < coordinates.size(); ++j)
                all->covariance[k * dimension() + coordinates[j]] =
                    own.covariance[i * coordinates.size() + j];
        }
        return all;
    }
    Support support() const override {
        if (!by_axes()) return Support{.whole = false, .finite = false};
        const Support ranges = axes_->support();
        if (!linear()) return ranges;
        if (ranges.whole) return NamedDomain::support();
        return Support{.whole = false, .finite = ranges.finite};
    }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes;
        for (const auto& parameter : space_.parameters()) {
            const bool placed = linear() && linear()->holds(axes.size());
            axes.push_back((placed ? "position in the polytope, " : "probability of ") +
                           parameter.name);
        }
        return axes;
    }
    std::vector<std::string> names() const override { return space_.names(); }
    Levels levels() const override { return space_.levels(); }

  private:
    const LinearPart* linear() const { return space_.linear(); }

    void require_known() const {
        if (space_.reordering())
            fail(ErrorKind::input, "the density of reordered parameters is not known");
        if (!space_.density_known())
            fail(ErrorKind::input,
                 "the density of constrained parameters is known only for linear constraints on "
                 "ranges");
    }

    /// Bounding box of the images of 64 to 4096 random points; fewer for many parameters.
    Box box_of_images() const {
        const std::size_t d = dimension();
        const std::size_t count = std::clamp<std::size_t>(0x100000 / d, 64, 4096);
        const Rng rng(1, 0);
        std::vector<double> rows;
        std::vector<double> cube(d), row(d);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < d; ++k) cube[k] = rng.uniform(i * d + k);
            static_cast<void>(space_.from_cube(cube, row));
            rows.insert(rows.end(), row.begin(), row.end());
        }
        return stipple::bounding_box(rows, d);
    }

    ParameterSpace space_;
    std::unique_ptr<Mapping> each_;  ///< maps each parameter alone; null if some depend on others
    const Domain* axes_ = nullptr;   ///< the domain of each_
};

/// Mapping onto the parameters or, if `in_cube`, the cube's points that satisfy all constraints.
class ParameterMapping final : public Mapping {
  public:
    ParameterMapping(std::shared_ptr<const ParameterDomain> parameters, bool in_cube)
        : Mapping(in_cube ? stipple::unit_cube(parameters->dimension(), parameters->names())
                          : parameters),
          parameters_(std::move(parameters)),
          space_(parameters_->space()),
          by_axes_(parameters_->by_axes()),
          in_cube_(in_cube) {}

    bool drops() const override { return space_.rejects(); }
    SetStep set_step() const override {
        if (!space_.reordering()) return {};
        return [this](std::span<double> cube, const RunContext& run) {
            space_.reordering()->apply(cube, run);
        };
    }
    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> keep) const override {
        const std::size_t d = parameters_->dimension();
        if (by_axes_ != nullptr && !in_cube_ && !drops()) {
            by_axes_->forward(cube, image, keep);
            if (space_.linear()) space_.linear()->from_cube(cube, image, d);
            return;
        }
        for (std::size_t i = 0; (!in_cube_ || drops()) && i < cube.size() / d; ++i)
            if (!space_.from_cube(cube.subspan(i * d, d), image.subspan(i * d, d))) keep[i] = 0;
        if (in_cube_) std::ranges::copy(cube, image.begin());
    }

    std::vector<OutcomeAxis> outcome_axes() const override {
        std::vector<OutcomeAxis> axes(space_.parameters().size());
        for (std::size_t k = 0; k < axes.size(); ++k) {
            const auto& parameter = space_.parameters()[k];
            if (parameter.law && parameter.law->discrete() && space_.takes_own(k))
                axes[k] = {[law = parameter.law](double u) { return law->quantile(u); },
                           !parameter.levels.empty()};
        }
        return axes;
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        if (in_cube_ || !space_.linear() || space_.maps_linear())
            return Mapping::inverse(image, cube);
        expect_inside(image);
        const std::size_t d = parameters_->dimension();
        for (std::size_t i = 0; i < image.size(); i += d)
            parameters_->to_own_cube(image.subspan(i, d), cube.subspan(i, d));
    }

    bool infinite(std::span<const double> row) const override {
        return !in_cube_ && by_axes_ != nullptr && by_axes_->infinite(row);
    }

  private:
    std::shared_ptr<const ParameterDomain> parameters_;
    const ParameterSpace& space_;
    const Mapping* by_axes_;
    bool in_cube_;
};

/// Domain whose spec contains a parameter file's text. @param source name of the text in messages
std::shared_ptr<const ParameterDomain> domain_of(const std::string& text,
                                                 const std::string& source) {
    return std::make_shared<const ParameterDomain>(
        "parameters:json=[" + stipple::parameters::one_line(text, source) + "]",
        stipple::parameters::parse_parameters(text, source));
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const bool by_file = want.options.given(file);
    if (by_file == want.options.given(json))
        fail(ErrorKind::usage,
             "--file: no file given; expected a parameter file; 'stipple help parameters' has an "
             "example");
    const std::string source = by_file ? std::string(want.options[file]) : "parameters";
    const std::string text = by_file ? read_file(source) : std::string(want.options[json]);
    return std::make_unique<ParameterMapping>(domain_of(text, source), want.options[unit_cube]);
}

}  // namespace

Warp unit() {
    return {.name = "parameters",
            .summary = "Named parameters: distributions, levels, correlations, constraints",
            .source =
                "Rosenblatt 1952, doi:10.1214/aoms/1177729394 (copulas); Iman, Conover 1982, "
                "doi:10.1080/03610918208812265 (reordering)",
            .related = {"copula", "correlation", "reordering", "constraints", "names", "columns",
                        "experiment"},
            .strata = "without a copula, xi is used directly",
            .traits = {.drops = true, .refills = true, .needs_whole_set = true, .discrete = true},
            .options = Schema(file, json, unit_cube),
            .stream_version = 2,
            .mapping = make,
            .read = [](const std::string& path, const RunContext& run) -> DomainPtr {
                return domain_of(stipple::parameters::text_with_columns(path, run), path);
            }};
}

}  // namespace stipple::warps::parameters
