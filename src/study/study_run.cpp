// SPDX-License-Identifier: MIT
#include "study/study_run.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.hpp"
#include "core/json.hpp"
#include "study/work_cost.hpp"
#include "study/work_queue.hpp"

namespace stipple {
namespace {

using Work = std::vector<UnitRange>;

// The first byte of a message says what it is.
constexpr char ask_message = 'A';      // give me work
constexpr char work_message = 'W';     // here it is
constexpr char nothing_message = 'N';  // there is none
constexpr char done_message = 'D';     // what became of it
constexpr char bye_message = 'B';      // I have finished
constexpr char halt_message = 'H';     // stop at once

constexpr auto short_pause = std::chrono::milliseconds(1);

std::string packed(char kind, const Json& content) {
    std::string bytes(1, kind);
    Json::to_cbor(content, nlohmann::detail::output_adapter<char>(bytes));
    return bytes;
}

Json unpacked(const Message& message) {
    return Json::from_cbor(message.bytes.begin() + 1, message.bytes.end());
}

Json json_of(const Work& ranges) {
    Json list = Json::array();
    for (const auto& [first, last] : ranges) list.push_back({first, last});
    return list;
}

Work ranges_from(const Json& list) {
    Work ranges;
    for (const Json& range : list)
        ranges.push_back({range[0].get<std::uint64_t>(), range[1].get<std::uint64_t>()});
    return ranges;
}

Json json_of(const Work& ranges, const WorkDone& result, const std::string& error) {
    Json segments = Json::array();
    for (const Segment& segment : result.segments)
        segments.push_back({segment.units.first, segment.units.last, segment.lines});
    return {{"ranges", json_of(ranges)},
            {"segments", segments},
            {"hungry", json_of(result.hungry)},
            {"seconds", result.seconds},
            {"error", error}};
}

WorkDone result_from(const Json& json) {
    WorkDone result;
    for (const Json& segment : json["segments"])
        result.segments.push_back(
            {{segment[0].get<std::uint64_t>(), segment[1].get<std::uint64_t>()},
             segment[2].get<std::vector<std::string>>()});
    result.hungry = ranges_from(json["hungry"]);
    result.seconds = json["seconds"].get<std::vector<double>>();
    return result;
}

/// A run with the share of memory and threads that one of several workers has.
RunContext share_of(const RunContext& run, std::uint64_t workers, unsigned threads) {
    RunContext share = run;
    share.max_memory = run.max_memory / workers;
    share.threads = threads;
    share.progress = {};
    share.warn = {};
    return share;
}

/// Rank 0: the work that there is, and what came back of it.
class Office {
  public:
    Office(const Sweep& sweep, const StudyTable& table, StudyFile& file, Ranks& ranks,
           const RunContext& run)
        : file_(file),
          ranks_(ranks),
          run_(run),
          threads_(threads_of(ranks, run)),
          hands_(threads_ * static_cast<std::size_t>(ranks.size())),
          runner_(sweep, table, run.max_memory),
          queue_(sweep, file.done(), hands_),
          left_(sweep),
          units_(sweep.units()),
          started_(run.seconds ? run.seconds() : 0) {
        left_.forget(file.done().ranges());
    }

    bool go() {
        std::vector<std::jthread> crew;
        busy_ = threads_;
        for (unsigned i = 0; i < threads_; ++i) crew.emplace_back([this] { work_on(); });
        int others = ranks_.size() - 1;
        while (busy_ > 0 || others > 0) {
            if (halted_ && !told_) tell_others_to_halt();
            if (!serve(others)) wait_a_little();
            keep_safe();
            show_progress();
        }
        crew.clear();
        if (error_) std::rethrow_exception(error_);
        if (alive_) feed_the_hungry();
        run_.check_stop();
        if (alive_ && file_.units_written() != units_)
            fail(ErrorKind::io, "internal error: {} of {} parts of the study are missing",
                 units_ - file_.units_written(), units_);
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

    /// Threads inside a piece: one, unless there are fewer pieces than threads.
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
        const std::lock_guard lock(mutex_);
        --running_;
        left_.finish(ranges, result.seconds);
        hungry_.insert(hungry_.end(), result.hungry.begin(), result.hungry.end());
        for (const Segment& segment : result.segments) alive_ = alive_ && file_.put(segment);
        if (!alive_) stop_all();
    }

    void give_up(std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        if (!error_ && !halted_) error_ = std::move(error);
        stop_all();
    }

    void stop_all() {
        halted_ = true;
        stop_.request_stop();
    }

    void tell_others_to_halt() {
        told_ = true;
        for (int other = 1; other < ranks_.size(); ++other) ranks_.send(other, {halt_message});
    }

    /// Answers the others. False: nobody said anything.
    bool serve(int& others) {
        const auto message = ranks_.poll();
        if (!message) return false;
        if (message->bytes[0] == bye_message) --others;
        if (message->bytes[0] == ask_message) {
            const auto ranges = next();
            ranks_.send(message->from, ranges ? packed(work_message, json_of(*ranges))
                                              : std::string(1, nothing_message));
        }
        if (message->bytes[0] != done_message) return true;
        try {
            const Json json = unpacked(*message);
            if (const auto error = json["error"].get<std::string>(); !error.empty())
                fail(ErrorKind::io, "rank {}: {}", message->from, error);
            take(ranges_from(json["ranges"]), result_from(json));
        } catch (...) {
            give_up(std::current_exception());
        }
        return true;
    }

    void wait_a_little() {
        // A worker waits for an answer, so that where there are others the pause is short.
        std::this_thread::sleep_for(ranks_.size() > 1 ? short_pause : 5 * short_pause);
        if (run_.stop.stop_requested()) {
            const std::lock_guard lock(mutex_);
            stop_all();
        }
    }

