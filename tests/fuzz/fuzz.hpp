// SPDX-License-Identifier: MIT
//
// What a fuzz target is, and what several share.
#pragma once

#include <FuzzedDataProvider.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::fuzz {

/// A name, which is also that of its folder of seeds, and what is done with an input. An Error is
/// how inputs are refused; any other exception, a failed require() and what a sanitizer sees is a
/// defect.
struct Target {
    std::string name;
    std::function<void(std::string_view)> work;
};

std::vector<Target> point_targets();       ///< formats of points, provenance
std::vector<Target> file_targets();        ///< all other files
std::vector<Target> text_targets();        ///< numbers, options, specs, formulas, JSON, letters
std::vector<Target> comparison_targets();  ///< results against definitions, and in other ways
std::vector<Target> command_targets();     ///< whole commands

/// One thread, and so little memory that a count in a header must be refused.
RunContext small_run();

/// @throws std::logic_error, which is a defect
void require(bool holds, const std::string& what);

/// The bytes as a file, under one name that stays.
const std::string& as_file(std::string_view bytes);

/// Whether work was done; false where it was refused.
template <class Work>
bool accepted(const Work& work) {
    try {
        work();
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// An input as text with numbers behind it.
struct TextInput {
    explicit TextInput(std::string_view bytes, std::size_t numbers)
        : numbers_(reinterpret_cast<const std::uint8_t*>(bytes.data()) + text_size(bytes, numbers),
                   bytes.size() - text_size(bytes, numbers)),
          text(bytes.substr(0, text_size(bytes, numbers))) {}

    /// The next of the numbers, below `count`; 0 where there is none left.
    std::size_t below(std::size_t count) {
        return numbers_.ConsumeIntegral<std::uint8_t>() % count;
    }

  private:
    static std::size_t text_size(std::string_view bytes, std::size_t numbers) {
        return bytes.size() - std::min(numbers, bytes.size());
    }
    FuzzedDataProvider numbers_;

  public:
    std::string_view text;
};

}  // namespace stipple::fuzz
