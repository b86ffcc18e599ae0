// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/varying/radius_field.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "math/functions/powers.hpp"

namespace stipple::poisson_disk {
namespace {

/// Boundaries of `cells` equal cells along axis k, both ends included.
std::vector<double> lines_of(const Box& box, std::size_t k, std::size_t cells) {
    std::vector<double> lines;
    for (std::size_t i = 0; i < cells; ++i)
        lines.push_back(box.low[k] +
                        box.extent(k) * (static_cast<double>(i) / static_cast<double>(cells)));
    lines.push_back(box.high[k]);
    return lines;
}

/// For each interval between two lines, the index of the coarser interval that contains it.
std::vector<std::size_t> owners(const std::vector<double>& lines,
                                const std::vector<double>& coarser) {
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        owner.push_back(static_cast<std::size_t>(std::ranges::upper_bound(coarser, lines[i]) -
                                                 coarser.begin() - 1));
    return owner;
}

/// Values of a grid, indexed by the finer cells of a field.
struct Seen {
    const double* values = nullptr;
    std::size_t width = 0;
    std::array<std::vector<std::size_t>, 2> owner = {};

    Seen(const Box& box, const std::array<std::vector<double>, 2>& lines, const double* of,
         std::size_t columns, std::size_t rows)
        : values(of),
          width(columns),
          owner{owners(lines[0], lines_of(box, 0, columns)),
                owners(lines[1], lines_of(box, 1, rows))} {}

