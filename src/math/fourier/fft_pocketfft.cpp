// SPDX-License-Identifier: MIT
// Transforms several lines at a time, in the lanes of vectors. Source M. Reinecke, P. Bell,
// pocketfft (https://github.com/mreineck/pocketfft, branch cpp), which caches its plans itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"
#include "core/machine/vectors.hpp"
#include "math/fourier/fft.hpp"

namespace stipple {
namespace {

/// Bytes between consecutive numbers along each axis.
std::vector<std::ptrdiff_t> steps(const std::vector<std::size_t>& shape, std::size_t size) {
    std::vector<std::ptrdiff_t> steps(shape.size());
    for (std::size_t k = shape.size(); k-- > 0; size *= shape[k])
        steps[k] = static_cast<std::ptrdiff_t>(size);
    return steps;
}

/// Memory layout of a real function on a product of groups, and of its spectrum.
struct Layout {
    explicit Layout(const std::vector<int>& orders)
        : shape(orders.begin(), orders.end()), axes(shape.size()) {
        std::iota(axes.begin(), axes.end(), std::size_t{0});
        value_steps = steps(shape, sizeof(double));
        std::vector<std::size_t> half = shape;
        half.back() = half.back() / 2 + 1;
        spectrum_steps = steps(half, sizeof(std::complex<double>));
    }

    std::vector<std::size_t> shape;
    std::vector<std::size_t> axes;
    std::vector<std::ptrdiff_t> value_steps;
    std::vector<std::ptrdiff_t> spectrum_steps;
};

#define POCKETFFT_NO_MULTITHREADING  // lines are already divided among threads
#define POCKETFFT_CACHE_SIZE 4       // number of plans kept; few are in use at a time
#define STIPPLE_KERNELS "math/fourier/pocketfft_lanes.hpp"
#include "core/machine/vector_widths.hpp"

}  // namespace

struct LineTransform::Plan {
    Kind kind;
    std::size_t length;
};

LineTransform::LineTransform(Kind kind, std::size_t length, Planning)
    : plan_(std::make_unique<Plan>(Plan{kind, length})) {}

LineTransform::~LineTransform() = default;

void LineTransform::execute(double* lines, std::size_t spacing, std::size_t count) const {
    const auto transform =
        plan_->kind == Kind::real
            ? pick_vectors(&anywhere::real_lines, &fours::real_lines, &eights::real_lines)
            : pick_vectors(&anywhere::complex_lines, &fours::complex_lines, &eights::complex_lines);
    transform(lines, plan_->length, spacing, count);
}

struct GroupTransform::Plan {
    Layout layout;
    double* values;
    double* spectrum;
};

GroupTransform::GroupTransform(const std::vector<int>& shape, double* values, double* spectrum)
    : plan_(std::make_unique<Plan>(Plan{Layout(shape), values, spectrum})) {}

GroupTransform::~GroupTransform() = default;

void GroupTransform::forward() const {
    pick_vectors(&anywhere::to_spectrum, &fours::to_spectrum, &eights::to_spectrum)(
        plan_->layout, plan_->values, plan_->spectrum);
}

void GroupTransform::backward() const {
    pick_vectors(&anywhere::to_values, &fours::to_values, &eights::to_values)(
        plan_->layout, plan_->values, plan_->spectrum);
}

std::string fft_library() { return "pocketfft"; }

std::string_view fft_licence() { return "so is this program, with pocketfft in it"; }

void read_wisdom(const std::string& path) {
    fail(ErrorKind::usage,
         "--wisdom: {} is for FFTW; this program uses pocketfft, which has no wisdom", path);
}

std::string wisdom_text() { return {}; }

}  // namespace stipple
