// SPDX-License-Identifier: MIT
#include "page/page_set.hpp"

#include <utility>
#include <variant>

#include "page/page_figures.hpp"

namespace stipple {

PageSet finished_set(PageSet set, const PointSet& points, const PageInput& input,
                     const PageLimits& limits, std::size_t number, bool with_pictures,
                     const RunContext& run) {
    set.measures = measure_set(points, input, limits, run);
    if (!with_pictures) return set;
    set.figures = point_figures(points, set, number);
    if (auto spectrum = spectrum_figure(set); !spectrum.empty())
        set.figures.push_back(std::move(spectrum));
    for (PageMeasure& measure : set.measures)
        if (measure.results)
            std::erase_if(measure.results->entries(), [](const Report::Entry& entry) {
                return std::holds_alternative<Grid>(entry.value);
            });
    return set;
}

}  // namespace stipple
