// SPDX-License-Identifier: MIT
//
// Digital shift: the same random digits are added to those of all points, digit by digit modulo the
// base, without carries.
//
// Cost     O(n d) in base 2, O(n d log 2^50 / log b) in others.
// Promise  keeps the (t,m,s)-net property in its base, whatever the net.
// Beware   in a base other than 2 a point is taken for the nearest multiple of b^-K, where b^K is
//          the largest power up to 2^50; so that Halton's points are taken for what they stand for.
// Source   see math/digital/base_scramble.hpp.

#include <variant>

#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::digital_shift {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits: one for all coordinates, or one for "
                                       "each"}};

class DigitalShift final : public CoordinateWise {
  public:
    DigitalShift(const ScrambleRequest& request, const std::vector<std::uint32_t>& bases)
        : CoordinateWise(bases.size()), bases_(bases) {
        for (std::size_t k = 0; k < bases.size(); ++k) {
            const std::size_t coordinate = request.coordinates[k];
            if (bases[k] == 2)
                shifts_.emplace_back(binary_shift(request.seed, coordinate));
            else
                shifts_.emplace_back(BaseShift(request.seed, coordinate, bases[k]));
        }
    }

  private:
    void move(std::size_t k, std::span<double> x) const override {
        if (const auto* bits = std::get_if<std::uint64_t>(&shifts_[k])) {
            for (double& value : x) value = fraction_to_unit(unit_to_fraction(value) ^ *bits);
            return;
        }
        const BaseShift& shift = std::get<BaseShift>(shifts_[k]);
        for (double& value : x) value = shift.of(mirrored_digits(value, bases_[k]));
    }

    std::vector<std::uint32_t> bases_;
    std::vector<std::variant<std::uint64_t, BaseShift>> shifts_;
};

}  // namespace

Scramble unit() {
    return {.name = "digital-shift",
            .summary = "The same random digits added to those of all points, without carries",
            .source = "Owen 1995, doi:10.1007/978-1-4612-2552-2_19",
            .options = Schema(base, scramble_seed),
            .make = [](const Values& options,
                       const ScrambleRequest& request) -> std::unique_ptr<Randomization> {
                return std::make_unique<DigitalShift>(
                    request, bases_for(options[base], request.coordinates.size(), false));
            }};
}

}  // namespace stipple::scrambles::digital_shift
