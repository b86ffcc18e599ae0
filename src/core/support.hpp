// SPDX-License-Identifier: MIT
//
// Where a domain's density is not 0. A mean of f / p over points that follow p is the integral of f
// over that part alone, so that whoever compares it with an exact value must know the part.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// The part of a domain where its density is not 0.
struct Support {
    bool whole = true;   ///< all of the domain, but for a set of measure 0
    bool finite = true;  ///< its measure is, though perhaps not known

    /// No point that follows the density, unrounded, is where density() says 0.
    bool by_density = false;

    /// Its measure, where that is known.
    std::optional<Estimate> measure = {};

    /// Boxes side by side that hold all of it; none where they would be many.
    std::vector<Box> boxes = {};
};

/// What a domain also is whose density may be 0 on a part that has a measure.
class Gapped {
  public:
    Gapped() = default;
    Gapped(const Gapped&) = delete;
    Gapped& operator=(const Gapped&) = delete;
    virtual ~Gapped() = default;

    [[nodiscard]] virtual Support support() const = 0;

    /// Whether support() costs next to nothing and tells where the gaps are, by boxes or
    /// by_density.
    [[nodiscard]] virtual bool shows_gaps() const { return false; }
};

/// Of any domain; one that is not Gapped is its own support.
inline Support support_of(const Domain& domain) {
    if (const auto* gapped = dynamic_cast<const Gapped*>(&domain)) return gapped->support();
    const double measure = domain.measure();
    if (measure < std::numeric_limits<double>::infinity())
        return {.measure = Estimate{measure, 0}, .boxes = {}};
    return {.finite = false, .boxes = {}};
}

}  // namespace stipple
