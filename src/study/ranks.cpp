// SPDX-License-Identifier: MIT
#include "study/ranks.hpp"

#ifdef STIPPLE_MPI
#include <mpi.h>

#include <list>
#endif

namespace stipple {

#ifdef STIPPLE_MPI

namespace {

class MpiRanks : public Ranks {
  public:
    MpiRanks() {
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
        for (Letter& letter : letters_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return size_; }
    [[nodiscard]] int on_machine() const override { return on_machine_; }

    void send(int to, std::string bytes) override {
        Letter& letter = letters_.emplace_back();
        letter.bytes = std::move(bytes);
        MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to, 0,
                  MPI_COMM_WORLD, &letter.request);
    }

    std::optional<Message> poll() override {
        std::erase_if(letters_, [](Letter& letter) {
            int sent = 0;
            MPI_Test(&letter.request, &sent, MPI_STATUS_IGNORE);
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

  private:
    /// A message on its way.
    struct Letter {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    int rank_ = 0;
    int size_ = 1;
    int on_machine_ = 1;
    std::list<Letter> letters_;
};

}  // namespace

bool has_mpi() { return true; }

std::unique_ptr<Ranks> join_ranks() { return std::make_unique<MpiRanks>(); }

#else

bool has_mpi() { return false; }

std::unique_ptr<Ranks> join_ranks() { return std::make_unique<Ranks>(); }

#endif

}  // namespace stipple
