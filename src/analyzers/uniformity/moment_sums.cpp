// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/moment_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers {
namespace {

constexpr std::size_t powers = 6;
constexpr std::size_t products = 4;

}  // namespace

MomentSums::MomentSums(std::vector<double> about, std::uint64_t first, std::span<const double> rows)
    : about_(std::move(about)), unit_(about_.size(), 1), next_(first) {
    const std::size_t d = width();
    for (std::size_t k = 0; k < d; ++k) {
        double most = 0;
        for (std::size_t at = k; at < rows.size(); at += d)
            most = std::max(most, std::abs(rows[at] - about_[k]));
        // Sixth powers of numbers between 2^-128 and 2^128 need no unit.
        const double unit = unit_for(most);
        if (unit < 0x1p-128 || unit > 0x1p128) unit_[k] = unit;
    }
}

std::size_t MomentSums::size() const {
    const std::size_t d = width();
    return d * powers + d * (d - 1) / 2 * products;
}

std::size_t MomentSums::pair(std::size_t i, std::size_t j) const {
    const std::size_t before = i * (2 * width() - i - 1) / 2 + (j - i - 1);
    return width() * powers + before * products;
}

void MomentSums::add_block(std::span<const double> rows, std::span<double> sums) const {
    const std::size_t d = width();
    std::vector<double> off(d);
    std::vector<double> inverse(d);
    for (std::size_t k = 0; k < d; ++k) inverse[k] = 1 / unit_[k];
    for (std::size_t at = 0; at < rows.size(); at += d) {
        for (std::size_t k = 0; k < d; ++k) {
            const double x = off[k] = (rows[at + k] - about_[k]) * inverse[k];
            double power = 1;
            for (std::size_t p = 0; p < powers; ++p) sums[k * powers + p] += power *= x;
        }
        double* out = sums.data() + d * powers;
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t j = i + 1; j < d; ++j, out += products) {
                const double xy = off[i] * off[j];
                out[0] += xy;
                out[1] += xy * off[i];
                out[2] += xy * off[j];
                out[3] += xy * xy;
            }
    }
}

void MomentSums::Node::add(std::span<const double> more) {
    for (std::size_t i = 0; i < more.size(); ++i) {
        const DoubleDouble total = exact_sum(sums[i], more[i]);
        sums[i] = total.high;
        carries[i] += total.low;
    }
}

void MomentSums::Node::add(const Node& other) {
    for (std::size_t i = 0; i < carries.size(); ++i) carries[i] += other.carries[i];
    add(other.sums);
}

void MomentSums::add(std::span<const double> rows, const RunContext& run) {
    const std::size_t d = width();
    const std::uint64_t count = rows.size() / d;
    const std::uint64_t block = std::max<std::size_t>(1, 8192 / d);
    std::vector<std::vector<double>> parts(block_count(count, block));
    for_each_block(silent(run), count, block, [&](const Block& b) {
        parts[b.index].resize(size());
        add_block(rows.subspan(b.first * d, (b.last - b.first) * d), parts[b.index]);
    });
    Node batch{.first = next_++,
               .sums = std::vector<double>(size()),
               .carries = std::vector<double>(size())};
    for (const auto& part : parts) batch.add(part);
    take(std::move(batch));
    count_ += count;
}

/// Appends a node; merges the last two as long as they are siblings in the binary tree of batches.
void MomentSums::take(Node node) {
    nodes_.push_back(std::move(node));
    while (nodes_.size() > 1) {
        Node& left = nodes_[nodes_.size() - 2];
        const Node& right = nodes_.back();
        if (left.level != right.level || (left.first >> left.level) % 2 != 0) return;
        left.add(right);
        ++left.level;
        nodes_.pop_back();
    }
}

MomentSums::Node MomentSums::total() const {
    Node all = nodes_.back();
    for (std::size_t i = nodes_.size() - 1; i-- > 0;) {
        Node before = nodes_[i];
        before.add(all);
        all = std::move(before);
    }
    return all;
}

void MomentSums::pack(Packer& to) const {
    to.put(count_).put(next_).put<std::uint64_t>(nodes_.size());
    for (const Node& node : nodes_)
        to.put(node.first).put(node.level).put_all(node.sums).put_all(node.carries);
}

void MomentSums::merge(Unpacker& from) {
    count_ += from.take<std::uint64_t>();
    next_ = from.take<std::uint64_t>();
    for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
        Node node{.first = from.take<std::uint64_t>(), .level = from.take<std::uint64_t>()};
        node.sums = from.take_all<double>();
        node.carries = from.take_all<double>();
        take(std::move(node));
    }
}

