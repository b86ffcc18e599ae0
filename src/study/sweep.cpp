// SPDX-License-Identifier: MIT
#include "study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple {
namespace {

template <class Unit>
Chosen<Unit> chosen(const Unit& unit, const Spec& spec, std::string_view who) {
    if (!spec.coordinates.empty())
        fail(ErrorKind::usage, "{}: {} takes no coordinates; '@' is for warps", who, unit.name);
    Chosen<Unit> c{.unit = &unit};
    try {
        c.values = spec.values(unit.options);
    } catch (const Error& e) {
        throw Error(e.kind(), fmt::format("{}: {}: {}", who, unit.name, e.what()), e.hint());
    }
    c.spec = format_spec(unit.name, c.values, unit.options);
    c.options = typed_settings(c.values, unit.options);
    return c;
}

/// Refuses options that write files, because every set would overwrite them.
void refuse_files(const Chosen<Generator>& c) {
    for (const std::string& option : c.unit->writes)
        if (c.values.find(option).given)
            fail(ErrorKind::usage, "generators: {}: --{} writes a file, which a study does not",
                 c.unit->name, option);
}

template <class Unit>
void refuse_twice(const std::vector<Chosen<Unit>>& list, std::string_view who) {
    for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (list[i].spec == list[j].spec)
                fail(ErrorKind::usage, "{}: '{}' is given twice", who, list[i].spec);
}

/// Whether a key begins with the analyzer's name.
bool is_of(const std::string& key, const Analyzer& analyzer) {
    return (key + ".").starts_with(analyzer.name + ".");
}

/// Gives each measure its keys. @throws Error(usage) for a key that no measure has, and for a
/// measure that has none of the keys
void choose_keys(const std::vector<std::string>& wanted, std::vector<Chosen<Analyzer>>& measures) {
    std::vector<std::string> known;
    for (const auto& measure : measures)
        for (const ResultKey& result : measure.unit->results) known.push_back(result.key);
    for (const auto& key : wanted) {
        const bool named =
            std::ranges::any_of(measures, [&](const auto& m) { return is_of(key, *m.unit); });
        bool found = false;
        for (auto& measure : measures) {
            const std::string own = without_name(key, *measure.unit);
            if ((named && !is_of(key, *measure.unit)) || !has_result(*measure.unit, own)) continue;
            measure.keys.push_back(own);
            found = true;
        }
        if (!found)
            fail_with_hint(ErrorKind::usage, suggest(key, known),
                           "--keys: no measure of the study has a result '{}'", key);
    }
    for (const auto& measure : measures)
        if (!wanted.empty() && measure.keys.empty())
            fail_with_hint(ErrorKind::usage,
                           fmt::format("add one, or leave out {}", measure.unit->name),
                           "--keys: none of these is a result of {}: {}", measure.unit->name,
                           join(wanted, ", "));
}

template <class Unit>
std::string names_of(const std::vector<Chosen<Unit>>& list) {
    std::string text;
    for (const auto& c : list) {
        if (!text.empty()) text += ' ';
        text += c.unit->name;
        for (const auto& [name, value] : c.options) text += fmt::format(";{}={}", name, value);
        text += c.spec.substr(std::min(c.spec.find(" -w "), c.spec.size()));
    }
    return text;
}

}  // namespace

bool names_result(const std::string& result, std::string_view wanted) {
    const auto parts = split(result, '.');
    const auto asked = split(wanted.substr(0, wanted.find('[')), '.');
    const auto alike = [](std::string_view part, std::string_view word) {
        const bool any = !part.empty() &&
                         part.find_first_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
        return any || part == word;
    };
    return std::search(parts.begin(), parts.end(), asked.begin(), asked.end(), alike) !=
           parts.end();
}

bool has_result(const Analyzer& analyzer, std::string_view key) {
    return std::ranges::any_of(analyzer.results,
                               [&](const ResultKey& r) { return names_result(r.key, key); });
}

