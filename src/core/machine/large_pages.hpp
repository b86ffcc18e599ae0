// SPDX-License-Identifier: MIT
//
// Requests for large memory pages: repeated access to such memory is faster, and the first touch
// takes a tenth of the time.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace stipple {

/// Requests large pages if the block is large enough; call it before the memory is touched. Only a
/// hint: nothing changes if the system ignores it.
void ask_for_large_pages(void* room, std::size_t bytes);

/// Fresh memory for `count` numbers, which must be written before they are read.
template <class Number>
std::unique_ptr<Number[]> unwritten_room(std::size_t count) {
    auto room = std::make_unique_for_overwrite<Number[]>(count);
    ask_for_large_pages(room.get(), count * sizeof(Number));
    return room;
}

/// Fills an empty vector with `count` zeros, in large pages if possible.
template <class Number>
void fill_with_zeros(std::vector<Number>& room, std::size_t count) {
    room.reserve(count);
    ask_for_large_pages(room.data(), count * sizeof(Number));
    room.resize(count);
}

}  // namespace stipple
