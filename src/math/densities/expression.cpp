// SPDX-License-Identifier: MIT
#include "math/densities/expression.hpp"

#include <fmt/ranges.h>
#include <muParserBase.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/options.hpp"
#include "core/text.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/roots.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double whole_turn = 2 * std::numbers::pi;

// What the functions mean, also where those of src/math are not defined.

CosSin turned(double x) {
    if (!std::isfinite(x)) return {nan, nan};
    const double turns = std::abs(x) / whole_turn;
    const auto [c, s] = cos_sin_turns(turns - std::floor(turns));
    return {c, x < 0 ? -s : s};
}
double sine(double x) { return turned(x).sin; }
double cosine(double x) { return turned(x).cos; }
double tangent(double x) {
    const auto [c, s] = turned(x);
    return s / c;
}

/// In (-pi, pi], as precise on both sides of the x axis.
double angle(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    // Infinite coordinates as directions.
    const double wide = std::isinf(x) ? std::copysign(1.0, x) : (std::isinf(y) ? 0 : x);
    const double high = std::isinf(y) ? std::copysign(1.0, y) : (std::isinf(x) ? 0 : y);
    return std::copysign(whole_turn * turns_of(wide, std::abs(high)), high);
}
double arc_sine(double x) {
    return std::abs(x) <= 1 ? angle(x, std::sqrt((1 - x) * (1 + x))) : nan;
}
double arc_cosine(double x) {
    return std::abs(x) <= 1 ? angle(std::sqrt((1 - x) * (1 + x)), x) : nan;
}

double exp_of(double x) { return x > 709 ? infinity : (std::isnan(x) ? nan : exponential(x)); }
double log_of(double x) {
    if (x == infinity) return infinity;
    return x > 0 ? logarithm(x) : (x == 0 ? -infinity : nan);
}
double sinh_of(double x) {
    if (std::abs(x) > 709) return x > 0 ? infinity : -infinity;
    const double rise = exp_minus_1(std::abs(x));
    return std::copysign(0.5 * (rise + rise / (rise + 1)), x);
}
double cosh_of(double x) {
    const double up = exp_of(std::abs(x));
    return 0.5 * (up + 1 / up);
}
double tanh_of(double x) {
    if (std::abs(x) > 350) return x > 0 ? 1 : -1;
    const double rise = exp_minus_1(2 * std::abs(x));
    return std::copysign(rise / (rise + 2), x);
}

double power(double x, double y) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    // Small whole exponents by products, as one would write them out.
    if (y == std::floor(y) && std::abs(y) <= 16) {
        const double up = whole_power(x, static_cast<std::size_t>(std::abs(y)));
        return y < 0 ? 1 / up : up;
    }
    if (y == 0.5) return std::sqrt(x);
    const bool odd = std::abs(y) < 0x1p53 && std::floor(y / 2) * 2 != y;
    if (x < 0 && y != std::floor(y)) return nan;
    if (!std::isfinite(x) || !std::isfinite(y)) {
        const double size = std::abs(x);
        const bool grows = (size > 1) == (y > 0);
        return size == 1 ? 1 : (grows ? infinity : 0);
    }
    const double size = real_power(std::abs(x), y);
    return x < 0 && odd ? -size : size;
}

