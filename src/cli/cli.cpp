// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <new>

#include "cli/launched.hpp"
#include "cli/parsing/requests.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/output.hpp"

namespace stipple::cli {
namespace {

int exit_code(ErrorKind kind) {
    constexpr std::array codes = {2, 3, 4, 5, 130};  // of usage, input, io, limit, cancelled
    return codes.at(static_cast<std::size_t>(kind));
}

/// Checks that a unit is named if the verb needs one. @throws Error(usage)
void require_unit(const Arguments& arguments) {
    const VerbInfo& info = info_of(*arguments.verb);
    const Kind* kind = units_for(info.name);
    if (!kind || !arguments.unit.empty()) return;
    fail_with_hint(ErrorKind::usage, fmt::format("'stipple list {}' names them", kind->name),
                   "{}: name one of the {}", info.name, kind->name);
}

int dispatch(const Arguments& arguments) {
    if (arguments.version) {
        write_text("-", version_text());
        return 0;
    }
    if (arguments.help) {
        write_text("-", help_text(arguments));
        return 0;
    }
    if (!arguments.verb) {
        say(help_text(arguments));
        return exit_code(ErrorKind::usage);
    }
    require_unit(arguments);
    const auto request = request_of(arguments);
    Session session(*request);
    const int code = work_on(*request, session);
    try {
        session.tell_warnings();
    } catch (const std::bad_alloc&) {  // no failure: all output is written
        say("stipple: out of memory for its warnings\n");
    }
    return code;
}

/// Prints the error that ends the program in one line, unless another process prints it. Returns
/// the exit code.
int end_with(std::string_view verb, const Error& error) {
    const Error cause = shared_failure(verb, error);
    const std::string what = cause.what();
    if (!is_mute(verb)) say_line(cause.hint().empty() ? what : what + "; " + cause.hint());
    return exit_code(cause.kind());
}

/// Runs the verb and reports its error; returns the exit code.
int run_verb(int argc, char** argv) {
    const std::string_view verb = argc > 1 ? argv[1] : "";
    try {
        catch_interrupts();
        if (verb == "complete") {
            write_text("-", complete({argv + 2, argv + argc}));
            return 0;
        }
        return dispatch(parse_arguments(argc, argv));
    } catch (const std::exception&) {
        return end_with(verb, caught_error());
    }
}

/// Terminate handler: reports a lack of memory that no handler can catch, such as in destructors of
/// JSON values or while another error is reported. Otherwise aborts.
[[noreturn]] void end_terminated() {
    try {
        if (const auto caught = std::current_exception()) std::rethrow_exception(caught);
    } catch (const std::bad_alloc&) {
        io::PartFiles::remove_all();
        say("stipple: out of memory\n");
        std::_Exit(exit_code(ErrorKind::limit));
    } catch (...) {
    }
    std::abort();
}

}  // namespace

int work_on(Request& request, Session& session) {
    // The ranks must be joined before read_parameter_file(), where they compare their files.
    if (request.parameters_file && is_shared(info_of(*request.verb).name))
        launched(request, session.run());
    read_parameter_file(request, session.run());
    return request.perform(session);
}

void write_text(const std::string& path, const std::string& text) {
    io::Output output(path);
    if (output.write(text)) output.commit();
}

int run(int argc, char** argv) {
    std::set_terminate(end_terminated);
    const int code = run_verb(argc, argv);
    leave_ranks();
    return code;
}

}  // namespace stipple::cli
