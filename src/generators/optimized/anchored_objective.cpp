// SPDX-License-Identifier: MIT
//
// The star discrepancy in two and three dimensions over all boxes that end at coordinates of
// points,
//
//     open    V - c / n     c = number of points with all coordinates below those of the corner
//     closed  c / n - V     c = number of points with no coordinate above those of the corner
//
// where V is the product of the corner's coordinates. Boxes are searched plane by plane along the
// first axis, with the counts of one plane in memory. With weights w_j >= 0 a box is weighted by
// the product of w_j over the axes on which it does not end at 1. If w_j > 1, a box that ends at 1
// gets the weight w_j, too, which is that of the boxes that end just below 1.
#include <algorithm>
#include <functional>
#include <vector>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "generators/optimized/objective.hpp"
#include "math/combinatorics/order.hpp"
#include "math/functions/exponential.hpp"

namespace stipple::optimized {
namespace {

/// Box, given by the ranks of its corner's coordinates; rank n is the coordinate 1.
struct Hit {
    std::uint32_t at[3];
    float value;
    bool open;
};

/// Number of boxes with the largest values that count. Others matter little in the soft maximum, but
/// the first look, which guesses the discrepancy too small, finds very many.
constexpr std::size_t most_hits = std::size_t{1} << 19;
constexpr std::size_t few_rows = 1024;  ///< rows between two checks for a stop

/// Counts of points in rows, one row per value of the second to last coordinate. For the boxes of a
/// row, `reaches` is the volume per unit of the last coordinate and `shares` is 1/n, both times the
/// box's weight, and negated for closed boxes.
struct Plane {
    const float* counts;
    std::size_t stride;
    const float* reaches;
    const float* shares;
    std::size_t rows;
};

struct Place {
    std::uint32_t row;
    std::uint32_t column;
};

/// Whether values[k] * reach - counts[k] * share > least for a k in [first, last).
inline bool any_above(const float* values, const float* counts, float reach, float share,
                      float least, std::size_t first, std::size_t last) {
    int any = 0;
    for (std::size_t k = first; k < last; ++k)
        any |= int{values[k] * reach - counts[k] * share > least};
    return any != 0;
}

/// Appends the row and column k of all boxes of a plane with
/// values[k] * reach - counts[k] * share > least. Most rows have none, and are ruled out first.
STIPPLE_WIDE void find_above(const Plane& plane, const float* values, float least,
                             std::size_t first, std::size_t last, std::vector<Place>& places) {
    constexpr std::size_t lanes = 32;
    for (std::size_t b = 0; b < plane.rows; ++b) {
        const float* counts = plane.counts + b * plane.stride;
        const float reach = plane.reaches[b];
        const float share = plane.shares[b];
        if (!any_above(values, counts, reach, share, least, first, last)) continue;
        for (std::size_t from = first; from < last; from += lanes) {
            const std::size_t to = std::min(from + lanes, last);
            if (!any_above(values, counts, reach, share, least, from, to)) continue;
            for (std::size_t k = from; k < to; ++k)
                if (values[k] * reach - counts[k] * share > least)
                    places.push_back(
                        {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(k)});
        }
    }
}

STIPPLE_WIDE void add_one(float* counts, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) counts[k] += 1;
}

class AnchoredObjective final : public Objective {
  public:
    AnchoredObjective(const std::vector<double>& weights, std::size_t count, std::size_t dimension)
        : n_(count),
          d_(dimension),
          width_((count + 1 + lanes - 1) / lanes * lanes),
          stride_(width_ + lanes) {
        for (std::size_t j = 0; j < d_; ++j)
            weights_[3 - d_ + j] = weights.empty() ? 1 : static_cast<float>(weights[j]);
    }

    double value(std::span<const double> rows, double sharpness, std::span<double> gradient,
                 const RunContext& run) override {
        sort_axes(rows);
        if (last_ == 0) last_ = static_cast<double>(d_ + 1) / static_cast<double>(n_);  // a guess
        double most = 0;
        for (double least = last_ * (1 - reach / sharpness); most == 0; least *= 0.8) {
            look(static_cast<float>(std::max(least, 0.0)), run);
            thin(parts_);
            for (const Part& part : parts_)
                for (const Hit& hit : part.hits)
                    most = std::max(most, static_cast<double>(hit.value));
        }
        last_ = most;
        put_gradient(most, sharpness / most, gradient);
        return most;
    }

