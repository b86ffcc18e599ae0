// SPDX-License-Identifier: MIT
#include "core/rng.hpp"
#include "generators/generator.hpp"

namespace stipple::generators {
namespace {

class Random final : public Sequence {
  public:
    explicit Random(const Plan& plan) : rng_(plan.seed), dimension_(plan.dimension) {}
    void fill(std::uint64_t first, std::span<double> rows) override {
        rng_.fill(first * dimension_, rows);
    }

  private:
    Rng rng_;
    std::uint64_t dimension_;
};

std::unique_ptr<Sequence> make(const Plan& plan, const Values&) {
    return std::make_unique<Random>(plan);
}

}  // namespace

Generator random() {
    return {.name = "random",
            .summary = "Independent uniform random points",
            .source = "Salmon et al. 2011, doi:10.1145/2063384.2063405",
            .traits = {},
            .options = Schema(),
            .sequence = make};
}

}  // namespace stipple::generators