    [[nodiscard]] double at(std::size_t i, std::size_t j) const {
        return values[owner[1][j] * width + owner[0][i]];
    }
};

}  // namespace

RadiusField::RadiusField(const Box& box, const FieldSource& source, const RunContext& run) {
    std::array<std::size_t, 2> most{1, 1};
    for (std::size_t k = 0; k < 2; ++k) {
        lines_[k] = {box.low[k], box.high[k]};
        const auto add = [&](std::size_t cells) {
            const std::vector<double> more = lines_of(box, k, cells);
            lines_[k].insert(lines_[k].end(), more.begin(), more.end());
        };
        if (source.density) add(k == 0 ? source.density->width() : source.density->height());
        if (source.lengths) add(k == 0 ? source.lengths->width : source.lengths->height);
        if (source.mask) add(k == 0 ? source.mask->width() : source.mask->height());
        std::ranges::sort(lines_[k]);
        lines_[k].erase(std::unique(lines_[k].begin(), lines_[k].end()), lines_[k].end());
        most[k] = lines_[k].size() - 1;
    }
    const double cells = static_cast<double>(most[0]) * static_cast<double>(most[1]);
    run.need_memory(cells * 24, "the field of radii");
    levels_.push_back({most, {0, 0}, {}, {}});
    fill(box, source, run);
    join(box, run);
    measure();
}

void RadiusField::fill(const Box& box, const FieldSource& source, const RunContext& run) {
    Level& cells = levels_[0];
    const std::size_t width = cells.count[0];
    const std::size_t height = cells.count[1];
    cells.least.assign(width * height, 1);
    const auto for_all = [&](const Seen& seen, const auto& work) {
        for (std::size_t j = 0; j < height; ++j) {
            run.check_stop();
            for (std::size_t i = 0; i < width; ++i) work(cells.least[j * width + i], seen.at(i, j));
        }
    };
    if (source.mask)
        for_all({box, lines_, source.mask->values().data(), source.mask->width(),
                 source.mask->height()},
                [](double& f, double inside) { f = inside > 0 ? f : closed; });
    if (source.lengths)
        for_all({box, lines_, source.lengths->values.data(), source.lengths->width,
                 source.lengths->height},
                [](double& f, double length) { f *= length; });
    if (source.density) {
        const Seen seen(box, lines_, source.density->values().data(), source.density->width(),
                        source.density->height());
        double largest = 0;
        for_all(seen, [&](double& f, double value) {
            if (f < closed) largest = std::max(largest, value);
        });
        for_all(seen, [&](double& f, double value) {
            const double ratio = std::sqrt(largest / value);
            f *= value > 0 ? std::min(ratio, widest) : ratio;  // the quotient may overflow
        });
        for (double& f : cells.least)
            if (std::isnan(f)) f = closed;  // largest is 0
    }
    const double least = std::ranges::min(cells.least);
    if (least == closed)
        fail(ErrorKind::input, "--mask: the density is 0 everywhere in it; no point can be placed");
    for (double& f : cells.least)
        if (f < closed) f = std::min(f, widest * least);
}

void RadiusField::join(const Box& box, const RunContext& run) {
    while (levels_.back().count != std::array<std::size_t, 2>{1, 1}) {
        const Level& fine = levels_.back();
        const auto side = [&](std::size_t k) {
            return box.extent(k) / static_cast<double>(levels_[0].count[k]) *
                   static_cast<double>(std::uint64_t{1} << fine.joined[k]);
        };
        std::size_t k = side(0) <= side(1) ? 0 : 1;
        if (fine.count[k] == 1) k = 1 - k;
        Level level{fine.count, fine.joined, {}, {}};
        level.count[k] = (fine.count[k] + 1) / 2;
        ++level.joined[k];
        level.least.assign(level.count[0] * level.count[1], closed);
        level.most.assign(level.count[0] * level.count[1], 0);
        const auto below = static_cast<std::uint32_t>(levels_.size() - 1);
        for (std::uint32_t j = 0; j < fine.count[1]; ++j) {
            run.check_stop();
            for (std::uint32_t i = 0; i < fine.count[0]; ++i) {
                const std::size_t to = (k == 0 ? j : j / 2) * level.count[0] + (k == 0 ? i / 2 : i);
                level.least[to] = std::min(level.least[to], least({below, i, j}));
                level.most[to] = std::max(level.most[to], most({below, i, j}));
            }
        }
        levels_.push_back(std::move(level));
    }
}

void RadiusField::measure() {
    unit_ = unit_for(least());
    const auto [width, height] = levels_[0].count;
    for (std::size_t j = 0; j < height; ++j) {
        double row = 0;
        for (std::size_t i = 0; i < width; ++i) {
            const double f = levels_[0].least[j * width + i];
            row += (lines_[0][i + 1] - lines_[0][i]) / (f / unit_) / (f / unit_);
        }
        darts_ += row * (lines_[1][j + 1] - lines_[1][j]);
    }
}

RadiusField::Nodes RadiusField::children(const Node& node) const {
    const Level& fine = levels_[node.level - 1];
    const std::size_t k = fine.joined[0] < levels_[node.level].joined[0] ? 0 : 1;
    Node lower{node.level - 1, node.i, node.j};
    std::uint32_t& along = k == 0 ? lower.i : lower.j;
    along *= 2;
    if (along + 1 >= fine.count[k]) return {lower};
    Node upper = lower;
    ++(k == 0 ? upper.i : upper.j);
    return {lower, upper};
}

std::array<std::array<double, 2>, 2> RadiusField::corners(const Node& node) const {
    const Level& level = levels_[node.level];
    std::array<std::array<double, 2>, 2> corners;
    const std::array<std::size_t, 2> at{node.i, node.j};
    for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t last = lines_[k].size() - 1;
        corners[0][k] = lines_[k][at[k] << level.joined[k]];
        corners[1][k] = lines_[k][std::min(last, (at[k] + 1) << level.joined[k])];
    }
    return corners;
}

double RadiusField::within(const Node& node, double x, double y) const {
    const Level& level = levels_[node.level];
    const std::array<std::size_t, 2> at{node.i, node.j};
    const std::array<double, 2> place{x, y};
    std::array<std::size_t, 2> cell;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto begin = lines_[k].begin();
        const std::size_t cells = lines_[k].size() - 1;
        const auto first = begin + static_cast<std::ptrdiff_t>(at[k] << level.joined[k]);
        const auto last =
            begin + static_cast<std::ptrdiff_t>(std::min(cells, (at[k] + 1) << level.joined[k]));
        cell[k] = static_cast<std::size_t>(std::upper_bound(first + 1, last, place[k]) - begin - 1);
    }
    return levels_[0].least[cell[1] * levels_[0].count[0] + cell[0]];
}

}  // namespace stipple::poisson_disk