    [[nodiscard]] double steps() const override {
        const auto size = static_cast<double>(n_ + 1);
        return d_ == 3 ? size * size * (20 + size / 9) : size * (size / 4 + 300);
    }

  private:
    static constexpr std::size_t lanes = 16;

    /// A range of planes, searched by one thread: its buffers, and the boxes found (hits).
    struct Part {
        std::vector<float> counts;
        std::vector<float> reaches;
        std::vector<float> shares;
        std::vector<Place> places;
        std::vector<Hit> hits;
    };

    /// Boxes with weights below e^-reach in the soft maximum are ignored.
    static constexpr double reach = 7;

    /// Weight of an axis for a box that ends at the coordinate of rank `place`.
    [[nodiscard]] float weight(std::size_t axis, std::size_t place) const {
        return place < n_ ? weights_[axis] : std::max(1.0F, weights_[axis]);
    }

    /// Leaves the hits with the `most_hits` largest values; of equal ones, the first.
    static void thin(std::span<Part> parts) {
        std::vector<float> values;
        for (const Part& part : parts)
            for (const Hit& hit : part.hits) values.push_back(hit.value);
        if (values.size() <= most_hits) return;
        const auto last = values.begin() + (most_hits - 1);
        std::ranges::nth_element(values, last, std::greater());
        auto equal = std::count(values.begin(), last + 1, *last);
        for (Part& part : parts)
            std::erase_if(part.hits, [&](const Hit& hit) {
                return hit.value < *last || (hit.value == *last && equal-- <= 0);
            });
    }

    void sort_axes(std::span<const double> rows) {
        for (std::size_t axis = 3 - d_; axis < 3; ++axis) {
            const std::size_t j = axis + d_ - 3;
            const auto at = [&](std::uint32_t i) { return rows[i * d_ + j]; };
            const auto& order = order_[axis] = order_by(n_, at);
            values_[axis].assign(width_, 0);  // after the 1: padding, for boxes of value 0
            values_[axis][n_] = 1;
            ranks_[axis].resize(n_);
            for (std::uint32_t place = 0; place < n_; ++place) {
                values_[axis][place] = static_cast<float>(at(order[place]));
                ranks_[axis][order[place]] = place;
            }
        }
    }

    /// Finds all boxes whose value exceeds `least`, plane by plane along the first axis; in two
    /// dimensions there is one plane. Planes are divided into no more parts than threads, because
    /// each part begins by counting the points before its first plane.
    void look(float least, const RunContext& run) {
        constexpr std::size_t few = 100;
        const std::size_t planes = d_ == 3 ? n_ + 1 : 1;
        const RunContext inner = silent(worth_threads(run, steps() * 1e-9));
        const std::size_t parts = planes < few ? 1 : inner.thread_count();
        const std::size_t together = (planes + parts - 1) / parts;
        parts_.resize(block_count(planes, together));
        for_each_block(inner, planes, together, [&](const Block& block) {
            Part& part = parts_[block.index];
            part.counts.assign((n_ + 2) * stride_, 0);
            part.hits.clear();
            const std::size_t shift = n_ + 1 - planes;
            for (std::uint32_t i = 0; i < n_; ++i) {
                run.check_stop();
                if (d_ == 2 || ranks_[0][i] < block.first) add(i, part.counts);
            }
            for (std::uint64_t a = block.first; a < block.last; ++a) {
                run.check_stop();
                look_at(a + shift, least, part, run);
            }
        });
    }

    void add(std::uint32_t point, std::vector<float>& counts) const {
        const std::size_t first = ranks_[2][point] + 1;
        for (std::size_t b = ranks_[1][point] + 1; b <= n_ + 1; ++b)
            add_one(&counts[b * stride_ + first], n_ + 2 - first);
    }

    /// Searches the boxes that end in plane `a`, and adds the point of that plane to the counts.
    void look_at(std::size_t a, float least, Part& part, const RunContext& run) const {
        look_in(a, true, least, part, run);
        if (a < n_) add(order_[0][a], part.counts);
        look_in(a, false, least, part, run);
    }

