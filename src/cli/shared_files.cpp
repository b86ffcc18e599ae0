// SPDX-License-Identifier: MIT
#include "cli/shared_files.hpp"

#include <memory>
#include <optional>

#include "cli/bounds.hpp"
#include "cli/verbs.hpp"

namespace stipple::cli {

SharedSet shared_files(const Arguments& arguments, const Analyzer& analyzer,
                       const std::string& strengths, Ranks& ranks, const RunContext& run) {
    const auto open = [&arguments, run, strengths](const std::string& path) {
        return open_input(path, arguments, run, strengths);
    };
    const auto files = std::make_shared<SharedFiles>(arguments.inputs, open, ranks);
    const auto first = open(arguments.inputs.front());
    const bool weighted = !strengths.empty();
    const std::size_t width = files->dimension();
    const std::size_t d = width - (weighted ? 1 : 0);
    SharedSet set{.domain = domain_of(*first, d, analyzer, arguments, run),
                  .count = files->count(),
                  .dimension = d,
                  .weighted = weighted,
                  .from = [files](std::uint64_t from) { return files->from(from); }};
    const auto bounds = arguments.get("bounds");
    if (!bounds) return set;
    set.from = [files, width, box = parse_box(*bounds, d),
                &analyzer](std::uint64_t from) -> NextRows {
        return [next = files->from(from), width, box, &analyzer,
                at = from](std::span<double> rows) mutable {
            const std::size_t count = next(rows);
            take_bounds(rows.first(count * width), width, box, at, analyzer);
            at += count;
            return count;
        };
    };
    return set;
}

}  // namespace stipple::cli
