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
#include <unordered_set>
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

// Functions for formulas: the functions of src/math, extended to arguments outside their domains.

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

/// Angle in (-pi, pi], equally precise on both sides of the x axis.
double angle(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    // Treats infinite coordinates as directions.
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
    // Small integer exponents use multiplications, as if written out.
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
    {"mod", [](double x, double y) { return std::fmod(x, y); }},  // exact, hence portable
    {"hypot", [](double x, double y) { return std::sqrt(x * x + y * y); }},
};

constexpr std::pair<const char*, mu::multfun_type> functions_of_many[] = {
    {"min", [](const double* x, int n) { return *std::min_element(x, x + n); }},
    {"max", [](const double* x, int n) { return *std::max_element(x, x + n); }},
};

int read_number(const char* text, int* at, double* value) {
    // Signs, and words such as inf, are not numbers here.
    if (*text != '.' && !(*text >= '0' && *text <= '9')) return 0;
    const char* last = text;
    while (*last != 0 && std::string_view("0123456789.eE+-").find(*last) != std::string_view::npos)
        ++last;
    const auto [end, error] = std::from_chars(text, last, *value);
    if (error != std::errc()) return 0;
    *at += static_cast<int>(end - text);
    return 1;
}

constexpr char power_mark = '~';  // our power operator: muParser's ^ uses the C library

constexpr char quote_mark = '@';  // first character of the placeholder for a quoted name

constexpr std::string_view name_letters =
    "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

using Names = VariableNames;

constexpr std::string_view letters = "xyz";

/// muParser with our functions only.
class Parser final : public mu::ParserBase {
  public:
    Parser(const std::string& text, const Names& names, std::vector<double>& variables) {
        DefineNameChars(fmt::format("{}{}", name_letters, quote_mark).c_str());
        DefineOprtChars("+-*/^?<>=!&|~");
        DefineInfixOprtChars("+-");
        AddValIdent(read_number);
        InitFun();
        InitConst();
        InitOprt();
        EnableOptimizer(false);
        for (std::size_t i = 0; i < names.size(); ++i) DefineVar(names[i].first, &variables[i]);
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

/// Describes the input that was expected at muParser's error.
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
            return "expected one formula; commas only separate arguments of a function";
        case mu::ecUNEXPECTED_VAL:
        case mu::ecUNEXPECTED_VAR:
        case mu::ecUNEXPECTED_FUN:
            return "expected an operator before it";
        case mu::ecUNEXPECTED_PARENS:
            if (error.GetToken() == "(") return "expected an operator before it";
            return "expected a '(' before it, and a formula between them";
        case mu::ecUNEXPECTED_OPERATOR:
        case mu::ecUNEXPECTED_CONDITIONAL:
            return "expected a number, a variable, a function or '(' before it";
        default:
            return error.GetMsg();
    }
}

/// Throws an error at a column, counted from 1.
[[noreturn]] void refuse(std::string_view option, std::string_view text, std::size_t column,
                         std::string_view token, std::string_view expected) {
    const std::string found = token.empty() ? "" : fmt::format(" '{}':", token);
    fail(ErrorKind::usage, "--{}: '{}', column {}:{} {}", option, text, column, found, expected);
}

/// Throws an error if the formula ends too early.
[[noreturn]] void refuse_end(std::string_view option, std::string_view text, std::size_t column,
                             mu::EErrorCodes code) {
    std::string_view wanted = "a number, a variable, a function or '('";
    if (code == mu::ecMISSING_PARENS) wanted = "')'";
    if (code == mu::ecMISSING_ELSE_CLAUSE) wanted = "':' and the value otherwise";
    fail(ErrorKind::usage, "--{}: '{}': the formula ends at column {}, where {} was expected",
         option, text, column, wanted);
}

/// The word or sign at the start of `rest`, which muParser did not understand.
std::string_view first_word(std::string_view rest) {
    const std::size_t end = std::min(rest.find_first_not_of(name_letters), rest.size());
    if (end > 0) return rest.substr(0, end);
    // One byte, then the other bytes of its UTF-8 character.
    std::size_t size = std::min<std::size_t>(rest.size(), 1);
    while (size < rest.size() && (static_cast<unsigned char>(rest[size]) & 0xC0U) == 0x80U) ++size;
    return rest.substr(0, size);
}

