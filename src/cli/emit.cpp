// SPDX-License-Identifier: MIT
//
// The verb `emit`: writes the code of a sampler.
#include "emit/emit.hpp"

#include "cli/inputs.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"

namespace stipple::cli {

int EmitRequest::perform(Session& session) const {
    if (has("name") && name.empty()) fail(ErrorKind::usage, "--name: '' is not a name");
    const Generator& generator = find_generator(unit);
    SetsToMake job = sets_asked(generator, settings_of(generator.options, *this), *this);
    job.command = command_text(*this);
    write_text(output_of(*this), emit::emitted(std::move(job), language, name, session.run()));
    return 0;
}

}  // namespace stipple::cli
