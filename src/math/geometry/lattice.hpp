// SPDX-License-Identifier: MIT
//
// The cells of a rectangular lattice, one after the other, the first coordinate fastest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stipple {

/// Calls row(cell, offset, length) for the rows of cells that make up cells first, first + 1, ...,
/// first + count - 1: `length` cells that begin at `cell` and go on along the first coordinate, the
/// `offset`-th of the stretch and those after it.
template <class Row>
void for_each_lattice_row(std::span<const std::uint64_t> shape, std::uint64_t first,
                          std::size_t count, const Row& row) {
    std::vector<std::uint64_t> cell(shape.size());
    for (std::size_t k = 0; k < shape.size(); ++k) {
        cell[k] = first % shape[k];
        first /= shape[k];
    }
    for (std::size_t offset = 0; offset < count;) {
        const auto length = std::min<std::size_t>(count - offset, shape[0] - cell[0]);
        row(std::span<const std::uint64_t>(cell), offset, length);
        offset += length;
        cell[0] += length;
        for (std::size_t k = 0; k + 1 < shape.size() && cell[k] == shape[k]; ++k) {
            cell[k] = 0;
            ++cell[k + 1];
        }
    }
}

}  // namespace stipple
