// SPDX-License-Identifier: MIT
#include "study/study_run.hpp"

#include <tbb/concurrent_queue.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "core/bytes/packed.hpp"
#include "core/error.hpp"
#include "study/work_queue.hpp"

namespace stipple {
namespace {

using Work = std::vector<UnitRange>;

// Kinds of messages: their first byte.
constexpr char ask_message = 'A';   // a thread asks for work
constexpr char work_message = 'W';  // answer: a piece of work; empty if there is no more
constexpr char done_message = 'D';  // results of a piece
constexpr char bye_message = 'B';   // the sender has finished
constexpr char halt_message = 'H';  // the receiver is to stop at once

constexpr auto short_pause = std::chrono::milliseconds(1);

std::string packed(const Work& ranges) { return Packer().put(work_message).put_all(ranges).take(); }

std::string packed(const Work& ranges, const WorkDone& done, const std::string& error) {
    Packer to;
    to.put(done_message).put_all(error).put_all(ranges).put_all(done.too_large).put(done.seconds);
    for (const Segment& segment : done.segments) {
        to.put(segment.units);
        for (const UnitResult& r : segment.results) {
            to.put(r.numbers.size()).put_all(r.domain).put(r.points).put(r.generate_seconds);
            to.put(r.seconds).put_all(r.failure);
            for (const auto& [key, value] : r.numbers) to.put_all(key).put(value);
        }
    }
    return to.take();
}

UnitResult unpacked_result(Unpacker& from) {
    UnitResult r;
    r.numbers.resize(from.take<std::size_t>());
    r.domain = from.take_text();
    r.points = from.take<std::optional<std::uint64_t>>();
    r.generate_seconds = from.take<double>();
    r.seconds = from.take<double>();
    r.failure = from.take_text();
    for (auto& [key, value] : r.numbers) {
        key = from.take_text();
        value = from.take<double>();
    }
    return r;
}

WorkDone unpacked(Unpacker& from) {
    WorkDone done{.too_large = from.take_all<UnitRange>(), .seconds = from.take<double>()};
    while (!from.empty()) {
        Segment segment{.units = from.take<UnitRange>()};
        for (auto unit = segment.units.first; unit < segment.units.last; ++unit)
            segment.results.push_back(unpacked_result(from));
        done.segments.push_back(std::move(segment));
    }
    return done;
}

/// A copy of the context for one of several workers, which share the memory.
RunContext share_of(const RunContext& run, std::uint64_t workers, unsigned threads) {
    RunContext share = run;
    share.max_memory = run.max_memory / workers;
    share.memory_in_use = {};  // depends on other workers, rows must not
    share.threads = threads;
    return share;
}

void halt_others(Ranks& ranks) {
    for (int other = 1; other < ranks.size(); ++other) ranks.send(other, {halt_message});
}

/// Rank 0: hands out work and takes results.
class Leader {
  public:
    Leader(const UnitRunner& runner, StudyFile& file, Ranks& ranks, const RunContext& run)
        : runner_(runner),
          file_(file),
          ranks_(ranks),
          run_(run),
          threads_(threads_of(ranks, run)),
          workers_(threads_ * static_cast<std::size_t>(ranks.size())),
          queue_(runner.sweep(), file.done(), workers_),
          started_(run.seconds ? run.seconds() : 0) {}

    bool go() {
        std::vector<std::jthread> threads;
        busy_ = threads_;
        for (unsigned i = 0; i < threads_; ++i) threads.emplace_back([this] { work_on(); });
        int others = ranks_.size() - 1;
        while (busy_ > 0 || others > 0) {
            if (halted_ && !std::exchange(told_, true)) halt_others(ranks_);
            if (!serve(others)) wait_a_little();
            keep_safe();
            show_progress();
        }
        threads.clear();
        if (error_) std::rethrow_exception(error_);
        if (alive_) run_large();
        run_.check_stop();
        const std::uint64_t units = runner_.sweep().units();
        if (alive_ && file_.units_written() != units)
            fail(ErrorKind::io, "internal error: {} of {} parts of the study are missing",
                 units - file_.units_written(), units);
        return alive_;
    }