    /// A power cut loses a second's rows at most.
    void keep_safe() {
        constexpr double apart = 1;  // second
        if (!run_.seconds || run_.seconds() < synced_ + apart) return;
        synced_ = run_.seconds();
        file_.sync();
    }

    void show_progress() {
        if (!run_.progress || !run_.seconds) return;
        const std::lock_guard lock(mutex_);
        const double spent = run_.seconds() - started_;
        const double left = left_.seconds() / static_cast<double>(hands_);
        if (spent > 0) run_.progress(std::min(0.999, spent / (spent + left)));
    }

    /// What needs more memory than a share is done alone, one after the other.
    void feed_the_hungry() {
        RunContext alone = share_of(run_, 1, threads_of(ranks_, run_));
        for (const UnitRange& range : hungry_)
            for (const Segment& segment : runner_.run({range}, alone).segments)
                if (alive_) alive_ = file_.put(segment);
    }

    StudyFile& file_;
    Ranks& ranks_;
    const RunContext& run_;
    unsigned threads_;
    std::size_t hands_;
    UnitRunner runner_;
    std::mutex mutex_;  // of all below
    WorkQueue queue_;
    WorkLeft left_;
    Work hungry_;
    std::uint64_t running_ = 0;
    std::exception_ptr error_;
    bool alive_ = true;
    std::atomic<bool> halted_ = false;
    bool told_ = false;
    std::atomic<unsigned> busy_ = 0;
    std::stop_source stop_;
    std::uint64_t units_;
    double started_;
    double synced_ = 0;  ///< when rows were put on the disk last
};

/// Another rank: threads that work, and one that speaks with rank 0.
class Workshop {
  public:
    Workshop(const Sweep& sweep, const StudyTable& table, Ranks& ranks, const RunContext& run)
        : ranks_(ranks),
          run_(run),
          threads_(threads_of(ranks, run)),
          runner_(sweep, table, run.max_memory) {}

    void go() {
        std::vector<std::jthread> crew;
        for (unsigned i = 0; i < threads_; ++i) crew.emplace_back([this] { work_on(); });
        for (unsigned i = 0; i < threads_; ++i) ranks_.send(0, {ask_message});
        while (open_ > 0 || !outbox_empty()) {
            if (run_.stop.stop_requested()) stop_.request_stop();
            const bool heard = listen();
            if (!post() && !heard) std::this_thread::sleep_for(short_pause);
        }
        crew.clear();
        ranks_.send(0, {bye_message});
        run_.check_stop();
    }

  private:
    bool outbox_empty() {
        const std::lock_guard lock(mutex_);
        return outbox_.empty();
    }

    bool listen() {
        const auto message = ranks_.poll();
        if (!message) return false;
        if (message->bytes[0] == halt_message) stop_.request_stop();
        if (message->bytes[0] == work_message) put(ranges_from(unpacked(*message)));
        if (message->bytes[0] == nothing_message) put({});
        return true;
    }

    void put(Work ranges) {
        {
            const std::lock_guard lock(mutex_);
            inbox_.push_back(std::move(ranges));
        }
        came_.notify_one();
    }

    /// Sends what was done, and asks for as much again.
    bool post() {
        std::deque<std::string> letters;
        {
            const std::lock_guard lock(mutex_);
            letters.swap(outbox_);
        }
        for (auto& letter : letters) {
            ranks_.send(0, std::move(letter));
            ranks_.send(0, {ask_message});
        }
        return !letters.empty();
    }

    Work wait_for_work() {
        std::unique_lock lock(mutex_);
        came_.wait(lock, [this] { return !inbox_.empty(); });
        Work ranges = std::move(inbox_.front());
        inbox_.pop_front();
        return ranges;
    }

    /// Until there is none: an empty piece.
    void work_on() {
        const std::uint64_t workers = threads_ * static_cast<std::uint64_t>(ranks_.on_machine());
        RunContext share = share_of(run_, workers, 1);
        share.stop = stop_.get_token();
        for (Work ranges = wait_for_work(); !ranges.empty(); ranges = wait_for_work()) {
            WorkDone result;
            std::string error;
            try {
                result = runner_.run(ranges, share);
            } catch (const std::exception& e) {  // told to stop, as a rule
                error = e.what();
            }
            const std::lock_guard lock(mutex_);
            outbox_.push_back(packed(done_message, json_of(ranges, result, error)));
        }
        --open_;
    }

    Ranks& ranks_;
    const RunContext& run_;
    unsigned threads_;
    UnitRunner runner_;
    std::mutex mutex_;  // of the boxes
    std::condition_variable came_;
    std::deque<Work> inbox_;
    std::deque<std::string> outbox_;
    std::atomic<unsigned> open_ = threads_;
    std::stop_source stop_;
};

}  // namespace

bool run_study(const Sweep& sweep, const StudyTable& table, StudyFile& file, Ranks& ranks,
               const RunContext& run) {
    return Office(sweep, table, file, ranks, run).go();
}

void work_for_study(const Sweep& sweep, const StudyTable& table, Ranks& ranks,
                    const RunContext& run) {
    Workshop(sweep, table, ranks, run).go();
}

void dismiss(Ranks& ranks) {
    for (int other = 1; other < ranks.size(); ++other) ranks.send(other, {halt_message});
    for (int others = ranks.size() - 1; others > 0;) {
        const auto message = ranks.poll();
        if (!message) {
            std::this_thread::sleep_for(short_pause);
            continue;
        }
        if (message->bytes[0] == ask_message) ranks.send(message->from, {nothing_message});
        if (message->bytes[0] == bye_message) --others;
    }
}

}  // namespace stipple
