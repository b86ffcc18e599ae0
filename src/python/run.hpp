// SPDX-License-Identifier: MIT
//
// Long computations called from Python: they run without the interpreter's lock, while the calling
// thread checks for Ctrl-C and reports progress.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/memory.hpp"
#include "python/worker.hpp"
#include "stipple/error.hpp"
#include "stipple/run.hpp"

namespace stipple::python {

namespace py = pybind11;

/// Run options of a call.
struct How {
    unsigned threads = 0;
    double max_memory = 0;  ///< memory limit in bytes; 0: that of the machine
    py::object progress;    ///< function called with the fraction done, or None
};

/// Whether this process was forked after the first call of this function. A forked process must not
/// use the thread pool of oneTBB, since the pool's threads exist only in the parent.
inline bool forked() {
    static const pid_t first = getpid();
    return first != getpid();
}

/// Issues the notes of the computation as Python warnings.
void show(const std::vector<std::string>& notes);

/// Runs work(run) on another thread and returns its result. @throws exceptions of work;
/// KeyboardInterrupt
template <class Work>
auto released(const How& how, Work work) {
    using Result = decltype(work(std::declval<const RunContext&>()));
    std::optional<Result> result;
    std::exception_ptr error;
    std::atomic<double> done = 0;
    std::vector<std::string> notes;
    std::mutex mutex;
    std::stop_source stop;

    RunContext run{.threads = forked() ? 1 : how.threads, .stop = stop.get_token()};
    run.progress = [&](double share) { done = share; };
    run.warn = [&](const std::string& sentence) {
        const std::lock_guard lock(mutex);
        notes.push_back(sentence);
    };
    run.max_memory =
        how.max_memory > 0 ? static_cast<std::uint64_t>(how.max_memory) : default_memory_limit();

    HiredWorker worker;
    worker->begin([&] {
        try {
            result.emplace(work(std::as_const(run)));
        } catch (...) {
            error = std::current_exception();
        }
    });
    const auto done_soon = [&] {
        const py::gil_scoped_release free;
        return worker->done_within(std::chrono::milliseconds(50));
    };
    std::exception_ptr problem;  // Ctrl-C, or an exception from the progress function
    while (!done_soon()) {
        if (problem) continue;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (!how.progress.is_none()) how.progress(done.load());
        } catch (...) {
            problem = std::current_exception();
            stop.request_stop();
        }
    }
    if (problem) std::rethrow_exception(problem);
    if (error) std::rethrow_exception(error);
    if (!how.progress.is_none()) how.progress(1.0);
    show(notes);
    return std::move(*result);
}

}  // namespace stipple::python