std::string without_name(const std::string& key, const Analyzer& analyzer) {
    if (!is_of(key, analyzer)) return key;
    const bool alone = key == analyzer.name;
    std::string rest = alone ? "value" : key.substr(analyzer.name.size() + 1);
    // The key stays if a model's output has the analyzer's name.
    return !find_result(analyzer, key) || (!alone && has_result(analyzer, rest)) ? rest : key;
}

Sweep::Sweep(SweepRequest request)
    : request_(std::move(request)), warp_names_(join(request_.warps, " ")) {
    choose();
    count_units();
    write_settings();
}

void Sweep::choose() {
    for (const auto& text : request_.generators) {
        const GeneratorSpec asked = parse_generator(text);
        auto& generator = generators_.emplace_back(
            chosen(find_generator(asked.unit.name), asked.unit, "generators"));
        generator.spec += format_own_warps(asked.warps);
        generator.warps = warp_list(asked.warps);
        refuse_files(generator);
    }
    for (const auto& text : request_.measures) {
        const Spec spec = parse_spec(text);
        measures_.push_back(chosen(find_analyzer(spec.name), spec, "analyze"));
    }
    if (generators_.empty()) fail(ErrorKind::usage, "--generators: name at least one");
    if (measures_.empty()) fail(ErrorKind::usage, "--analyze: name at least one analyzer");
    refuse_twice(generators_, "generators");
    refuse_twice(measures_, "analyze");
    choose_keys(request_.keys, measures_);
}

/// Index in warp_lists_ of `own`, a generator's warps, followed by the request's; may add it.
std::size_t Sweep::warp_list(std::vector<std::string> own) {
    own.insert(own.end(), request_.warps.begin(), request_.warps.end());
    WarpList list{.names = own};
    const auto known = std::ranges::find(warp_lists_, list.names, &WarpList::names);
    if (known != warp_lists_.end()) return static_cast<std::size_t>(known - warp_lists_.begin());
    for (const auto& text : own) {
        const Spec& spec = list.all.emplace_back(parse_spec(text));
        const Scramble* scramble = scramble_named(spec.name);
        (void)spec.values(scramble ? scramble->options : find_warp(spec.name).options);
        list.random |= scramble != nullptr;
        if (scramble && list.scrambles + 1 == list.all.size()) ++list.scrambles;
    }
    warp_lists_.push_back(std::move(list));
    return warp_lists_.size() - 1;
}

void Sweep::count_units() {
    std::uint64_t units = 1;
    for (const std::uint64_t factor :
         {std::uint64_t{generators_.size()}, std::uint64_t{request_.dimensions.size()},
          std::uint64_t{request_.counts.size()}, request_.seeds, std::uint64_t{measures_.size()}}) {
        if (factor == 0) fail(ErrorKind::usage, "a study needs counts, dimensions and seeds");
        if (__builtin_mul_overflow(units, factor, &units) || units >= std::uint64_t{1} << 62)
            fail(ErrorKind::limit, "the study would have more than 2^62 rows");
    }
    if (request_.seeds - 1 > ~request_.first_seed)
        fail(ErrorKind::usage, "--seed: {} and {} seeds go beyond the 64 bits of a seed",
             request_.first_seed, request_.seeds);
    units_ = units;
}

void Sweep::write_settings() {
    const SweepRequest& r = request_;
    settings_ = {{"version", STIPPLE_VERSION},
                 {"generators", names_of(generators_)},
                 {"analyze", names_of(measures_)},
                 {"warp", warp_names_},
                 {"count", join(r.counts, ",")},
                 {"dimension", join(r.dimensions, ",")},
                 {"seed", std::to_string(r.first_seed)},
                 {"seeds", std::to_string(r.seeds)},
                 {"keys", join(r.keys, ",")},
                 {"curves", r.curves ? "true" : "false"},
                 {"time-limit", r.time_limit ? format_number(*r.time_limit) : "none"},
                 {"no-seconds", r.seconds ? "false" : "true"}};
    std::string text;
    for (const auto& [name, value] : settings_) text += fmt::format("{}={}\n", name, value);
    fingerprint_ = format_fingerprint(stipple::fingerprint(text));
}