constexpr std::pair<const char*, mu::fun_type1> functions_of_one[] = {
    {"sin", sine},
    {"cos", cosine},
    {"tan", tangent},
    {"asin", arc_sine},
    {"acos", arc_cosine},
    {"atan", [](double x) { return angle(x, 1); }},
    {"sinh", sinh_of},
    {"cosh", cosh_of},
    {"tanh", tanh_of},
    {"exp", exp_of},
    {"log", log_of},
    {"ln", log_of},
    {"log2", [](double x) { return log_of(x) / std::numbers::ln2; }},
    {"log10", [](double x) { return log_of(x) / std::numbers::ln10; }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"cbrt", [](double x) { return std::isfinite(x) ? cube_root(x) : x; }},
    {"abs", [](double x) { return std::abs(x); }},
    {"sign", [](double x) { return x > 0 ? 1 : (x < 0 ? -1 : x); }},
    {"floor", [](double x) { return std::floor(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
    {"round", [](double x) { return std::round(x); }},
};

constexpr std::pair<const char*, mu::fun_type2> functions_of_two[] = {
    {"atan2", angle},
    {"pow", power},
    {"mod", [](double x, double y) { return std::fmod(x, y); }},  // exact, so the same everywhere
    {"hypot", [](double x, double y) { return std::sqrt(x * x + y * y); }},
};

constexpr std::pair<const char*, mu::multfun_type> functions_of_many[] = {
    {"min", [](const double* x, int n) { return *std::min_element(x, x + n); }},
    {"max", [](const double* x, int n) { return *std::max_element(x, x + n); }},
};

int read_number(const char* text, int* at, double* value) {
    const std::string_view rest(text);
    if (rest.empty() || rest.find_first_of("0123456789.") != 0) return 0;  // no sign, no word
    const auto [end, error] = std::from_chars(text, text + rest.size(), *value);
    if (error != std::errc()) return 0;
    *at += static_cast<int>(end - text);
    return 1;
}

constexpr char power_mark = '~';  // ^ is built in and the C library's; this one is ours

constexpr std::string_view name_letters =
    "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

using Names = VariableNames;

constexpr std::string_view letters = "xyz";

/// muParser with our functions and none of its own.
class Parser final : public mu::ParserBase {
  public:
    Parser(const std::string& text, const Names& names, std::vector<double>& variables) {
        DefineNameChars(std::string(name_letters).c_str());
        DefineOprtChars("+-*/^?<>=!&|~");
        DefineInfixOprtChars("+-");
        AddValIdent(read_number);
        InitFun();
        InitConst();
        InitOprt();
        EnableOptimizer(false);
        for (const auto& [name, k] : names) DefineVar(name, &variables[k]);
        std::string marked = text;
        std::ranges::replace(marked, '^', power_mark);
        SetExpr(marked);
    }

  protected:
    void InitCharSets() override {}
    void InitFun() override {
        for (const auto& [name, f] : functions_of_one) DefineFun(name, f);
        for (const auto& [name, f] : functions_of_two) DefineFun(name, f);
        for (const auto& [name, f] : functions_of_many) DefineFun(name, f);
    }
    void InitConst() override {
        DefineConst("pi", std::numbers::pi);
        DefineConst("e", std::numbers::e);
    }
    void InitOprt() override {
        DefineInfixOprt(
            "-", +[](double x) { return -x; });
        DefineInfixOprt(
            "+", +[](double x) { return x; });
        DefineOprt(std::string(1, power_mark), power, mu::prPOW, mu::oaRIGHT);
    }
};

/// What would have been right where muParser met something else.
std::string expectation(const mu::ParserError& error, const std::string& variables) {
    switch (error.GetCode()) {
        case mu::ecUNASSIGNABLE_TOKEN:
            return fmt::format("expected a number, an operator, {}pi, e or a function such as exp",
                               variables.empty() ? "" : variables + ", ");
        case mu::ecTOO_MANY_PARAMS:
            return "expected fewer arguments";
        case mu::ecTOO_FEW_PARAMS:
            return "expected more arguments";
        case mu::ecUNEXPECTED_ARG_SEP:
        case mu::ecUNEXPECTED_ARG:
            return "expected one formula, with commas between arguments of a function only";
        case mu::ecUNEXPECTED_VAL:
        case mu::ecUNEXPECTED_VAR:
        case mu::ecUNEXPECTED_FUN:
            return "expected an operator before it";
        case mu::ecUNEXPECTED_PARENS:
            if (error.GetToken() == "(") return "expected an operator before it";
            return "expected a '(' for it, and something between";
        case mu::ecUNEXPECTED_OPERATOR:
        case mu::ecUNEXPECTED_CONDITIONAL:
            return "expected a number, a variable, a function or '(' before it";
        default:
            return error.GetMsg();
    }
}

/// What is wrong at a column, counted from 1.
[[noreturn]] void refuse(std::string_view option, std::string_view text, std::size_t column,
                         std::string_view token, std::string_view expected) {
    const std::string found = token.empty() ? "" : fmt::format(" '{}':", token);
    fail(ErrorKind::usage, "--{}: '{}', column {}:{} {}", option, text, column, found, expected);
}

/// Where the formula ends too early.
[[noreturn]] void refuse_end(std::string_view option, std::string_view text, std::size_t column,
                             mu::EErrorCodes code) {
    std::string_view wanted = "a number, a variable, a function or '('";
    if (code == mu::ecMISSING_PARENS) wanted = "')'";
    if (code == mu::ecMISSING_ELSE_CLAUSE) wanted = "':' and what holds else";
    fail(ErrorKind::usage, "--{}: '{}': the formula ends at column {}, where {} was expected",
         option, text, column, wanted);
}

/// The word or sign at the start of what muParser did not understand, which goes on to the end.
std::string_view first_word(std::string_view rest) {
    const auto is_name = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '_';
    };
    const auto end = std::ranges::find_if_not(rest, is_name);
    if (end != rest.begin()) return rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    std::size_t size = std::min<std::size_t>(rest.size(), 1);  // and the other bytes of a character
    while (size < rest.size() && (static_cast<unsigned char>(rest[size]) & 0xC0U) == 0x80U) ++size;
    return rest.substr(0, size);
}

/// Says what muParser found wrong.
[[noreturn]] void explain(std::string_view option, std::string_view text,
                          const mu::ParserError& error, const std::string& variables,
                          const mu::funmap_type& functions) {
    const std::size_t end = text.find_last_not_of(" \t") + 1;  // 0 for blanks alone
    if (end == 0) refuse(option, text, 1, "", "expected a formula");
    const auto code = error.GetCode();
    const auto at = static_cast<std::size_t>(std::max(error.GetPos(), 0));
    if (at >= end || code == mu::ecUNEXPECTED_EOF || code == mu::ecMISSING_PARENS ||
        code == mu::ecMISSING_ELSE_CLAUSE)
        refuse_end(option, text, end + 1, code);
    if (code != mu::ecUNASSIGNABLE_TOKEN) {
        std::string token = error.GetToken();
        std::ranges::replace(token, power_mark, '^');
        refuse(option, text, at + 1, token, expectation(error, variables));
    }
    const std::string word(first_word(text.substr(at)));
    refuse(option, text, at + 1, word,
           functions.contains(word) ? "expected '(' behind it" : expectation(error, variables));
}

/// A lone = would change a variable.
void check_characters(std::string_view option, std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char before = i > 0 ? text[i - 1] : ' ';
        const char behind = i + 1 < text.size() ? text[i + 1] : ' ';
        if (text[i] == power_mark || text[i] == '"')
            refuse(option, text, i + 1, text.substr(i, 1),
                   "expected a number, a variable or an operator");
        if (text[i] != '=' || behind == '=') continue;
        if (before != '=' && before != '<' && before != '>' && before != '!')
            refuse(option, text, i + 1, "=", "expected == to compare");
    }
}

/// A parser with its variables.
struct Machine {
    Machine(const std::string& text, const Names& names, std::size_t dimension)
        : variables(dimension), parser(text, names, variables) {}

    std::vector<double> variables;
    Parser parser;
};

}  // namespace