/// Throws an Error that describes muParser's error.
[[noreturn]] void explain(std::string_view option, std::string_view text,
                          const mu::ParserError& error, const std::string& variables,
                          const mu::funmap_type& functions) {
    const std::size_t end = text.find_last_not_of(" \t") + 1;  // 0 if all are blanks
    if (end == 0) refuse(option, text, 1, "", "expected a formula");
    const auto code = error.GetCode();
    const auto at = static_cast<std::size_t>(std::max(error.GetPos(), 0));
    if (at >= end || code == mu::ecUNEXPECTED_EOF || code == mu::ecMISSING_PARENS ||
        code == mu::ecMISSING_ELSE_CLAUSE)
        refuse_end(option, text, end + 1, code);
    if (code != mu::ecUNASSIGNABLE_TOKEN) {
        std::string token = error.GetToken();
        std::ranges::replace(token, power_mark, '^');
        if (token.starts_with(quote_mark))
            token = text.substr(at, text.find(text[at], at + 1) + 1 - at);
        refuse(option, text, at + 1, token, expectation(error, variables));
    }
    const std::string word(first_word(text.substr(at)));
    refuse(option, text, at + 1, word,
           functions.contains(word) ? "expected '(' after it" : expectation(error, variables));
}

/// Rejects characters with a special meaning, and a single =, which would assign to a variable.
/// @param marked the text passed to muParser
void check_characters(std::string_view option, std::string_view text, std::string_view marked) {
    for (std::size_t i = 0; i < marked.size(); ++i) {
        const char before = i > 0 ? marked[i - 1] : ' ';
        const char behind = i + 1 < marked.size() ? marked[i + 1] : ' ';
        const char c = marked[i];
        if (c == power_mark || c == '"' || c == '\'' ||
            (c == quote_mark && i < text.size() && text[i] == c))
            refuse(option, text, i + 1, text.substr(i, 1),
                   "expected a number, a variable or an operator");
        if (c != '=' || behind == '=') continue;
        if (before != '=' && before != '<' && before != '>' && before != '!')
            refuse(option, text, i + 1, "=", "expected == to compare");
    }
}

/// End of the part of a formula that begins at `from`: the next separator outside its parentheses.
std::size_t part_end(std::string_view text, std::size_t from) {
    std::size_t depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        if (depth == 0 && (text[i] == ')' || text[i] == ',' || text[i] == '?' || text[i] == ':' ||
                           text[i] == '&' || text[i] == '|'))
            return i;
        if (text[i] == ')') --depth;
    }
    return text.size();
}

/// Length of the comparison operator that begins here; 0 if there is none.
std::size_t comparison_size(std::string_view rest) {
    const bool two = rest.size() > 1 && rest[1] == '=';
    if (rest[0] == '<' || rest[0] == '>') return two ? 2 : 1;
    return (rest[0] == '=' || rest[0] == '!') && two ? 2 : 0;
}

/// Rejects a < b < c, which would compare c with 0 or 1.
void refuse_chains(std::string_view option, std::string_view text, std::string_view marked) {
    struct Part {
        std::size_t begin = 0;
        std::size_t operand = 0;  ///< position after its comparison operator; 0 if it has none
    };
    std::vector<Part> parts(1);
    for (std::size_t i = 0; i < marked.size(); ++i) {
        const char c = marked[i];
        if (c == '(') parts.push_back({.begin = i + 1});
        if (c == ')' && parts.size() > 1) parts.pop_back();
        if (c == ',' || c == '?' || c == ':' || c == '&' || c == '|') parts.back() = {i + 1};
        const std::size_t size = comparison_size(marked.substr(i));
        if (size == 0) continue;
        const auto [begin, operand] = parts.back();
        if (operand > 0 && !trim(text.substr(operand, i - operand)).empty()) {
            const auto piece = [&](std::size_t from, std::size_t to) {
                return trim(text.substr(from, to - from));
            };
            refuse(option, text, i + 1, text.substr(i, size),
                   fmt::format("comparisons cannot be chained; write {} && {} {}", piece(begin, i),
                               piece(operand, i), piece(i, part_end(marked, i))));
        }
        i += size - 1;
        parts.back().operand = i + 1;
    }
}

