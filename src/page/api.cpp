// SPDX-License-Identifier: MIT
//
// Report pages, for the public API.
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/output.hpp"
#include "page/html.hpp"
#include "page/measures.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/set_writer.hpp"
#include "stipple/study.hpp"

namespace stipple {

void write_report(const std::string& path, std::span<const NamedSet> sets,
                  const RunContext& run) try {
    if (sets.empty() || sets.size() > page::most_sets)
        fail(ErrorKind::usage, "a report compares 1 to {} sets; {} are given", page::most_sets,
             sets.size());
    std::set<std::string> names;
    std::vector<std::string> title;
    for (const auto& [name, points] : sets) {
        if (points.dimension() != sets.front().points.dimension())
            fail(ErrorKind::usage, "'{}' has {} coordinates; the first set has {}", name,
                 points.dimension(), sets.front().points.dimension());
        check_set(points);
        if (!names.insert(name).second) fail(ErrorKind::usage, "two sets have the name '{}'", name);
        title.push_back(name);
    }
    page::Page all{.title = join(title, " · "), .version = STIPPLE_VERSION};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        PointSet points = sets[i].points;
        if (!points.domain) points.domain = unit_cube(points.dimension());
        page::Set set{
            .name = sets[i].name, .source = sets[i].name, .provenance = points.provenance};
        all.sets.push_back(page::finished_set(std::move(set), points, {}, page::usual_work, i, true,
                                              part_of_run(run, i, sets.size())));
    }
    io::Output output(path, run.stop);
    if (output.write(page::to_html(all))) output.commit();
} catch (...) {
    throw_to_caller();
}

}  // namespace stipple