/// One for each thread.
struct Expression::Machines {
    Machines(const std::string& text, const Names& names, std::size_t dimension)
        : of_threads(text, names, dimension) {}

    tbb::enumerable_thread_specific<Machine> of_threads;
};

/// The coordinates of a point as formulas call them.
struct Expression::Variables {
    std::size_t dimension = 0;
    Names names = {};
    std::string told = {};  ///< for messages

    /// x, y, z where they are no more; else x1, x2, ...
    static Variables usual(std::size_t dimension) {
        Variables all{.dimension = dimension, .names = usual_variables(dimension)};
        all.told = dimension > letters.size()
                       ? fmt::format("x1 to x{}", dimension)
                       : fmt::format("{}", fmt::join(letters.substr(0, dimension), ", "));
        return all;
    }

    static Variables named(const std::vector<std::string>& names) {
        Variables all{.dimension = names.size(), .names = named_variables(names)};
        for (const auto& variable : all.names)
            all.told += (all.told.empty() ? "" : ", ") + variable.first;
        return all;
    }
};

Expression::Expression(std::string_view option, std::string_view text, std::size_t dimension)
    : Expression(option, text, Variables::usual(dimension)) {}

Expression::Expression(std::string_view option, std::string_view text,
                       const std::vector<std::string>& names)
    : Expression(option, text, Variables::named(names)) {}

