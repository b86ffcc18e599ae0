// SPDX-License-Identifier: MIT
#include "experiments/designs/goethals_seidel.hpp"

#include <algorithm>
#include <string_view>

#include "experiments/designs/hex_digits.hpp"

namespace stipple::generators {
namespace {

struct Functions {
    std::uint64_t outer;
    std::uint64_t inner;
    /// Bits as hexadecimal digits, the highest first. A bit of 1 is the value 1, a bit of 0 is -1.
    std::array<std::string_view, 4> values;
};

constexpr Functions functions[] = {
    {1, 23, {"48db12", "c57ea2", "1bbdd8", "e9e796"}},
    {3, 13, {"1b64e729e4", "6318db17fa", "586d0086d8", "a0153c98c6"}},
    {1, 43, {"a5f8c936e42", "b02aee75e0c", "b5883a3ee52", "fb7be3b54c6"}},
    {1, 47, {"f2acf353f99e", "0d53f353e482", "0d530cadf99e", "0d53f3521b7c"}},
    {1, 59, {"f4326f7169f3956", "0bcd9f7169facea", "0bcd908e97f3956", "0bcd9f716805314"}},
    {5, 13, {"1b60db27394f25868", "631b18c6d8bfda010", "586ac3680436ce498", "a01500a9e4c639ce0"}},
    {1, 67, {"da2e6fe434a9cf018", "480f71f6cf274755a", "f30d5ca46da888300", "5eff1f4d74a9db08c"}},
    {3,
     27,
     {"c276e42476db8a835ac10", "dc4923b84edc87045a208", "5f294fa7dd2efb09db908",
      "3ee977d41ad60b71248e8"}},
    {3,
     31,
     {"f0a3c50e774b4bba573fcea0", "c45a5a23e1478a1f7b264de8", "6a300c56426cd90bc28f1438",
      "21366c852b9fe75311696888"}},
    {1,
     103,
     {"e2605a55228ef08ebb55a5f9b8", "dc182282d66357e26d7ace165e", "8e89a2978e48061a9fe16d8138",
      "87a5839ec8c4893203ed144470"}},
    {1,
     107,
     {"be9eece91e832e577bc3507b784", "41611316ee832e577b7ca4cf78c", "41611316e17cd1a885c3507b784",
      "41611316ee832e577a835b30872"}},
    {7,
     17,
     {"dc0eee0748fc4dc3b59e6ca051679a", "6e1db70ee478847e2940a530ca5028",
      "a619530c9679b2814dc0ec8f13703a", "6bf5b5fae50294c326e1dee075b876"}},
    {1,
     127,
     {"05666c387cf51e853aa4ef6342b98536", "920814d50775b626406f3f628b781c68",
      "6ce1ec13ece1131fa9a5a957131f57fe", "925d62a33808c91b4f814095b18753de"}},
    {7,
     19,
     {"5c93ab92768db151b62e10873def384218", "a36c546d89724ed1b629ef783def27bde0",
      "1ef783def38421cf7bc5c93ab9275724e8", "61086c210e7bde0f7bca36c4b92768db10"}},
    {1,
     151,
     {"e5d1fc0336b713b7a4b200c55b2d07d2e6b8f0", "44fd7d1d69bd233ad0e7d18be88240d53bf38e",
      "7af098a6bf7db97784aae4c63b6e2657c07848", "60b2910c6f3f2132ad71ca903900d348917654"}},
    {9,
     17,
     {"dc0eee075b877b81d91e22cf365028d7eba6190", "6e1db70ec8fc4dc3bdc0eca0529864b3cd6bf58",
      "a619530ca50294c326bf5ee0764788dc3b23f10", "6bf5b5fae9864d7eb59e6b70ef703a47e291e20"}},
    {1,
     163,
     {"8aa35f6e19534b5ec7267334a04b121e0ba7aa9ee", "04e4f93ffc438adfaa333310b24ad35f08b60b0e6",
      "b170a1a2f8441297a87b889bc962fdd6189047032", "ed4799976797ddf8070afda55beb4f5d1609c988e"}},
};

const Functions* functions_on(std::uint64_t elements) {
    const auto found = std::ranges::find(functions, elements,
                                         [](const Functions& f) { return f.outer * f.inner; });
    return found == std::end(functions) ? nullptr : found;
}

}  // namespace

bool GoethalsSeidel::is_there(std::uint64_t elements) { return functions_on(elements) != nullptr; }

GoethalsSeidel::GoethalsSeidel(std::uint64_t elements) {
    const Functions& of = *functions_on(elements);
    outer_ = of.outer;
    inner_ = of.inner;
    for (std::size_t f = 0; f < 4; ++f)
        for (std::uint64_t x = 0; x < elements; ++x)
            positive_[f].push_back((hex_number(of.values[f].substr(x / 4, 1)) >> (3 - x % 4) & 1) !=
                                   0);
}

std::uint64_t GoethalsSeidel::sum(std::uint64_t x, std::uint64_t y) const {
    return (x / inner_ + y / inner_) % outer_ * inner_ + (x % inner_ + y % inner_) % inner_;
}

std::uint64_t GoethalsSeidel::negative(std::uint64_t x) const {
    return (outer_ - x / inner_) % outer_ * inner_ + (inner_ - x % inner_) % inner_;
}

bool GoethalsSeidel::positive(std::uint64_t row, std::uint64_t column) const {
    const std::uint64_t v = outer_ * inner_;
    const std::uint64_t i = row / v;
    const std::uint64_t k = column / v;
    const std::uint64_t x = row % v;
    const std::uint64_t y = column % v;
    if (i == k) return positive_[0][sum(y, negative(x))];
    if (i == 0) return positive_[k][negative(sum(x, y))];
    if (k == 0) return !positive_[i][negative(sum(x, y))];
    const bool plus = (k + 3 - i) % 3 == 2;
    return positive_[6 - i - k][sum(x, y)] == plus;
}

}  // namespace stipple::generators