/// Adds the moments of column k and their errors, from its sums of powers of (x - about) / unit.
void MomentSums::column(const Node& all, std::size_t k, SampleAndErrors& out) const {
    const auto n = static_cast<double>(count_);
    double raw[powers + 1] = {1};
    for (std::size_t p = 1; p <= powers; ++p) raw[p] = all.sum(k * powers + p - 1) / n;
    const double e = raw[1];
    double central[powers + 1] = {};
    for (std::size_t p = 0; p <= powers; ++p) {
        double binomial = 1;
        double power = 1;  // (-e)^i
        for (std::size_t i = 0; i <= p; ++i) {
            central[p] += binomial * power * raw[p - i];
            binomial = binomial * static_cast<double>(p - i) / static_cast<double>(i + 1);
            power *= -e;
        }
    }
    const double m2 = std::max(central[2], 0.0);
    const double spread = std::sqrt(m2);
    const bool flat = m2 == 0;
    const double g1 = flat ? 0 : central[3] / (m2 * spread);
    const double g4 = flat ? 0 : central[4] / (m2 * m2);
    const double g5 = flat ? 0 : central[5] / (m2 * m2 * spread);
    const double g6 = flat ? 0 : central[6] / (m2 * m2 * m2);
    const double unit = unit_[k];
    const double variance = m2 * n / (n - 1);
    const auto root = [n](double x) { return std::sqrt(std::max(x, 0.0) / n); };
    out.value.mean.push_back(about_[k] + unit * e);
    out.value.variance.push_back(variance * unit * unit);
    out.value.skewness.push_back(g1);
    out.error.mean.push_back(unit * root(variance));
    out.error.variance.push_back(m2 * root(g4 - (n - 3) / (n - 1)) * unit * unit);
    if (!flat && out.value.variance.back() < std::numeric_limits<double>::min())
        fail(ErrorKind::limit, "variances of coordinates are below the smallest normal double");
    out.error.skewness.push_back(
        flat ? 0 : root(g6 - 3 * g1 * g5 - 6 * g4 + 2.25 * g1 * g1 * g4 + 8.75 * g1 * g1 + 9));
}

/// Adds the covariance of columns i and j. Its error follows from E (x - mean)^2 (y - mean)^2.
void MomentSums::cross(const Node& all, std::size_t i, std::size_t j, SampleAndErrors& out) const {
    const auto n = static_cast<double>(count_);
    const std::size_t at = pair(i, j);
    const double a = all.sum(i * powers) / n;
    const double b = all.sum(j * powers) / n;
    const double aa = all.sum(i * powers + 1) / n;
    const double bb = all.sum(j * powers + 1) / n;
    const double xy = all.sum(at) / n;
    const double xxy = all.sum(at + 1) / n;
    const double xyy = all.sum(at + 2) / n;
    const double xxyy = all.sum(at + 3) / n;
    const double covariance = xy - a * b;
    const double fourth = xxyy - 2 * b * xxy - 2 * a * xyy + b * b * aa + a * a * bb +
                          4 * a * b * xy - 3 * a * a * b * b;
    const double variances = std::max(aa - a * a, 0.0) * std::max(bb - b * b, 0.0);
    const double square =
        fourth - covariance * covariance * (n - 2) / (n - 1) + variances / (n - 1);
    const double error = std::sqrt(std::max(square, 0.0) / n);
    const std::size_t d = width();
    for (const std::size_t place : {i * d + j, j * d + i}) {
        out.value.covariance[place] = covariance * n / (n - 1) * unit_[i] * unit_[j];
        out.error.covariance[place] = error * unit_[i] * unit_[j];
    }
}

SampleAndErrors MomentSums::moments() const {
    const std::size_t d = width();
    const Node all = total();
    const auto require_finite = [](const std::vector<double>& numbers, const char* which) {
        if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
            fail(ErrorKind::limit, "{} of coordinates are beyond the largest double", which);
    };
    require_finite(all.sums, "the sixth powers");
    SampleAndErrors out;
    out.value.covariance.resize(d * d);
    out.error.covariance.resize(d * d);
    for (std::size_t k = 0; k < d; ++k) {
        column(all, k, out);
        out.value.covariance[k * d + k] = out.value.variance[k];
        out.error.covariance[k * d + k] = out.error.variance[k];
    }
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = i + 1; j < d; ++j) cross(all, i, j, out);
    require_finite(out.value.covariance, "variances");
    require_finite(out.error.covariance, "standard errors of variances");
    return out;
}

}  // namespace stipple::analyzers
