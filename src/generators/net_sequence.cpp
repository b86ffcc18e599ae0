// SPDX-License-Identifier: MIT
#include "generators/net_sequence.hpp"

namespace stipple {
namespace {

class BaseNetSequence final : public Sequence {
  public:
    explicit BaseNetSequence(BaseNet net) : net_(std::move(net)) {}
    void fill(std::uint64_t first, std::span<double> rows) override { net_.fill(first, rows); }

  private:
    BaseNet net_;
};

}  // namespace

std::unique_ptr<Sequence> net_sequence(std::uint32_t base,
                                       const std::vector<DigitMatrix>& matrices) {
    BaseNet net(base, matrices.front().rows, matrices.front().columns);
    for (const DigitMatrix& matrix : matrices) net.append(matrix);
    return std::make_unique<BaseNetSequence>(std::move(net));
}

}  // namespace stipple
