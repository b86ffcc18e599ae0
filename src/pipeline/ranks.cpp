// SPDX-License-Identifier: MIT
#include "pipeline/ranks.hpp"

#include <algorithm>

#ifdef STIPPLE_MPI
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <list>
#include <numeric>
#include <thread>
#include <utility>

#include "core/error.hpp"
#endif

namespace stipple {

unsigned threads_of(const Ranks& ranks, const RunContext& run) {
    if (run.threads != 0) return run.threads;
    return std::max(1U, run.thread_count() / static_cast<unsigned>(ranks.on_machine()));
}

#ifdef STIPPLE_MPI

namespace {

class MpiRanks : public Ranks {
  public:
    explicit MpiRanks(std::stop_token stop) : stop_(std::move(stop)) {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Comm machine = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
        MPI_Comm_size(machine, &on_machine_);
        MPI_Comm_free(&machine);
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;
    ~MpiRanks() override {
        if (stop_.stop_requested()) return;
        for (Outgoing& message : outgoing_) MPI_Wait(&message.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return size_; }
    [[nodiscard]] int on_machine() const override { return on_machine_; }

    void send(int to, std::string bytes) override {
        Outgoing& message = outgoing_.emplace_back();
        message.bytes = std::move(bytes);
        MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, to, 0,
                  MPI_COMM_WORLD, &message.request);
    }

    std::optional<Message> poll() override {
        std::erase_if(outgoing_, [](Outgoing& message) {
            int sent = 0;
            MPI_Test(&message.request, &sent, MPI_STATUS_IGNORE);
            return sent != 0;
        });
        int arrived = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &arrived, &status);
        if (arrived == 0) return std::nullopt;
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        Message message{.from = status.MPI_SOURCE,
                        .bytes = std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        return message;
    }

    std::vector<std::string> exchange(std::string mine) override {
        std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_));
        const std::uint64_t own = mine.size();
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Iallgather(&own, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD,
                       &request);
        wait(request);
        const std::uint64_t all = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
        if (all > most_bytes)
            fail(ErrorKind::limit, "the ranks have {} bytes to tell each other; {} are possible",
                 all, most_bytes);
        std::vector<int> counts, places;
        for (const auto size : sizes) {
            places.push_back(counts.empty() ? 0 : places.back() + counts.back());
            counts.push_back(static_cast<int>(size));
        }
        std::string text(all, '\0');
        MPI_Iallgatherv(mine.data(), static_cast<int>(own), MPI_BYTE, text.data(), counts.data(),
                        places.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
        wait(request);
        std::vector<std::string> parts;
        for (std::size_t i = 0; i < sizes.size(); ++i)
            parts.push_back(text.substr(static_cast<std::size_t>(places[i]), sizes[i]));
        return parts;
    }

    void give(int to, const std::string& bytes) override {
        const std::uint64_t size = bytes.size();
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Isend(&size, 1, MPI_UINT64_T, to, data_tag, MPI_COMM_WORLD, &request);
        wait(request);
        for (std::uint64_t at = 0; at < size; at += most_bytes) {
            const auto some = static_cast<int>(std::min(size - at, most_bytes));
            MPI_Isend(bytes.data() + at, some, MPI_BYTE, to, data_tag, MPI_COMM_WORLD, &request);
            wait(request);
        }
    }

    std::string take(int from) override {
        std::uint64_t size = 0;
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Irecv(&size, 1, MPI_UINT64_T, from, data_tag, MPI_COMM_WORLD, &request);
        wait(request);
        std::string bytes(size, '\0');
        for (std::uint64_t at = 0; at < size; at += most_bytes) {
            const auto some = static_cast<int>(std::min(size - at, most_bytes));
            MPI_Irecv(bytes.data() + at, some, MPI_BYTE, from, data_tag, MPI_COMM_WORLD, &request);
            wait(request);
        }
        return bytes;
    }

  private:
    static constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;  // of an int
    static constexpr int data_tag = 1;  // messages of send() have 0

    /// Until it is done; others may need the core that would watch it.
    static void wait(MPI_Request& request) {
        constexpr int eager = 200;  // looks
        int finished = 0;
        for (int looks = 0; finished == 0; ++looks) {
            MPI_Test(&request, &finished, MPI_STATUS_IGNORE);
            if (finished != 0) return;
            if (looks < eager)
                std::this_thread::yield();
            else
                std::this_thread::sleep_for(std::chrono::microseconds(50));
        }
    }

    /// A message on its way.
    struct Outgoing {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    std::stop_token stop_;
    int rank_ = 0;
    int size_ = 1;
    int on_machine_ = 1;
    std::list<Outgoing> outgoing_;
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

std::unique_ptr<Ranks> join_ranks(std::stop_token stop) {
    return std::make_unique<MpiRanks>(std::move(stop));
}

#else

bool has_mpi() { return false; }

std::string mpi_version() { return {}; }

std::unique_ptr<Ranks> join_ranks(std::stop_token) { return std::make_unique<Ranks>(); }

#endif

}  // namespace stipple
