// SPDX-License-Identifier: MIT
//
// Ranks as threads of the test process: tests collective work without a launcher.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pipeline/ranks.hpp"

namespace stipple::testing {

/// Messages between the ranks.
class Hall {
  public:
    explicit Hall(int size) : said_(static_cast<std::size_t>(size)) {}

    [[nodiscard]] int size() const { return static_cast<int>(said_.size()); }

    std::vector<std::string> exchange(int rank, std::string mine) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return leaving_ == 0; });
        said_[static_cast<std::size_t>(rank)] = std::move(mine);
        if (++arrived_ == size()) {
            leaving_ = std::exchange(arrived_, 0);
            changed_.notify_all();
        } else {
            changed_.wait(lock, [this] { return leaving_ > 0; });
        }
        auto all = said_;
        if (--leaving_ == 0) changed_.notify_all();
        return all;
    }

    void give(int from, int to, const std::string& bytes) {
        const std::lock_guard lock(mutex_);
        parcels_[{from, to}].push_back(bytes);
        changed_.notify_all();
    }

    std::string take(int from, int to) {
        std::unique_lock lock(mutex_);
        auto& parcels = parcels_[{from, to}];
        changed_.wait(lock, [&] { return !parcels.empty(); });
        std::string bytes = std::move(parcels.front());
        parcels.pop_front();
        return bytes;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> said_;
    int arrived_ = 0;
    int leaving_ = 0;
    std::map<std::pair<int, int>, std::deque<std::string>> parcels_;
};

class ThreadRank final : public Ranks {
  public:
    ThreadRank(Hall& hall, int rank) : hall_(hall), rank_(rank) {}

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return hall_.size(); }
    [[nodiscard]] int on_machine() const override { return hall_.size(); }
    std::vector<std::string> exchange(std::string mine) override {
        return hall_.exchange(rank_, std::move(mine));
    }
    void give(int to, const std::string& bytes) override { hall_.give(rank_, to, bytes); }
    std::string take(int from) override { return hall_.take(from, rank_); }

  private:
    Hall& hall_;
    int rank_;
};

/// Runs the work of all ranks, each on its own thread.
inline void with_ranks(int size, const std::function<void(Ranks&)>& work) {
    Hall hall(size);
    std::vector<std::jthread> crew;
    for (int rank = 0; rank < size; ++rank)
        crew.emplace_back([&hall, &work, rank] {
            ThreadRank mine(hall, rank);
            work(mine);
        });
}

}  // namespace stipple::testing
