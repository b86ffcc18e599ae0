// SPDX-License-Identifier: MIT
//
// Jittered (stratified) points: one in each of n cells of equal volume, uniform in it.
//
//     d = 1    n intervals
//     d = 2    R = sqrt(n) rounded rows. Row r has the cells s_r, ..., s_{r+1} - 1, where
//              s_r = floor(r n / R), side by side and equally wide; it reaches from y = s_r / n to
//              s_{r+1} / n. So all cells have the area 1 / n, and for n = k^2 they are the k x k
//              grid.
//     d > 2    k^d = n cubes, the first coordinate fastest
//
// Cost    O(n d); point i is found without the others.
// Promise point i is in cell i, half-open, in exact arithmetic (math/digital/stratum.hpp).
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927.

#include <algorithm>
#include <numeric>

#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "math/digital/stratum.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/ratio.hpp"
#include "math/geometry/lattice.hpp"

namespace stipple::generators::jittered {
namespace {

constexpr Param<Choice> cell{.name = "cell",
                             .fallback = "random",
                             .choices = "random|center",
                             .help = "Where in its cell a point is"};

class Jittered : public Sequence {
  public:
    Jittered(const Plan& plan, bool centered)
        : count_(plan.count), dimension_(plan.dimension), centered_(centered), rng_(plan.seed) {}

    void fill(std::uint64_t first, std::span<double> rows) override {
        if (!centered_) rng_.fill(first * dimension_, rows);
        place_all(first, rows);
    }

  protected:
    /// Brings all coordinates from [0, 1) into their cells, or to the middles.
    virtual void place_all(std::uint64_t first, std::span<double> rows) const = 0;

    void place(const Strata& strata, double* x, std::size_t stride) const {
        centered_ ? place_in_middles(strata, x, stride) : place_in_strata(strata, x, stride);
    }

    std::uint64_t count_;
    std::size_t dimension_;

  private:
    bool centered_;
    Rng rng_;
};

class JitteredRows final : public Jittered {
  public:
    JitteredRows(const Plan& plan, bool centered)
        : Jittered(plan, centered), row_count_(rounded_root(count_)) {}

  private:
    void place_all(std::uint64_t first, std::span<double> rows) const override {
        // s_r <= i holds for r < (i + 1) R / n.
        auto row = static_cast<std::uint64_t>((Wide{first + 1} * row_count_ - 1) / count_);
        for (std::size_t offset = 0; offset < rows.size(); ++row) {
            const std::uint64_t begin = row_begin(row);
            const std::uint64_t cells = row_begin(row + 1) - begin;
            const std::uint64_t column = first - begin;
            const auto length = std::min<std::size_t>((rows.size() - offset) / 2, cells - column);
            std::vector<double> low(length);
            std::iota(low.begin(), low.end(), static_cast<double>(column));
            place({.low = low, .parts = cells}, rows.data() + offset, 2);
            std::ranges::fill(low, static_cast<double>(begin));
            place({.low = low, .width = cells, .parts = count_}, rows.data() + offset + 1, 2);
            first += length;
            offset += 2 * length;
        }
    }

    [[nodiscard]] std::uint64_t row_begin(std::uint64_t row) const {
        return static_cast<std::uint64_t>(Wide{row} * count_ / row_count_);
    }

    std::uint64_t row_count_;
};

class JitteredCubes final : public Jittered {
  public:
    JitteredCubes(const Plan& plan, bool centered)
        : Jittered(plan, centered),
          shape_(plan.dimension, exact_root(plan.count, plan.dimension, "jittered")) {}

  private:
    void place_all(std::uint64_t first, std::span<double> rows) const override {
        const std::size_t portion = 1 + 4096 / dimension_;
        std::vector<double> cells;
        for (std::size_t at = 0; at < rows.size(); at += portion * dimension_) {
            const auto some = rows.subspan(at, std::min(portion * dimension_, rows.size() - at));
            cells.resize(some.size());
            find_cells(first + at / dimension_, cells);
            place({.low = cells, .parts = shape_[0]}, some.data(), 1);
        }
    }

    /// The cells of points first, first + 1...
    void find_cells(std::uint64_t first, std::span<double> cells) const {
        const auto find_row = [&](auto start, std::size_t offset, std::size_t length) {
            double* const first_cell = cells.data() + offset * dimension_;
            for (std::size_t i = 0; i < length; ++i) {
                for (std::size_t c = 0; c < dimension_; ++c)
                    first_cell[i * dimension_ + c] = static_cast<double>(start[c]);
                first_cell[i * dimension_] += static_cast<double>(i);
            }
        };
        for_each_lattice_row(shape_, first, cells.size() / dimension_, find_row);
    }

    std::vector<std::uint64_t> shape_;
};

Plan plan(const Request& request, const Values&) {
    const std::size_t dimension = request.dimension.value_or(2);
    const std::uint64_t count = dimension == 2 ? 1024 : nearest_power(1024, dimension);
    const Plan plan = default_plan(request, count, dimension);
    if (dimension > 2) exact_root(plan.count, dimension, "jittered");
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const bool centered = options[cell] == "center";
    if (plan.dimension == 2) return std::make_unique<JitteredRows>(plan, centered);
    return std::make_unique<JitteredCubes>(plan, centered);
}

}  // namespace

Generator unit() {
    return {.name = "jittered",
            .summary = "Jittered points: one at random in each of n cells of equal volume",
            .source = "Cook 1986, doi:10.1145/7529.8927",
            .traits = {.prefix = false},
            .options = Schema(cell),
            .aliases = {"stratified"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::jittered