  private:
    std::optional<Work> next() {
        const std::lock_guard lock(mutex_);
        if (halted_ || run_.stop.stop_requested()) return std::nullopt;
        auto ranges = queue_.pull();
        if (ranges) ++running_;
        return ranges;
    }

    /// Threads per piece of work: 1, or more if a single process has more threads than pieces left.
    unsigned inner_threads() {
        const std::lock_guard lock(mutex_);
        if (ranks_.size() > 1) return 1;
        const std::uint64_t pieces = std::max<std::uint64_t>(1, queue_.pieces_left() + running_);
        return static_cast<unsigned>(std::max<std::uint64_t>(1, threads_ / pieces));
    }

    void work_on() {
        const std::uint64_t workers = threads_ * static_cast<std::uint64_t>(ranks_.on_machine());
        try {
            while (const auto ranges = next()) {
                RunContext share = share_of(run_, workers, inner_threads());
                share.stop = stop_.get_token();
                take(*ranges, runner_.run(*ranges, share));
            }
        } catch (...) {
            give_up(std::current_exception());
        }
        --busy_;
    }

    void take(const Work& ranges, const WorkDone& result) {
        bool alive = true;
        for (const Segment& segment : result.segments) alive = alive && file_.put(segment);
        const std::lock_guard lock(mutex_);
        --running_;
        queue_.finish(ranges, result.seconds);
        too_large_.insert(too_large_.end(), result.too_large.begin(), result.too_large.end());
        alive_ = alive_ && alive;
        if (!alive_) stop_all();
    }

    void give_up(std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        stop_for(std::move(error));
    }

    void stop_for(std::exception_ptr error) {
        if (!error_ && !halted_) error_ = std::move(error);
        stop_all();
    }

    void stop_all() {
        halted_ = true;
        stop_.request_stop();
    }

    /// Handles one message from another rank. Returns false if there is none.
    bool serve(int& others) {
        const auto message = ranks_.poll();
        if (!message) return false;
        if (message->bytes[0] == bye_message) --others;
        if (message->bytes[0] == ask_message) {
            ranks_.send(message->from, packed(next().value_or(Work())));
        }
        if (message->bytes[0] != done_message) return true;
        try {
            Unpacker from(std::string_view(message->bytes).substr(1));
            if (const auto error = from.take_text(); !error.empty())
                fail(ErrorKind::io, "rank {}: {}", message->from, error);
            const auto ranges = from.take_all<UnitRange>();
            take(ranges, unpacked(from));
        } catch (...) {
            give_up(std::current_exception());
        }
        return true;
    }

    void wait_a_little() {
        // Pauses are shorter if there are other ranks, since these wait for answers.
        std::this_thread::sleep_for(ranks_.size() > 1 ? short_pause : 5 * short_pause);
        if (run_.stop.stop_requested()) {
            const std::lock_guard lock(mutex_);
            stop_all();
        }
    }

    /// Flushes rows to the disk every second, so that a power cut loses at most those of the last
    /// second.
    void keep_safe() {
        constexpr double apart = 1;  // seconds between syncs
        if (!run_.seconds || run_.seconds() < synced_ + apart) return;
        synced_ = run_.seconds();
        file_.sync();
    }

    void show_progress() {
        constexpr double apart = 0.1;  // seconds between updates
        if (!run_.progress || !run_.seconds || run_.seconds() < shown_ + apart) return;
        shown_ = run_.seconds();
        const std::lock_guard lock(mutex_);
        const double spent = shown_ - started_;
        const double left = queue_.seconds_left() / static_cast<double>(workers_);
        if (spent > 0) run_.progress(std::min(0.999, spent / (spent + left)));
    }

    /// Runs the units that need more memory than a worker has, one after the other.
    void run_large() {
        RunContext alone = share_of(run_, 1, threads_of(ranks_, run_));
        for (const UnitRange& range : too_large_)
            for (const Segment& segment : runner_.run({range}, alone).segments)
                if (alive_) alive_ = file_.put(segment);
    }

