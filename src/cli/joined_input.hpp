// SPDX-License-Identifier: MIT
//
// Several files as one set, one after the other: shards of a set, say. They are opened one by one,
// as their points are needed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/point_stream.hpp"

namespace stipple::cli {

class JoinedInput : public io::PointStream {
  public:
    using Open = std::function<std::unique_ptr<io::PointStream>(const std::string& path)>;

    /// @param paths one at least
    JoinedInput(std::vector<std::string> paths, Open open);

    [[nodiscard]] std::size_t dimension() const override { return dimension_; }
    bool next_set() override { return !std::exchange(begun_, true); }
    [[nodiscard]] std::optional<std::size_t> sets() const override { return 1; }

    /// That of the first file, less what is not of the whole.
    [[nodiscard]] const Provenance& provenance() const override { return provenance_; }

    /// @throws Error(input): a file has points of another dimension, or on another domain
    std::size_t read(std::span<double> rows) override;

  private:
    bool open_next();

    std::vector<std::string> paths_;
    Open open_;
    std::size_t opened_ = 0;
    std::unique_ptr<io::PointStream> stream_;
    std::size_t dimension_ = 0;
    Provenance provenance_;
    bool begun_ = false;
    bool ended_ = false;  ///< a stream may be asked once more after its end
};

}  // namespace stipple::cli
