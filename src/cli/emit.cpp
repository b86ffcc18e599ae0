// SPDX-License-Identifier: MIT
//
// The verb `emit`: writes the code of a sampler.
#include "emit/emit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/inputs.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"

namespace stipple::cli {

int EmitRequest::perform(Session& session) const {
    const Generator& generator = find_generator(unit);
    std::string command = "stipple emit " + unit;
    for (const auto& [option, value] : settings) {
        const auto& known = generator.options.options();
        const bool flag = std::ranges::find(known, option, &Option::name)->type == "flag";
        command += typed_option(option, value, flag);
    }
    command += command_text(*this);
    SetsToMake job = sets_asked(generator, settings_of(generator.options, *this), *this);
    job.command = command;
    write_text(output_of(*this), emit::emitted(std::move(job), language, name, session.run()));
    return 0;
}

}  // namespace stipple::cli