    const UnitRunner& runner_;
    StudyFile& file_;
    Ranks& ranks_;
    const RunContext& run_;
    unsigned threads_;
    std::size_t workers_;
    std::mutex mutex_;  // guards the members down to halted_
    WorkQueue queue_;
    Work too_large_;
    std::uint64_t running_ = 0;
    std::exception_ptr error_;
    bool alive_ = true;
    std::atomic<bool> halted_ = false;
    bool told_ = false;
    std::atomic<unsigned> busy_ = 0;
    std::stop_source stop_;
    double started_;
    double synced_ = 0;  ///< time of the last sync
    double shown_ = 0;   ///< time of the last progress
};

/// Any other rank: threads that work, and the thread that exchanges messages with rank 0.
class Worker {
  public:
    Worker(const UnitRunner& runner, Ranks& ranks, const RunContext& run)
        : runner_(runner), ranks_(ranks), run_(run), threads_(threads_of(ranks, run)) {}

    void go() {
        std::vector<std::jthread> threads;
        for (unsigned i = 0; i < threads_; ++i) threads.emplace_back([this] { work_on(); });
        for (unsigned i = 0; i < threads_; ++i) ranks_.send(0, {ask_message});
        while (open_ > 0 || !outbox_.empty()) {
            if (run_.stop.stop_requested()) stop_.request_stop();
            const bool heard = listen();
            if (!post() && !heard) std::this_thread::sleep_for(short_pause);
        }
        threads.clear();
        ranks_.send(0, {bye_message});
        run_.check_stop();
    }

  private:
    bool listen() {
        const auto message = ranks_.poll();
        if (!message) return false;
        if (message->bytes[0] == halt_message) stop_.request_stop();
        if (message->bytes[0] == work_message)
            inbox_.push(Unpacker(std::string_view(message->bytes).substr(1)).take_all<UnitRange>());
        return true;
    }

    /// Sends waiting results to rank 0, each with a request for work; returns whether any waited.
    bool post() {
        bool any = false;
        for (std::string message; outbox_.try_pop(message); any = true) {
            ranks_.send(0, std::move(message));
            ranks_.send(0, {ask_message});
        }
        return any;
    }

    /// Works until it gets an empty piece.
    void work_on() {
        const std::uint64_t workers = threads_ * static_cast<std::uint64_t>(ranks_.on_machine());
        RunContext share = share_of(run_, workers, 1);
        share.stop = stop_.get_token();
        Work ranges;
        for (inbox_.pop(ranges); !ranges.empty(); inbox_.pop(ranges)) {
            WorkDone result;
            std::string error;
            try {
                result = runner_.run(ranges, share);
            } catch (const std::exception& e) {  // usually a cancellation
                error = e.what();
            }
            outbox_.push(packed(ranges, result, error));
        }
        --open_;
    }

    const UnitRunner& runner_;
    Ranks& ranks_;
    const RunContext& run_;
    unsigned threads_;
    tbb::concurrent_bounded_queue<Work> inbox_;
    tbb::concurrent_queue<std::string> outbox_;
    std::atomic<unsigned> open_ = threads_;
    std::stop_source stop_;
};

}  // namespace

bool run_study(const UnitRunner& runner, StudyFile& file, Ranks& ranks, const RunContext& run) {
    return Leader(runner, file, ranks, run).go();
}

void work_for_study(const UnitRunner& runner, Ranks& ranks, const RunContext& run) {
    Worker(runner, ranks, run).go();
}

void dismiss(Ranks& ranks) {
    halt_others(ranks);
    for (int others = ranks.size() - 1; others > 0;) {
        const auto message = ranks.poll();
        if (!message) {
            std::this_thread::sleep_for(short_pause);
            continue;
        }
        if (message->bytes[0] == ask_message) ranks.send(message->from, packed(Work()));
        if (message->bytes[0] == bye_message) --others;
    }
}

}  // namespace stipple
