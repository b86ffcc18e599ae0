// SPDX-License-Identifier: MIT
//
// Owen's nested uniform scrambling: the first digit of a coordinate is permuted at random, the
// second by a permutation that depends on the first, and so on down the tree of digits.
//
// Cost     O(n d) in base 2; O(n d K b) with K digits in others.
// Promise  every point is uniform in the cube; keeps the (t,m,s)-net property in its base. Digits
//          behind a point's last are random, too: 53 bits in all.
// Beware   as in digital-shift. Equal points stay equal.
// Source   A. B. Owen, in Monte Carlo and Quasi-Monte Carlo Methods in Scientific Computing (1995),
//          299-317, doi:10.1007/978-1-4612-2552-2_19.

#include <array>
#include <variant>

#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::owen {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits: one for all coordinates, or one for "
                                       "each, such as 2,3 for Halton's"}};

class Owen final : public CoordinateWise {
  public:
    Owen(const ScrambleRequest& request, const std::vector<std::uint32_t>& bases)
        : CoordinateWise(bases.size()), bases_(bases) {
        for (std::size_t k = 0; k < bases.size(); ++k) {
            const std::size_t coordinate = request.coordinates[k];
            if (bases[k] == 2)
                trees_.emplace_back(BinaryOwen(request.seed, coordinate));
            else
                trees_.emplace_back(BaseOwen(request.seed, coordinate, bases[k]));
        }
    }

  private:
    void move(std::size_t k, std::span<double> x) const override {
        if (const auto* binary = std::get_if<BinaryOwen>(&trees_[k])) {
            std::array<std::uint64_t, longest> fractions;
            for (std::size_t i = 0; i < x.size(); ++i) fractions[i] = unit_to_fraction(x[i]);
            binary->apply(std::span(fractions).first(x.size()));
            for (std::size_t i = 0; i < x.size(); ++i) x[i] = fraction_to_unit(fractions[i]);
            return;
        }
        const BaseOwen& tree = std::get<BaseOwen>(trees_[k]);
        for (double& value : x) value = tree.of(mirrored_digits(value, bases_[k]));
    }

    std::vector<std::uint32_t> bases_;
    std::vector<std::variant<BinaryOwen, BaseOwen>> trees_;
};

}  // namespace

Scramble unit() {
    return {.name = "owen",
            .summary = "Nested uniform scrambling: a random permutation of digits for each prefix",
            .source = "Owen 1995, doi:10.1007/978-1-4612-2552-2_19",
            .options = Schema(base, scramble_seed),
            .aliases = {"nested-uniform"},
            .make = [](const Values& options,
                       const ScrambleRequest& request) -> std::unique_ptr<Randomization> {
                return std::make_unique<Owen>(
                    request, bases_for(options[base], request.coordinates.size(), false));
            }};
}

}  // namespace stipple::scrambles::owen