    /// Searches the open or closed boxes that end in plane `a`. For closed boxes, reads the counts
    /// one row and one column further on: they include points on the sides.
    void look_in(std::size_t a, bool open, float least, Part& part, const RunContext& run) const {
        const float outer = weight(0, a) * (open ? 1 : -1);
        const float width = d_ == 3 ? values_[0][a] : 1;
        part.reaches.resize(n_ + 1);
        part.shares.resize(n_ + 1);
        for (std::size_t b = 0; b <= n_; ++b) {
            const float times = outer * weight(1, b);
            part.reaches[b] = width * values_[1][b] * times;
            part.shares[b] = times / static_cast<float>(n_);
        }
        const float* from = part.counts.data() + (open ? 0 : stride_ + 1);
        const auto take = [&](std::size_t first, std::size_t last, float times) {
            for (std::size_t b = 0; times != 1 && b <= n_; ++b) {
                part.reaches[b] *= times;
                part.shares[b] *= times;
            }
            for (std::size_t row = 0; row <= n_; row += few_rows) {
                run.check_stop();
                part.places.clear();
                find_above({from + row * stride_, stride_, &part.reaches[row], &part.shares[row],
                            std::min(few_rows, n_ + 1 - row)},
                           values_[2].data(), least, first, last, part.places);
                for (const auto& [k, c] : part.places) {
                    const std::size_t b = row + k;
                    if (part.hits.size() == 2 * most_hits) thin({&part, 1});
                    part.hits.push_back(
                        {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), c},
                         values_[2][c] * part.reaches[b] - from[b * stride_ + c] * part.shares[b],
                         open});
                }
            }
        };
        const bool even = weights_[2] >= 1;
        if (!even) take(n_, n_ + 1, 1);
        take(0, even ? width_ : n_, weights_[2]);
    }

    void put_gradient(double most, double sharpness, std::span<double> gradient) const {
        std::ranges::fill(gradient, 0);
        double total = 0;
        for (const Part& part : parts_)
            for (const Hit& hit : part.hits) {
                const double weight =
                    exponential(sharpness * (static_cast<double>(hit.value) - most));
                total += weight;
                add_slopes(hit, hit.open ? weight : -weight, gradient);
            }
        for (double& slope : gradient) slope /= total;
    }

    void add_slopes(const Hit& hit, double times, std::span<double> gradient) const {
        for (std::size_t axis = 3 - d_; axis < 3; ++axis)
            times *= static_cast<double>(weight(axis, hit.at[axis]));
        for (std::size_t axis = 3 - d_; axis < 3; ++axis) {
            if (hit.at[axis] == n_) continue;
            double slope = times;
            for (std::size_t other = 3 - d_; other < 3; ++other)
                if (other != axis) slope *= static_cast<double>(values_[other][hit.at[other]]);
            gradient[order_[axis][hit.at[axis]] * d_ + axis + d_ - 3] += slope;
        }
    }

    std::size_t n_;
    std::size_t d_;
    std::size_t width_;   ///< size of values_, a multiple of `lanes`
    std::size_t stride_;  ///< length of a row of counts
    float weights_[3] = {1, 1, 1};
    double last_ = 0;  ///< value at the points of the previous call
    std::vector<std::uint32_t> order_[3];
    std::vector<std::uint32_t> ranks_[3];
    std::vector<float> values_[3];  ///< sorted coordinates, then 1
    std::vector<Part> parts_;
};

}  // namespace

double anchored_memory(std::size_t count, std::size_t dimension) {
    const auto n = static_cast<double>(count + 32);
    const double boxes = 2 * n * n * (dimension == 3 ? n : 1);
    return 4 * n * n + sizeof(Place) * n * std::min(n, static_cast<double>(few_rows)) +
           (sizeof(Hit) + sizeof(float)) * std::min(boxes, 2.0 * most_hits);
}

std::unique_ptr<Objective> anchored_objective(const std::vector<double>& weights, std::size_t count,
                                              std::size_t dimension) {
    return std::make_unique<AnchoredObjective>(weights, count, dimension);
}

}  // namespace stipple::optimized
