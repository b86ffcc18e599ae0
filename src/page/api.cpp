// SPDX-License-Identifier: MIT
//
// Report pages, for the public API.
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "page/page_html.hpp"
#include "page/page_set.hpp"
#include "stipple/study.hpp"

namespace stipple {

void write_report(const std::string& path, std::span<const NamedSet> sets, const RunContext& run) {
    if (sets.empty() || sets.size() > most_page_sets)
        fail(ErrorKind::usage, "a report compares 1 to {} sets; these are {}", most_page_sets,
             sets.size());
    std::set<std::string> names;
    std::vector<std::string> title;
    for (const auto& [name, points] : sets) {
        if (points.dimension() != sets.front().points.dimension())
            fail(ErrorKind::usage, "'{}' has {} coordinates; the first set has {}", name,
                 points.dimension(), sets.front().points.dimension());
        if (!names.insert(name).second) fail(ErrorKind::usage, "two sets are called '{}'", name);
        title.push_back(name);
    }
    Page page{.title = join(title, " · "), .version = STIPPLE_VERSION, .command = {}, .sets = {}};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        PointSet points = sets[i].points;
        if (!points.domain) points.domain = unit_cube(points.dimension());
        const auto all = static_cast<double>(sets.size());
        const auto at = static_cast<double>(i);
        PageSet set{.name = sets[i].name,
                    .source = sets[i].name,
                    .count = points.count(),
                    .dimension = points.dimension(),
                    .domain = points.domain->spec(),
                    .provenance = points.provenance};
        page.sets.push_back(finished_set(std::move(set), points, {}, {}, i, true,
                                         run.stage(at / all, (at + 1) / all)));
    }
    io::Output output(path, run.stop);
    if (output.write(page_html(page))) output.commit();
}

}  // namespace stipple