std::string without_blanks(std::string_view text) {
    std::string all;
    char quote = 0;
    for (const char c : text) {
        if (quote == 0 && (c == '"' || c == '\''))
            quote = c;
        else if (c == quote)
            quote = 0;
        if (quote != 0 || (c != ' ' && c != '\t')) all += c;
    }
    return all;
}

/// A name, or a text in quotes.
struct Word {
    std::size_t begin;
    std::size_t end;
    std::string text;
    bool quoted;
};

/// Finds the names and words in a formula and rewrites it for muParser: each quoted text is
/// replaced by a variable or a number, padded so that the columns in messages stay right.
class NameReader {
  public:
    NameReader(std::string_view option, std::string_view text, const FormulaNames& names)
        : option_(option), text_(text), names_(names), marked_(text) {
        for (std::size_t i = 0; i < text_.size();) {
            double number = 0;
            int at = 0;
            const char c = text_[i];
            const bool quotes = c == '"' || c == '\'';
            if (read_number(text_.c_str() + i, &at, &number) != 0) {
                i += static_cast<std::size_t>(at);
            } else if (quotes || name_letters.find(c) != name_letters.npos) {
                words_.push_back(quotes ? quoted(i) : name(i));
                i = words_.back().end;
            } else {
                ++i;
            }
        }
        for (std::size_t i = 0; i < words_.size(); ++i) {
            const Word& word = words_[i];
            if (word.quoted)
                replace(i);
            else if (may_name_variable(word.text))
                use(word.text, word.text);
        }
    }

    const std::string& marked() const { return marked_; }
    const VariableNames& variables() const { return variables_; }

  private:
    Word name(std::size_t begin) const {
        const std::string_view word = first_word(std::string_view(text_).substr(begin));
        return {begin, begin + word.size(), std::string(word), false};
    }
    Word quoted(std::size_t begin) const {
        const std::size_t end = text_.find(text_[begin], begin + 1);
        if (end == text_.npos)
            refuse(option_, text_, begin + 1, text_.substr(begin, 1), "expected a closing quote");
        return {begin, end + 1, text_.substr(begin + 1, end - begin - 1), true};
    }

    void use(const std::string& name, const std::string& marked) {
        const auto k = names_.find(name);
        if (k && used_.insert(marked).second) variables_.emplace_back(marked, *k);
    }

    /// Coordinate with which word i is compared; nullopt if none, or if it has no words for its
    /// values.
    std::optional<std::size_t> compared(std::size_t i) const {
        for (const std::size_t left : {i - 1, i}) {
            if (left + 1 == 0 || left + 1 >= words_.size()) continue;
            const std::size_t from = words_[left].end;
            const std::string_view sign =
                trim(std::string_view(text_).substr(from, words_[left + 1].begin - from));
            const auto k = names_.find(words_[left == i ? i + 1 : left].text);
            if ((sign == "==" || sign == "!=") && k && !names_.words(*k).empty()) return k;
        }
        return std::nullopt;
    }

    void replace(std::size_t i) {
        const Word& word = words_[i];
        std::string by;
        const auto name = names_.find(word.text);
        if (const auto k = compared(i)) {
            const auto& words = names_.words(*k);
            const auto at = std::ranges::find(words, word.text);
            if (at == words.end() && !name)
                unknown(word, fmt::format("a level of {}", names_.names()[*k]), words);
            if (at != words.end()) by = std::to_string(at - words.begin());
        }
        if (by.empty()) {
            if (!name) unknown(word, "a name, or a level next to == or !=", names_.names());
            by = fmt::format("{}{}", quote_mark, *name);
            use(word.text, by);
        }
        // A placeholder may be longer than the quoted text if there are very many names. This only
        // shifts the columns in messages.
        const std::size_t size = word.end - word.begin;
        by.resize(std::max(by.size(), size), ' ');
        marked_.replace(word.begin + shift_, size, by);
        shift_ += by.size() - size;
    }

    [[noreturn]] void unknown(const Word& word, const std::string& expected,
                              const std::vector<std::string>& known) const {
        fail_with_hint(ErrorKind::usage, suggest(word.text, known),
                       "--{}: '{}', column {}: {}: expected {}", option_, text_, word.begin + 1,
                       text_.substr(word.begin, word.end - word.begin), expected);
    }

