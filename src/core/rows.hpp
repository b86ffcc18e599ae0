// SPDX-License-Identifier: MIT
//
// Room for the numbers of a point set: a vector that is there already, or fresh memory that is to
// be written. Large fresh rooms ask for large pages, where the system has them: the first touch of
// every page costs as much as making some thousand coordinates, and with pages of 4 KiB that, and
// filling them with zeros first, was most of the time that a large set took.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace stipple {

class Rows {
  public:
    Rows() = default;

    /// Takes the numbers.
    explicit Rows(std::vector<double> numbers) : given_(std::move(numbers)), view_(given_) {}

    /// Room for numbers, which must be written before they are read.
    static Rows unwritten(std::size_t count);

    Rows(const Rows& other) : Rows(std::vector<double>(other.view_.begin(), other.view_.end())) {}
    Rows(Rows&& other) noexcept
        : given_(std::move(other.given_)),
          fresh_(std::move(other.fresh_)),
          view_(std::exchange(other.view_, {})) {}
    Rows& operator=(Rows other) noexcept {
        given_.swap(other.given_);
        fresh_.swap(other.fresh_);
        std::swap(view_, other.view_);
        return *this;
    }
    ~Rows() = default;

    [[nodiscard]] std::span<double> numbers() { return view_; }
    [[nodiscard]] std::span<const double> numbers() const { return view_; }

  private:
    std::vector<double> given_;
    std::unique_ptr<double[]> fresh_;
    std::span<double> view_;  ///< of the one that is used
};

}  // namespace stipple
