// SPDX-License-Identifier: MIT
//
// Texts that people type: numbers, specs, options, formulas, JSON, letters; checked against the
// standard library if it has the function.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/domain.hpp"
#include "core/json.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "fuzz.hpp"
#include "generators/generator.hpp"
#include "io/decimal.hpp"
#include "math/densities/expression.hpp"
#include "pipeline/chain.hpp"
#include "report/check.hpp"
#include "study/study_config.hpp"
#include "warps/warp.hpp"

namespace stipple::fuzz {
namespace {

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

/// Parses a number at the front of a text, compared with strtod.
void read_decimal(std::string_view text) {
    double value = 0;
    const char* const last = text.data() + text.size();
    const char* const end = io::read_number(text.data(), last, value);
    const std::size_t sign = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
    const bool begins = text.size() > sign && (std::isdigit(text[sign]) != 0 || text[sign] == '.');
    if (end == nullptr) {
        require(!begins || text.substr(sign, 1) == ".", "digits that are no number");
        return;
    }
    const std::string number(text.data(), end);
    char* stop = nullptr;
    const double expected = std::strtod(number.c_str(), &stop);
    require(*stop == '\0' && same(value, expected), "another number: " + number);
    if (end != last && begins) require(std::isdigit(*end) == 0, "not all digits");
}

/// Writes a double: reading back gives the same number, and truncated digits are those of the
/// shortest text that does.
void write_decimal(double value, int precision) {
    std::string text;
    io::append_number(text, value);
    double back = 0;
    const char* const last = text.data() + text.size();
    require(io::read_number(text.data(), last, back) == last && same(back, value), "not back");
    if (!std::isfinite(value)) return;
    std::string cut;
    io::append_number(cut, value, precision);
    std::string whole(500, '\0');
    whole.resize(static_cast<std::size_t>(std::to_chars(whole.data(), whole.data() + whole.size(),
                                                        std::abs(value), std::chars_format::fixed)
                                              .ptr -
                                          whole.data()));
    if (whole.find('.') == std::string::npos) whole += '.';
    const auto digits = static_cast<std::size_t>(precision);
    whole.append(digits, '0');
    whole.resize(whole.find('.') + (digits == 0 ? 0 : digits + 1));
    const bool nothing = whole.find_first_of("123456789") == std::string::npos;
    require(cut == (std::signbit(value) && !nothing ? "-" : "") + whole, "cut to " + cut);
}

void numbers(std::string_view bytes) {
    FuzzedDataProvider input(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    const int precision = input.ConsumeIntegralInRange(0, 60);
    const double value = std::bit_cast<double>(input.ConsumeIntegral<std::uint64_t>());
    const std::string text = input.ConsumeRemainingBytesAsString();
    write_decimal(value, precision);
    write_decimal(std::fmod(value, 1e3), precision);
    read_decimal(text);
    const auto whole = parse_integer(text);
    std::int64_t plain = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, plain);
    if (error == std::errc() && stop == end) require(whole == plain, "another integer");
    if (const auto natural = parse_unsigned(text); natural && whole)
        require(*whole >= 0 && static_cast<std::uint64_t>(*whole) == *natural, "another natural");
    if (const auto number = parse_number(text)) {
        require(parse_number(format_number(*number)) == number, "another number");
        if (whole) require(static_cast<double>(*whole) == *number, "no integer");
    }
    if (const auto size = parse_bytes(text)) format_bytes(static_cast<double>(*size));
}

/// Untrusted text as it is displayed; nlohmann's library decides if it is valid UTF-8.
void letters(std::string_view bytes) {
    bool valid = true;
    try {
        (void)nlohmann::json(bytes).dump();
    } catch (const nlohmann::json::exception&) {
        valid = false;
    }
    const std::u32string points = code_points(bytes);
    const std::string back = utf8_of(points);
    require(!valid || back == bytes, "valid letters changed");
    require(code_points(back) == points, "other letters");
    bool all = true;
    for (std::string_view rest = bytes; !rest.empty();) {
        const Letter letter = first_letter(rest);
        all = all && letter.valid;
        rest.remove_prefix(letter.size);
    }
    require(all == valid, "another opinion on what is valid");
    for (const std::string& text : {printable(bytes), printable(shown(bytes))}) {
        (void)nlohmann::json(text).dump();
        for (const char c : text) require(c < 0 || (c >= 32 && c != 127), "a control character");
    }
    require(cut_short(bytes).size() < 9000, "not cut short");
    const std::vector<std::string> known = {"halton", "sobol", std::string(bytes.substr(0, 9))};
    suggest(bytes.substr(0, 99), known);
}

void json(std::string_view bytes) {
    const JsonExtent extent = json_extent(bytes);
    const bool good = nlohmann::json::accept(bytes);
    Json value;
    try {
        value = parse_json(bytes);
        require(good, "taken as JSON");
    } catch (const JsonError& error) {
        require(error.at <= bytes.size(), "a place behind the end");
        require(!good || extent.too_deep != bytes.npos, "not taken as JSON");
        require(try_parse_json(bytes).is_discarded(), "taken at another time");
        return;
    }
    const std::string text = json_text(value);
    const Json again = parse_json(text);
    require(json_text(again) == text, "another value");
    if (value.is_structured()) require(json_extent(text).size == text.size(), "another extent");
}

/// A unit's option values as a spec; parsing it must give the same values.
template <class Unit>
void settings(const std::vector<Unit>& units, const Spec& spec) {
    for (const Unit& unit : units) {
        if (unit.name != spec.name) continue;
        const Values values = spec.values(unit.options);
        const std::string text = format_spec(unit.name, values, unit.options);
        const Spec again = parse_spec(text);
        const Values back = again.values(unit.options);
        require(format_spec(unit.name, back, unit.options) == text, "another spec: " + text);
        for (const auto& item : values.items())
            require(format_value(item.value) == format_value(back.find(item.name).value),
                    "another value of " + item.name);
    }
}

void spec(std::string_view bytes) {
    std::vector<std::string> all;
    accepted([&] { all = split_specs(bytes, "--generators"); });
    accepted([&] { parse_counts(bytes, "--count", 1, std::uint64_t{1} << 53); });
    accepted([&] { parse_check(bytes); });
    accepted([&] { format_box(parse_box(bytes, 2)); });
    all.emplace_back(bytes);
    for (const std::string& text : all)
        accepted([&] {
            const Spec found = parse_spec(text);
            settings(generators::all(), found);
            settings(warps::all(), found);
            settings(analyzers::all(), found);
        });
}

void domain(std::string_view bytes) {
    const DomainPtr found = parse_domain(bytes, 2, small_run());
    const std::vector<double> point(found->dimension(), 0.3);
    std::vector<double> cube(found->cube_dimension());
    if (found->contains(point)) found->to_cube(point, cube);
    for (const double x : cube) require(x >= 0 && x <= 1, "not in the cube");
    require(!(found->density(point) < 0), "a density below 0");
    found->bounding_box();
    const std::string text = found->spec();
    require(parse_domain(text, 2, small_run())->spec() == text, "another domain");
}

void formula(std::string_view bytes) {
    accepted([&] {
        if (const auto value = parse_formula("x", bytes))
            require(std::isfinite(*value), "infinite");
    });
    accepted([&] { parse_numbers("x", bytes); });
    for (const std::size_t d : {1, 3})
        accepted([&] {
            const Expression f("x", bytes, d);
            const std::vector<double> at = {0, 0.5, 1, -2.5, 1e300, 0.25};
            std::vector<double> values(at.size() / d);
            f.evaluate(at, values);
            for (std::size_t i = 0; i < values.size(); ++i)
                require(same(values[i], f.at(std::span(at).subspan(i * d, d))), "another value");
            const Expression again("x", f.text(), d);
            require(same(again.at(std::span(at).first(d)), values[0]), "another formula");
        });
}

}  // namespace

std::vector<Target> text_targets() {
    return {{"numbers", numbers}, {"letters", letters}, {"json-text", json},
            {"spec", spec},       {"domain", domain},   {"formula", formula}};
}

}  // namespace stipple::fuzz
