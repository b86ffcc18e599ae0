// SPDX-License-Identifier: MIT
//
// Progressive multi-jittered (0,2) points: the first 2^m points, for every m, meet each of the
// elementary intervals
//
//     [a / 2^k, (a + 1) / 2^k) x [b / 2^(m-k), (b + 1) / 2^(m-k)),    k = 0, ..., m,
//
// exactly once, and so do points j 2^m, ..., (j + 1) 2^m - 1 for every j.
//
// They are Sobol's points in two dimensions with nested uniform scrambling: the second coordinate's
// matrix holds the binomials C(j, k) mod 2 (Pascal's triangle). A search for free intervals would
// take memory for all points; this gives any point by itself. Every result is a pmj02 sequence, but
// not every such sequence occurs: here Pascal's matrix determines the intervals of later points
// from earlier ones, whereas a search chooses them freely.
//
// Shape   2 dimensions, indices below 2^53.
// Cost    O(n), no memory.
// Promise the above, for every seed. The points are those of sobol with nested uniform scrambling
//         by another seed, which is a random function of the given one: with the same seed, the two
//         are independent.
// Source  P. Christensen, A. Kensler, C. Kilpatrick, Comput. Graph. Forum 37 (4) (2018) 21-33,
//         doi:10.1111/cgf.13472 (what the points are); A. B. Owen 1995,
//         doi:10.1007/978-1-4612-2552-2_19 (scrambling); A. Helmer, P. Christensen, A. Kensler,
//         EGSR (2021), doi:10.2312/sr.20211287 (that it makes such sequences).

#include "core/rng.hpp"
#include "generators/digital/sobol_directions.hpp"
#include "generators/net_sequence.hpp"

namespace stipple::generators::pmj02 {
namespace {

constexpr std::size_t index_digits = 53;
constexpr std::uint64_t scrambling_stream = 0x706d6a3032;  // the letters "pmj02"

std::unique_ptr<Sequence> make(const Plan& plan, const Values&, const RunContext&) {
    return owen_sequence(sobol_matrices(2, index_digits),
                         Rng(plan.seed, scrambling_stream).bits(0));
}

}  // namespace

Generator unit() {
    return {.name = "pmj02",
            .summary =
                "Progressive multi-jittered (0,2) points: the first 2^m meet all elementary "
                "intervals, for every m",
            .source =
                "Christensen, Kensler, Kilpatrick 2018, doi:10.1111/cgf.13472; made by "
                "nested uniform scrambling of Sobol's points, Owen 1995, "
                "doi:10.1007/978-1-4612-2552-2_19, as sobol:scramble=owen is with other seeds",
            .traits = {.min_dimension = 2, .max_dimension = 2},
            .options = Schema(),
            .stream_version = 2,
            .sequence = make};
}

}  // namespace stipple::generators::pmj02
