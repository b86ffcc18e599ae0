// SPDX-License-Identifier: MIT
#include "generators/blue_noise/relaxation/equal_cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace stipple {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// out = L x for the Laplacian L of the bonds.
void apply(std::span<const EqualCells::Bond> bonds, const std::vector<double>& x,
           std::vector<double>& out) {
    std::ranges::fill(out, 0.0);
    for (const auto& [a, b, conductance] : bonds) {
        const double flow = conductance * (x[a] - x[b]);
        out[a] += flow;
        out[b] -= flow;
    }
}

}  // namespace

EqualCells::EqualCells(const Planar& planar, const std::optional<DensityMoments>& density,
                       const std::vector<double>& rows, const RunContext& run)
    : density_(density),
      run_(run),
      sites_(planar.sides, planar.torus, rows.size() / 2, density.has_value()),
      share_(planar.sides.x * planar.sides.y / static_cast<double>(rows.size() / 2)),
      weights_(rows.size() / 2),
      moments_(rows.size() / 2) {
    for (std::size_t i = 0; i < count(); ++i)
        sites_.insert(i, sites_.inside({rows[2 * i], rows[2 * i + 1]}));
}

void EqualCells::measure_cell(std::size_t i, VoronoiCell& cell, std::vector<Bond>& bonds) {
    sites_.cut_cell(i, cell);
    moments_[i] = density_ ? (*density_)(cell, sites_[i]) : cell.moments();
    const auto corners = cell.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto& [from, neighbor, site] = corners[k];
        if (site <= i || site == CellCorner::wall) continue;
        const Vec2& to = corners[k + 1 < corners.size() ? k + 1 : 0].at;
        const Vec2& at = sites_[i];
        const double dx = to.x - from.x;
        const double dy = to.y - from.y;
        const double length =
            density_ ? density_->along({at.x + from.x, at.y + from.y}, {at.x + to.x, at.y + to.y})
                     : std::sqrt(dx * dx + dy * dy);
        const double apart = std::sqrt(neighbor.x * neighbor.x + neighbor.y * neighbor.y);
        bonds.push_back({static_cast<std::uint32_t>(i), site, length / (2 * apart)});
    }
}

void EqualCells::measure() {
    constexpr std::uint64_t size = 256;
    std::vector<std::vector<Bond>> found(block_count(count(), size));
    sites_.set_weights(weights_);
    const RunContext part = worth_threads(run_, 2e-6 * static_cast<double>(count()));
    for_each_block(silent(part), count(), size, [&](const Block& block) {
        VoronoiCell cell;
        for (std::uint64_t i = block.first; i < block.last; ++i)
            measure_cell(i, cell, found[block.index]);
    });
    bonds_.clear();
    for (const auto& bonds : found) bonds_.insert(bonds_.end(), bonds.begin(), bonds.end());
}

double EqualCells::worst() const {
    double most = 0;
    for (const CellMoments& cell : moments_)
        most = std::max(most, std::abs(cell.mass / share_ - 1));
    return most;
}

double EqualCells::error() const {
    double sum = 0;
    for (const CellMoments& cell : moments_) sum += (cell.mass - share_) * (cell.mass - share_);
    return std::sqrt(sum);
}

double EqualCells::least_mass() const {
    return std::ranges::min_element(moments_, {}, &CellMoments::mass)->mass;
}

std::vector<double> EqualCells::newton_step() const {
    constexpr double accuracy = 1e-5;  // largest residual, as a fraction of the masses' error
    const std::size_t n = count();
    std::vector<double> step(n), residual(n), direction(n), image(n), scale(n, 1e-300);
    for (const auto& [a, b, conductance] : bonds_) {
        scale[a] += conductance;
        scale[b] += conductance;
    }
    for (std::size_t i = 0; i < n; ++i) residual[i] = share_ - moments_[i].mass;
    const double goal = accuracy * accuracy * dot(residual, residual);
    double before = 0;
    for (std::size_t k = 0; k < 10 * n + 100 && dot(residual, residual) > goal; ++k) {
        run_.check_stop();
        for (std::size_t i = 0; i < n; ++i) image[i] = residual[i] / scale[i];
        const double now = dot(residual, image);
        const double back = k > 0 ? now / before : 0;
        for (std::size_t i = 0; i < n; ++i) direction[i] = image[i] + back * direction[i];
        apply(bonds_, direction, image);
        const double curvature = dot(direction, image);
        if (!(curvature > 0)) break;  // only rounding errors are left
        const double along = now / curvature;
        for (std::size_t i = 0; i < n; ++i) {
            step[i] += along * direction[i];
            residual[i] -= along * image[i];
        }
        before = now;
    }
    return step;
}

bool EqualCells::try_steps(const std::vector<double>& step) {
    const std::vector<double> start = weights_;
    const double floor = std::min(least_mass(), share_) / 2;
    const double before = error();
    for (double part = 1; part > 1e-4; part /= 2) {
        for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = start[i] + part * step[i];
        measure();
        if (least_mass() >= floor && error() <= (1 - part / 2) * before) return true;
    }
    weights_ = start;
    measure();
    return false;
}

void EqualCells::revive(std::span<const double> rescue) {
    measure();
    if (least_mass() > 0) return;
    std::ranges::fill(weights_, 0.0);
    measure();
    for (std::size_t i = 0; i < count(); ++i)
        if (!(moments_[i].mass > 0)) move(i, {rescue[2 * i], rescue[2 * i + 1]});
    measure();
}

double EqualCells::equalize(double tolerance, std::span<const double> rescue, std::size_t steps) {
    revive(rescue);
    for (std::size_t k = 0; k < steps && worst() > tolerance && least_mass() > 0; ++k)
        if (!try_steps(newton_step())) break;
    return worst();
}

void EqualCells::move_to_centroids() {
    for (std::size_t i = 0; i < count(); ++i) {
        const CellMoments& cell = moments_[i];
        if (!(cell.mass > 0)) continue;
        move(i, {sites_[i].x + cell.first.x / cell.mass, sites_[i].y + cell.first.y / cell.mass});
    }
}

}  // namespace stipple
