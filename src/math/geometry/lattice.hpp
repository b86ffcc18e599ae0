// SPDX-License-Identifier: MIT
//
// Cells of a rectangular lattice in order, with the first coordinate varying fastest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stipple {

/// Splits cells first, ..., first + count - 1 into rows along the first coordinate. Calls row(cell,
/// offset, length) for each row: `length` cells from `cell` on, which has the number first +
/// offset.
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
