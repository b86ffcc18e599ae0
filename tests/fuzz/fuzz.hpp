// SPDX-License-Identifier: MIT
//
// Definition of a fuzz target, and shared functions.
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

/// A fuzz target: a name, which is also that of its folder of seeds, and a function that processes
/// an input. Inputs may be rejected by an Error; any other exception, a failed require() and
/// reports of sanitizers are defects.
struct Target {
    std::string name;
    std::function<void(std::string_view)> work;
};

std::vector<Target> point_targets();       ///< formats of points, provenance
std::vector<Target> file_targets();        ///< all other files
std::vector<Target> text_targets();        ///< numbers, options, specs, formulas, JSON, letters
std::vector<Target> comparison_targets();  ///< results against definitions and alternatives
std::vector<Target> command_targets();     ///< whole commands

/// One thread, and so little memory that a large count in a header is rejected.
RunContext small_run();

/// @throws std::logic_error, a defect, if `holds` is false
void require(bool holds, const std::string& what);

/// Writes the bytes to a file; always the same path.
const std::string& as_file(std::string_view bytes);

/// Whether the work succeeded; false if it threw an Error. That of the deadline is passed on.
template <class Work>
bool accepted(const Work& work) {
    try {
        work();
        return true;
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;  // by the deadline: nothing to compare with
        return false;
    }
}

/// An input split into a text and trailing numbers.
struct TextInput {
    explicit TextInput(std::string_view bytes, std::size_t numbers)
        : numbers_(reinterpret_cast<const std::uint8_t*>(bytes.data()) + text_size(bytes, numbers),
                   bytes.size() - text_size(bytes, numbers)),
          text(bytes.substr(0, text_size(bytes, numbers))) {}

    /// Next number, below `count`; 0 if there are no more.
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
