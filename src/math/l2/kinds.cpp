// SPDX-License-Identifier: MIT
#include "math/l2/kinds.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::l2 {
namespace {

// 1 - max(x, y) = 1 - (x + y + |x - y|) / 2
constexpr AxisKernel star_kernel{
    .s00 = 48, .s01 = -24, .sigma = -24, .mean = {24, 0, -24, 0}, .total = 16};

// min(x, y) - x y = (x + y - |x - y|) / 2 - x y
constexpr AxisKernel extreme_kernel{
    .s01 = 24, .s11 = -48, .sigma = -24, .mean = {0, 24, -24, 0}, .total = 4};

// 1/2 - t + t^2 with t = |x - y|
constexpr AxisKernel periodic_kernel{
    .s00 = 24, .s02 = 48, .s11 = -96, .sigma = -48, .mean = {16, 0, 0, 0}, .total = 16};

// (|x - 1/2| + |y - 1/2| - |x - y|) / 2
constexpr AxisKernel centered_kernel{
    .s03 = 24, .sigma = -24, .mean = {-6, 24, -24, 24}, .total = 4};

// 7/8 - |x - 1/2| / 4 - |y - 1/2| / 4 - 3 t / 4 + t^2 / 2 with t = |x - y|
constexpr AxisKernel mixture_kernel{.s00 = 42,
                                    .s02 = 24,
                                    .s03 = -12,
                                    .s11 = -48,
                                    .sigma = -36,
                                    .mean = {29, 12, -12, -12},
                                    .total = 28};

// 1/6 - t + t^2 with t = |x - y|: the second Bernoulli polynomial
constexpr AxisKernel bernoulli_kernel{
    .s00 = 8, .s02 = 48, .s11 = -96, .sigma = -48, .mean = {}, .total = 0};

// (1 - t) / 2 with t = |x - y|
constexpr AxisKernel average_kernel{.s00 = 24, .sigma = -24, .mean = {12, 24, -24, 0}, .total = 16};

// 1 - 2 t with t = |x - y|
constexpr AxisKernel symmetric_kernel{
    .s00 = 48, .sigma = -96, .mean = {0, 96, -96, 0}, .total = 16};

constexpr KindRecord records[] = {
    {"star", star_kernel, 1, false},
    {"extreme", extreme_kernel, 1, false},
    {"periodic", periodic_kernel, 1, false},
    {"centered", centered_kernel},
    {"wraparound", periodic_kernel},
    {"mixture", mixture_kernel},
    {"modified", star_kernel},
    {"diaphony", bernoulli_kernel, diaphony},
    {"average", average_kernel, 1, false},
    {"symmetric", symmetric_kernel},
};

}  // namespace

const KindRecord& record_of(Kind kind) { return records[static_cast<std::size_t>(kind)]; }

bool is_kernel_alone(Kind kind, const AxisWeights& weights) {
    return weights.empty() && !record_of(kind).projections;
}

std::vector<Kind> parse_kinds(std::string_view words) {
    std::vector<std::string> names;
    for (const KindRecord& record : records) names.emplace_back(record.name);
    std::vector<bool> wanted(names.size(), false);
    for (const std::string_view word : split(words, ',')) {
        const auto found = std::ranges::find(names, trim(word));
        if (found != names.end()) {
            wanted[static_cast<std::size_t>(found - names.begin())] = true;
            continue;
        }
        if (trim(word) != "all")
            fail_with_hint(ErrorKind::usage, suggest(trim(word), names),
                           "--kind: '{}' is not a kind of L2 discrepancy", trim(word));
        wanted.assign(names.size(), true);
    }
    std::vector<Kind> kinds;
    for (const Kind kind : all_kinds)
        if (wanted[static_cast<std::size_t>(kind)]) kinds.push_back(kind);
    if (kinds.empty())
        fail(ErrorKind::usage, "--kind: is empty; expected all, {}", join(names, ", "));
    return kinds;
}

}  // namespace stipple::l2