std::uint64_t Sweep::cells() const {
    return generators_.size() * request_.dimensions.size() * request_.counts.size();
}

Cell Sweep::cell(std::uint64_t index) const {
    const std::uint64_t counts = request_.counts.size();
    const std::uint64_t dimensions = request_.dimensions.size();
    return {.generator = index / counts / dimensions,
            .dimension = request_.dimensions[index / counts % dimensions],
            .count = request_.counts[index % counts]};
}

Unit Sweep::unit(std::uint64_t index) const {
    const std::uint64_t set = index / measures_.size();
    return {.cell = set / request_.seeds,
            .seed_index = set % request_.seeds,
            .measure = index % measures_.size()};
}

std::string Sweep::missing_from(const Sweep& part) const {
    const SweepRequest& all = request_;
    const SweepRequest& some = part.request_;
    const auto lacks = [](const auto& list, const auto& entry, auto projection) {
        return std::ranges::find(list, entry, projection) == list.end();
    };
    for (const auto& generator : part.generators_)
        if (lacks(generators_, generator.spec, &Chosen<Generator>::spec))
            return fmt::format("the generator {}", generator.spec);
    for (const auto& measure : part.measures_)
        if (lacks(measures_, measure.spec, &Chosen<Analyzer>::spec))
            return fmt::format("the measure {}", measure.spec);
    for (const std::uint64_t count : some.counts)
        if (lacks(all.counts, count, std::identity()))
            return fmt::format("sets of {} points", count);
    for (const std::uint64_t dimension : some.dimensions)
        if (lacks(all.dimensions, dimension, std::identity()))
            return fmt::format("dimension {}", dimension);
    if (some.first_seed < all.first_seed) return fmt::format("seed {}", some.first_seed);
    const std::uint64_t last = some.first_seed + (some.seeds - 1);
    return last > all.first_seed + (all.seeds - 1) ? fmt::format("seed {}", last) : "";
}

std::optional<std::uint64_t> Sweep::index_of(std::string_view generator, std::uint64_t dimension,
                                             std::uint64_t count, std::uint64_t seed,
                                             std::string_view measure) const {
    std::uint64_t index = 0;
    bool known = true;
    const auto append = [&](const auto& list, const auto& entry, auto projection) {
        const auto it = std::ranges::find(list, entry, projection);
        known = known && it != list.end();
        index = index * list.size() + static_cast<std::uint64_t>(it - list.begin());
    };
    append(generators_, generator, &Chosen<Generator>::spec);
    append(request_.dimensions, dimension, std::identity());
    append(request_.counts, count, std::identity());
    const std::uint64_t seed_index = seed - request_.first_seed;
    known = known && seed >= request_.first_seed && seed_index < request_.seeds;
    index = index * request_.seeds + seed_index;
    append(measures_, measure, &Chosen<Analyzer>::spec);
    return known ? std::optional(index) : std::nullopt;
}

std::vector<std::string> Sweep::files() const {
    static const std::vector<std::string> written = {"grid", "image", "wisdom"};
    std::vector<std::string> all;
    for (const auto& c : generators_)
        std::ranges::move(files_of(*c.unit, c.values, warp_lists_[c.warps].all),
                          std::back_inserter(all));
    for (const auto& c : measures_)
        std::ranges::move(files_of(c.unit->options, c.values, written), std::back_inserter(all));
    return all;
}

bool Sweep::seeded(std::size_t generator) const {
    const auto& c = generators_[generator];
    return warps_of(generator).random || uses_seed(*c.unit, c.values);
}

}  // namespace stipple
