// SPDX-License-Identifier: MIT
//
// Writing and reading a million 2-D points on one core; for comparison, as many numbers by other
// libraries.
#include <benchmark/benchmark.h>
#include <fmt/compile.h>

#include <charconv>

#include "core/rng.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"

using namespace stipple;

namespace {

constexpr std::size_t count = 1'000'000;
constexpr std::size_t numbers = 2 * count;

const std::vector<double>& points() {
    static const std::vector<double> rows = [] {
        std::vector<double> random(numbers);
        Rng(1).fill(0, random);
        return random;
    }();
    return rows;
}

/// Like the command line: blocks of rows in a reused buffer.
template <class Sink>
void write(const Format& format, const Sink& sink) {
    const Layout layout{.dimension = 2, .counts = {count}};
    constexpr std::size_t block = 8192;
    std::string out;
    const std::span<const double> rows = points();
    if (format.head) format.head(layout, out);
    if (format.begin_set) format.begin_set(layout, 0, out);
    for (std::size_t first = 0; first < count; first += block) {
        const std::size_t size = std::min(block, count - first);
        format.rows(layout, 0, first, rows.subspan(2 * first, 2 * size), out);
        sink(out);
        out.clear();
    }
    if (format.tail) format.tail(layout, out);
    sink(out);
}

void write_points(benchmark::State& state, const char* name) {
    std::size_t bytes = 0;
    for (auto _ : state)
        write(io::format_named(name), [&](const std::string& out) { bytes += out.size(); });
    state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
    state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}

void read_points(benchmark::State& state, const char* name) {
    const Format& format = io::format_named(name);
    std::string file;
    write(format, [&](const std::string& out) { file += out; });
    const RunContext run{.threads = 1};
    for (auto _ : state) benchmark::DoNotOptimize(format.read(file, {.dimension = 2}, run));
    state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
    state.SetBytesProcessed(static_cast<std::int64_t>(file.size()) * state.iterations());
}

/// Prints numbers one after another with `put(buffer, value)`, which returns the end.
template <class Put>
void print_numbers(benchmark::State& state, const Put& put) {
    std::vector<char> text(numbers * 32);
    for (auto _ : state) {
        char* end = text.data();
        for (const double value : points()) end = put(end, value);
        benchmark::DoNotOptimize(end);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(numbers) * state.iterations());
}

/// Reads the output of append_number with `take(begin, end, value)`, which returns the end.
template <class Take>
void scan_numbers(benchmark::State& state, const Take& take) {
    std::string text;
    io::append_rows(text, points(), 1, {"", "", "\n"});
    const char* const last = text.data() + text.size();
    for (auto _ : state) {
        double value = 0;
        for (const char* p = text.data(); p != last; ++p) p = take(p, last, value);
        benchmark::DoNotOptimize(value);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(numbers) * state.iterations());
}

void print_ours(benchmark::State& state) {
    std::string out;
    for (auto _ : state) {
        out.clear();
        for (const double value : points()) io::append_number(out, value);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(numbers) * state.iterations());
}
void print_fmt(benchmark::State& state) {
    print_numbers(state,
                  [](char* to, double x) { return fmt::format_to(to, FMT_COMPILE("{}"), x); });
}
void print_to_chars(benchmark::State& state) {
    print_numbers(state, [](char* to, double x) { return std::to_chars(to, to + 32, x).ptr; });
}
void scan_ours(benchmark::State& state) { scan_numbers(state, io::read_number); }
void scan_from_chars(benchmark::State& state) {
    scan_numbers(state, [](const char* p, const char* last, double& value) {
        return std::from_chars(p, last, value).ptr;
    });
}

}  // namespace

#define STIPPLE_FORMAT(verb, name) \
    BENCHMARK_CAPTURE(verb##_points, name, #name)->Unit(benchmark::kMillisecond)

STIPPLE_FORMAT(write, csv);
STIPPLE_FORMAT(write, json);
STIPPLE_FORMAT(write, npy);
STIPPLE_FORMAT(read, csv);
STIPPLE_FORMAT(read, txt);
STIPPLE_FORMAT(read, json);
STIPPLE_FORMAT(read, jsonl);
STIPPLE_FORMAT(read, npy);
STIPPLE_FORMAT(read, bin);
BENCHMARK(print_ours)->Unit(benchmark::kMillisecond);
BENCHMARK(print_fmt)->Unit(benchmark::kMillisecond);
BENCHMARK(print_to_chars)->Unit(benchmark::kMillisecond);
BENCHMARK(scan_ours)->Unit(benchmark::kMillisecond);
BENCHMARK(scan_from_chars)->Unit(benchmark::kMillisecond);