    std::string_view option_;
    std::string text_;
    const FormulaNames& names_;
    std::string marked_;
    std::vector<Word> words_;
    VariableNames variables_;
    std::unordered_set<std::string> used_;
    std::size_t shift_ = 0;
};

/// The usual names of coordinates (x, x1, ...) that occur in a formula.
VariableNames usual_in(std::string_view text, std::size_t dimension) {
    VariableNames used;
    for (auto& variable : usual_variables(dimension))
        if (text.find(variable.first) != text.npos) used.push_back(std::move(variable));
    return used;
}

/// A list of names for messages.
std::string told_names(const FormulaNames& names) {
    constexpr std::size_t most = 12;
    std::vector<std::string> all;
    for (std::size_t k = 0; k < std::min(most, names.size()); ++k) {
        const std::string& name = names.names()[k];
        all.push_back(may_name_variable(name) ? name : '"' + name + '"');
    }
    if (names.size() > most) all.emplace_back("...");
    return fmt::format("{}", fmt::join(all, ", "));
}

/// A list of the usual names for messages: x, y, z or x1 to xN.
std::string told_usual(std::size_t dimension) {
    return dimension > letters.size()
               ? fmt::format("x1 to x{}", dimension)
               : fmt::format("{}", fmt::join(letters.substr(0, dimension), ", "));
}

/// A parser and its variables.
struct Machine {
    Machine(const std::string& text, const Names& names)
        : variables(names.size()), parser(text, names, variables) {}

    std::vector<double> variables;
    Parser parser;
};

}  // namespace

/// A parser for each thread.
struct Expression::Machines {
    Machines(const std::string& text, const Names& names) : of_threads(text, names) {}

    tbb::enumerable_thread_specific<Machine> of_threads;
};

void FormulaNames::add(const std::string& name, std::vector<std::string> words) {
    places_.emplace(name, names_.size());
    names_.push_back(name);
    words_.push_back(std::move(words));
}

std::optional<std::size_t> FormulaNames::find(const std::string& name) const {
    const auto at = places_.find(name);
    return at != places_.end() ? std::optional(at->second) : std::nullopt;
}

Expression::Expression(std::string_view option, std::string_view text, std::size_t dimension)
    : variables_(usual_in(text, dimension)), dimension_(dimension) {
    parse(option, text, std::string(text), told_usual(dimension));
}

Expression::Expression(std::string_view option, std::string_view text, const FormulaNames& names)
    : dimension_(names.size()) {
    const NameReader reader(option, text, names);
    variables_ = reader.variables();
    parse(option, text, reader.marked(), told_names(names));
}

void Expression::parse(std::string_view option, std::string_view text, const std::string& marked,
                       const std::string& told) {
    check_characters(option, text, marked);
    refuse_chains(option, text, marked);
    text_ = without_blanks(text);
    plain_ = without_blanks(marked);
    std::optional<Machine> machine;
    try {
        machine.emplace(marked, variables_);
        machine->parser.Eval();
        if (machine->parser.GetNumResults() > 1)
            refuse(option, text, text.rfind(',') + 1, ",",
                   "expected one formula; commas only separate arguments of a function");
    } catch (const mu::ParserError& error) {
        explain(option, text, error, told,
                machine ? machine->parser.GetFunDef() : mu::funmap_type());
    }
    machines_ = std::make_shared<Machines>(plain_, variables_);
}

VariableNames usual_variables(std::size_t dimension) {
    VariableNames names;
    for (std::size_t k = 0; k < dimension; ++k) {
        names.emplace_back(fmt::format("x{}", k + 1), k);
        if (dimension <= letters.size()) names.emplace_back(letters.substr(k, 1), k);
    }
    return names;
}

bool may_name_variable(std::string_view name) {
    if (name.empty() || name.find_first_not_of(name_letters) != std::string_view::npos)
        return false;
    static const std::vector<std::string> functions = formula_functions();
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
        for (std::size_t j = 0; j < variables.size(); ++j)
            variables[j] = points[i * dimension_ + variables_[j].second];
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