Expression::Expression(std::string_view option, std::string_view text, const Variables& variables)
    : dimension_(variables.dimension) {
    check_characters(option, text);
    for (const char c : text)
        if (c != ' ' && c != '\t') text_ += c;
    std::optional<Machine> machine;
    try {
        machine.emplace(std::string(text), variables.names, dimension_);
        machine->parser.Eval();
        if (machine->parser.GetNumResults() > 1)
            refuse(option, text, text.rfind(',') + 1, ",",
                   "expected one formula, with commas between arguments of a function only");
    } catch (const mu::ParserError& error) {
        explain(option, text, error, variables.told,
                machine ? machine->parser.GetFunDef() : mu::funmap_type());
    }
    machines_ = std::make_shared<Machines>(text_, variables.names, dimension_);
}

VariableNames usual_variables(std::size_t dimension) {
    VariableNames names;
    for (std::size_t k = 0; k < dimension; ++k) {
        names.emplace_back(fmt::format("x{}", k + 1), k);
        if (dimension <= letters.size()) names.emplace_back(letters.substr(k, 1), k);
    }
    return names;
}

VariableNames named_variables(const std::vector<std::string>& names) {
    VariableNames variables;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (may_name_variable(names[k])) variables.emplace_back(names[k], k);
    return variables;
}

bool may_name_variable(std::string_view name) {
    if (name.empty() || name.find_first_not_of(name_letters) != std::string_view::npos)
        return false;
    const auto functions = formula_functions();
    return !(name[0] >= '0' && name[0] <= '9') && name != "e" && name != "pi" &&
           std::ranges::find(functions, name) == functions.end();
}

double formula_value(std::string_view option, std::string_view text) {
    return Expression(option, text, 0).at({});
}

double Expression::at(std::span<const double> point) const {
    double value = 0;
    evaluate(point, {&value, 1});
    return value;
}

void Expression::evaluate(std::span<const double> points, std::span<double> values) const {
    auto& [variables, parser] = machines_->of_threads.local();
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::copy_n(points.data() + i * dimension_, dimension_, variables.begin());
        values[i] = parser.Eval();
    }
}

std::vector<std::string> formula_functions() {
    std::vector<std::string> names;
    for (const auto& [name, f] : functions_of_one) names.emplace_back(name);
    for (const auto& [name, f] : functions_of_two) names.emplace_back(name);
    for (const auto& [name, f] : functions_of_many) names.emplace_back(name);
    return names;
}

std::string muparser_version() {
    const std::string version = mu::ParserVersion;
    return version.substr(0, version.find(' '));
}

std::string place_text(std::span<const double> point) {
    if (point.size() == 1) return fmt::format("x = {}", point[0]);
    return fmt::format("({})", fmt::join(point, ", "));
}

}  // namespace stipple
