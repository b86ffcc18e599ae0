// SPDX-License-Identifier: MIT
#include "media/density_moments.hpp"

#include <algorithm>
#include <cmath>

namespace stipple {

DensityMoments::DensityMoments(std::size_t width, std::size_t height,
                               std::span<const double> values, Vec2 sides)
    : width_(static_cast<std::int64_t>(width)),
      height_(static_cast<std::int64_t>(height)),
      sides_(sides),
      size_{sides.x / static_cast<double>(width), sides.y / static_cast<double>(height)} {
    pixels_.reserve((width + 1) * height);
    for (std::size_t row = 0; row < height; ++row) {
        Pixel sum;
        for (std::size_t column = 0; column < width; ++column) {
            sum.density = values[row * width + column];
            pixels_.push_back(sum);
            const double a = static_cast<double>(column) * size_.x;
            const double b = static_cast<double>(column + 1) * size_.x;
            sum.mass += sum.density * (b - a);
            sum.first += sum.density * (b - a) * (a + b) / 2;
            sum.second += sum.density * (b - a) * (a * a + a * b + b * b) / 3;
        }
        pixels_.push_back(sum);
    }
}

std::int64_t DensityMoments::column_of(double x) const {
    return static_cast<std::int64_t>(std::floor(x / size_.x));
}

std::int64_t DensityMoments::row_of(double y) const {
    return static_cast<std::int64_t>(std::floor(y / size_.y));
}

DensityMoments::Place DensityMoments::place(std::int64_t column, std::int64_t row) const {
    const auto inside = [](std::int64_t i, std::int64_t n) { return ((i % n) + n) % n; };
    const std::int64_t there = inside(column, width_);
    const Pixel* line = &pixels_[static_cast<std::size_t>(inside(row, height_) * (width_ + 1))];
    Pixel left = line[there];
    const double x = static_cast<double>(there) * size_.x;
    if (there == column) return {left, x};
    // Adds the integrals over `turns` periods; in period m = 0, 1, ... x is larger by m sides_.x.
    const auto turns = static_cast<double>((column - there) / width_);
    const double shift = turns * sides_.x;
    const double squares = (turns - 1) * turns * (2 * turns - 1) / 6 * sides_.x * sides_.x;
    const double steps = turns * (turns - 1) / 2 * sides_.x;
    const Pixel& whole = line[width_];
    left.second += 2 * shift * left.first + shift * shift * left.mass;
    left.second += turns * whole.second + 2 * steps * whole.first + squares * whole.mass;
    left.first += shift * left.mass + turns * whole.first + steps * whole.mass;
    left.mass += turns * whole.mass;
    return {left, x + shift};
}

/// Splits an edge at pixel boundaries and calls visit(pixel, a, b) for each segment.
template <class Visit>
void DensityMoments::walk(Vec2 from, Vec2 to, const Visit& visit) const {
    const Vec2 step{to.x - from.x, to.y - from.y};
    std::int64_t column = column_of(from.x);
    std::int64_t row = row_of(from.y);
    const std::int64_t right = step.x > 0;
    const std::int64_t up = step.y > 0;
    std::int64_t crossings = std::abs(column_of(to.x) - column) + std::abs(row_of(to.y) - row);
    Vec2 a = from;
    for (;; --crossings) {
        const double next_x = static_cast<double>(column + right) * size_.x;
        const double next_y = static_cast<double>(row + up) * size_.y;
        const double t_x = step.x != 0 ? (next_x - from.x) / step.x : 2;
        const double t_y = step.y != 0 ? (next_y - from.y) / step.y : 2;
        if (crossings == 0 || std::min(t_x, t_y) >= 1) return visit(place(column, row), a, to);
        const bool aside = t_x < t_y;
        const Vec2 b =
            aside ? Vec2{next_x, from.y + t_x * step.y} : Vec2{from.x + t_y * step.x, next_y};
        visit(place(column, row), a, b);
        (aside ? column : row) += (aside ? right : up) ? 1 : -1;
        a = b;
    }
}

CellMoments DensityMoments::operator()(const VoronoiCell& cell, Vec2 site) const {
    CellMoments sum;
    double second_x = 0;
    double second_y = 0;
    const auto add = [&](const Place& pixel, Vec2 at, double weight) {
        const auto& [mass, first, second, density] = pixel.left;
        const double a = pixel.x_low;
        const double d = at.x - a;
        const double f0 = mass + density * d;
        const double f1 = first + density * d * (a + at.x) / 2;
        const double f2 = second + density * d * (a * a + a * at.x + at.x * at.x) / 3;
        const double y = at.y - site.y;
        sum.mass += weight * f0;
        sum.first.x += weight * (f1 - site.x * f0);
        sum.first.y += weight * y * f0;
        second_x += weight * (f2 - 2 * site.x * f1 + site.x * site.x * f0);
        second_y += weight * y * y * f0;
    };
    const auto corners = cell.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2& from = corners[k].at;
        const Vec2& to = corners[k + 1 < corners.size() ? k + 1 : 0].at;
        walk({site.x + from.x, site.y + from.y}, {site.x + to.x, site.y + to.y},
             [&](const Place& pixel, Vec2 a, Vec2 b) {
                 const double weight = (b.y - a.y) / 6;
                 add(pixel, a, weight);
                 add(pixel, {(a.x + b.x) / 2, (a.y + b.y) / 2}, 4 * weight);
                 add(pixel, b, weight);
             });
    }
    sum.second = second_x + second_y;
    return sum;
}

double DensityMoments::along(Vec2 from, Vec2 to) const {
    double sum = 0;
    walk(from, to, [&](const Place& pixel, Vec2 a, Vec2 b) {
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        sum += pixel.left.density * std::sqrt(dx * dx + dy * dy);
    });
    return sum;
}

}  // namespace stipple
