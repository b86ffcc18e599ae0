// SPDX-License-Identifier: MIT
#include "pipeline/ranks.hpp"

#include <algorithm>

#ifdef STIPPLE_MPI
#include <mpi.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <list>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "core/bytes/packed.hpp"
#include "core/error.hpp"
#endif

namespace stipple {

unsigned threads_of(const Ranks& ranks, const RunContext& run) {
    if (run.threads != 0) return run.threads;
    return std::max(1U, run.thread_count() / static_cast<unsigned>(ranks.on_machine()));
}

#ifdef STIPPLE_MPI

namespace {

using namespace std::chrono_literals;

// One thread watches for failures of other ranks, while other threads wait or compute. The mutex
// mpi_ keeps two threads from calling MPI at the same time.
class MpiRanks : public Ranks {
  public:
    MpiRanks(std::stop_token stop, std::function<void()> request_stop)
        : stop_(std::move(stop)), request_stop_(std::move(request_stop)) {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Comm machine = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
        MPI_Comm_size(machine, &on_machine_);
        MPI_Comm_free(&machine);
        std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
        int length = 0;
        MPI_Get_processor_name(name.data(), &length);
        host_.assign(name.data(), static_cast<std::size_t>(length));
        if (size_ > 1)
            watcher_ = std::jthread([this](const std::stop_token& done) { watch(done); });
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;
    ~MpiRanks() override {
        watcher_ = {};
        if (stop_.stop_requested() && !failed_) return;
        if (!failed_)
            for (Outgoing& message : outgoing_) MPI_Wait(&message.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return size_; }
    [[nodiscard]] int on_machine() const override { return on_machine_; }
    [[nodiscard]] std::string host() const override { return host_; }

    void end_together() override { failed_ = true; }

    void send(int to, std::string bytes) override {
        const std::lock_guard lock(mpi_);
        send(to, std::move(bytes), message_tag);
    }

    Error fail_together(const Error& error) override {
        const std::lock_guard lock(mpi_);
        if (failed_) return error;
        hear_failure();
        if (!heard_ && error.kind() == ErrorKind::cancelled) return error;  // all are cancelled
        failed_ = true;
        if (heard_) return *heard_;
        const Error told(error.kind(), fmt::format("rank {} on {}: {}", rank_, host_, error.what()),
                         error.hint());
        for (int other = 0; other < size_; ++other)
            if (other != rank_) send(other, packed(told), failure_tag);
        return rank_ == 0 ? error : told;
    }

    std::optional<Message> poll() override {
        const std::lock_guard lock(mpi_);
        throw_heard();
        std::erase_if(outgoing_, [](Outgoing& message) {
            int sent = 0;
            MPI_Test(&message.request, &sent, MPI_STATUS_IGNORE);
            return sent != 0;
        });
        int arrived = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, message_tag, MPI_COMM_WORLD, &arrived, &status);
        if (arrived == 0) return std::nullopt;
        return received(status);
    }

    std::vector<std::string> exchange(std::string mine) override {
        said_ = std::move(mine);
        sizes_.resize(static_cast<std::size_t>(size_));
        const std::uint64_t own = said_.size();
        complete([&](MPI_Request* request) {
            MPI_Iallgather(&own, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD,
                           request);
        });
        const std::uint64_t all = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
        if (all > most_bytes)
            fail(ErrorKind::limit, "the ranks would exchange {} bytes; at most {} are possible",
                 all, most_bytes);
        counts_.clear();
        places_.clear();
        for (const auto size : sizes_) {
            places_.push_back(counts_.empty() ? 0 : places_.back() + counts_.back());
            counts_.push_back(static_cast<int>(size));
        }
        all_said_.resize(all);
        complete([&](MPI_Request* request) {
            MPI_Iallgatherv(said_.data(), static_cast<int>(own), MPI_BYTE, all_said_.data(),
                            counts_.data(), places_.data(), MPI_BYTE, MPI_COMM_WORLD, request);
        });
        std::vector<std::string> parts;
        for (std::size_t i = 0; i < sizes_.size(); ++i)
            parts.push_back(all_said_.substr(static_cast<std::size_t>(places_[i]), sizes_[i]));
        return parts;
    }

    void give(int to, const std::string& bytes) override {
        const std::uint64_t size = bytes.size();
        complete([&](MPI_Request* request) {
            MPI_Isend(&size, 1, MPI_UINT64_T, to, data_tag, MPI_COMM_WORLD, request);
        });
        for (std::uint64_t at = 0; at < size; at += most_bytes)
            complete([&](MPI_Request* request) {
                const auto some = static_cast<int>(std::min(size - at, most_bytes));
                MPI_Isend(bytes.data() + at, some, MPI_BYTE, to, data_tag, MPI_COMM_WORLD, request);
            });
    }

    std::string take(int from) override {
        std::uint64_t size = 0;
        complete([&](MPI_Request* request) {
            MPI_Irecv(&size, 1, MPI_UINT64_T, from, data_tag, MPI_COMM_WORLD, request);
        });
        std::string bytes(size, '\0');
        for (std::uint64_t at = 0; at < size; at += most_bytes)
            complete([&](MPI_Request* request) {
                const auto some = static_cast<int>(std::min(size - at, most_bytes));
                MPI_Irecv(bytes.data() + at, some, MPI_BYTE, from, data_tag, MPI_COMM_WORLD,
                          request);
            });
        return bytes;
    }

  private:
    static constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;  // MPI counts bytes in int
    static constexpr int message_tag = 0;  // tag of messages by send()
    static constexpr int data_tag = 1;     // tag of bytes by give()
    static constexpr int failure_tag = 2;

    /// Starts an MPI operation and waits until it has finished. After many checks, sleeps
    /// between them, since other ranks may need the core.
    /// @throws the Error of another rank that failed, since it may never take part in the operation
    template <class Start>
    void complete(const Start& start) {
        MPI_Request request = MPI_REQUEST_NULL;
        {
            const std::lock_guard lock(mpi_);
            start(&request);
        }
        constexpr int eager = 200;  // checks without sleep
        for (int looks = 0;; ++looks) {
            {
                const std::lock_guard lock(mpi_);
                int finished = 0;
                MPI_Test(&request, &finished, MPI_STATUS_IGNORE);
                if (finished != 0) return;
                throw_heard();
            }
            if (looks < eager)
                std::this_thread::yield();
            else
                std::this_thread::sleep_for(50us);
        }
    }

    /// Receives the message that a probe has found.
    static Message received(const MPI_Status& found) {
        int size = 0;
        MPI_Get_count(&found, MPI_BYTE, &size);
        Message message{.from = found.MPI_SOURCE,
                        .bytes = std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Recv(message.bytes.data(), size, MPI_BYTE, found.MPI_SOURCE, found.MPI_TAG,
                 MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        return message;
    }

    void send(int to, std::string bytes, int tag) {
        Outgoing& message = outgoing_.emplace_back();
        message.bytes = std::move(bytes);
        MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, to, tag,
                  MPI_COMM_WORLD, &message.request);
    }

    /// Receives the error of another rank, if one has failed.
    void hear_failure() {
        int arrived = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, failure_tag, MPI_COMM_WORLD, &arrived, &status);
        if (arrived == 0 || heard_) return;
        heard_.emplace(unpacked_error(received(status).bytes));
    }

    void throw_heard() const {
        if (heard_) throw Error(*heard_);
    }

    void watch(const std::stop_token& done) {
        while (!done.stop_requested()) {
            std::this_thread::sleep_for(20ms);
            const std::lock_guard lock(mpi_);
            hear_failure();
            if (!heard_) continue;
            request_stop_();
            return;
        }
    }

    /// A message that MPI may still be sending.
    struct Outgoing {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    std::stop_token stop_;
    std::function<void()> request_stop_;
    int rank_ = 0;
    int size_ = 1;
    int on_machine_ = 1;
    std::string host_;
    std::mutex mpi_;              ///< held during each MPI call
    std::optional<Error> heard_;  ///< error that ended another rank
    bool failed_ = false;         ///< all ranks know the error, and end
    std::list<Outgoing> outgoing_;
    // Buffers of exchange(), members because MPI may use them even after an error has ended the
    // call.
    std::string said_, all_said_;
    std::vector<std::uint64_t> sizes_;
    std::vector<int> counts_, places_;
    std::jthread watcher_;
};

}  // namespace

bool has_mpi() { return true; }

std::string mpi_version() {
    std::string text(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
    int size = 0;
    MPI_Get_library_version(text.data(), &size);
    text.resize(static_cast<std::size_t>(size));
    return text.substr(0, text.find_first_of(",\n"));
}

std::unique_ptr<Ranks> join_ranks(std::stop_token stop, std::function<void()> request_stop) {
    return std::make_unique<MpiRanks>(std::move(stop), std::move(request_stop));
}

#else

bool has_mpi() { return false; }

std::string mpi_version() { return {}; }

std::unique_ptr<Ranks> join_ranks(std::stop_token, std::function<void()>) {
    return std::make_unique<Ranks>();
}

#endif

}  // namespace stipple
