// SPDX-License-Identifier: MIT
#include "math/densities/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr std::string_view name_letters =
    "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view blanks = " \t\n\v\f\r";
constexpr std::string_view letters = "xyz";

const FormulaOperation* find_operation(std::string_view name, bool is_function) {
    const auto all = formula_operations();
    const auto at = std::ranges::find_if(all, [&](const FormulaOperation& operation) {
        return operation.name == name && (operation.binding == 0) == is_function;
    });
    return at != all.end() ? &*at : nullptr;
}

/// The word or letter at the start of a text.
std::string_view first_word(std::string_view rest) {
    const std::size_t end = std::min(rest.find_first_not_of(name_letters), rest.size());
    return rest.substr(0, end > 0 || rest.empty() ? end : first_letter(rest).size);
}

/// Recursive-descent parser. Each function reads what its name says and appends its steps; the
/// current token is then the one after it.
class Reader {
  public:
    Reader(std::string_view option, std::string_view text, std::size_t dimension,
           const FormulaNames* names)
        : option_(option), text_(text), dimension_(dimension), names_(names) {}

    std::vector<FormulaStep> read() {
        if (text_.find_first_not_of(" \t") == text_.npos) refuse("", "expected a formula");
        next();
        formula();
        if (token_ != Token::end) refuse_token(true);
        return std::move(steps_);
    }

  private:
    enum class Token { end, value, function, sign };

    /// condition ? formula : condition ? formula : ... : formula
    void formula() {
        std::vector<std::size_t> open;  // indices of `otherwise` steps
        for (binary(1); is("?"); binary(1)) {
            go_deeper();
            const std::size_t when = add({FormulaStep::when});
            next();
            formula();
            if (!is(":")) refuse_token(true);
            next();
            open.push_back(steps_[when].index = add({FormulaStep::otherwise}));
            --depth_;
        }
        for (; !open.empty(); open.pop_back())
            steps_[open.back()].index = add({FormulaStep::chosen});
    }

    /// Values joined by operators of at least this precedence.
    void binary(int least) {
        const std::size_t begin = begin_;
        std::size_t operand = 0;  // start of a comparison's right operand; 0 if none
        value_with_sign();
        while (token_ == Token::sign && operation_ && operation_->binding >= least) {
            const FormulaOperation& operation = *operation_;
            if (operation.binding == comparison_binding) {
                if (operand > 0) refuse_chain(begin, operand);
                operand = end_;
            }
            next();
            binary(operation.binding + 1);
            apply(operation);
        }
    }

    /// A value with at most one sign, which binds less tightly than ^.
    void value_with_sign() {
        const bool minus = is("-");
        if (minus || is("+")) next();
        value();
        if (is("^")) {
            go_deeper();
            const FormulaOperation& power = *operation_;
            next();
            value_with_sign();
            apply(power);
            --depth_;
        }
        if (minus) apply(*find_operation("negated", false));
    }

    void value() {
        if (token_ == Token::value)
            add(value_);
        else if (is("("))
            arguments(nullptr);
        else if (token_ == Token::function)
            arguments(operation_);
        else
            refuse_token(false);
        next();
    }

    /// One formula in parentheses, or the arguments of a function.
    void arguments(const FormulaOperation* function) {
        go_deeper();
        ++parentheses_;
        if (function) next();
        next();
        std::size_t given = 0;
        for (bool more = !function || !is(")"); more; more = function && is(",")) {
            if (given > 0) next();
            formula();
            if (++given > 1 && function && function->arguments == 0) apply(*function);
        }
        if (!is(")")) refuse_token(true);
        --parentheses_;
        --depth_;
        if (!function) return;
        const std::size_t wanted = function->arguments;
        if (given < std::max<std::size_t>(wanted, 1))
            refuse(function->name, "expected more arguments");
        if (wanted > 0 && given > wanted) refuse(function->name, "expected fewer arguments");
        if (wanted > 0) apply(*function);
    }

    /// Limits the recursion, so that the stack does not overflow.
    void go_deeper() {
        constexpr std::size_t most = 500;
        if (++depth_ > most)
            refuse(token(), fmt::format("expected at most {} nested formulas", most));
    }

    /// Appends a step. @return its index
    std::size_t add(const FormulaStep& step) {
        steps_.push_back(step);
        return steps_.size() - 1;
    }

    /// Appends an operation, or its value if its operands are numbers. Keeps comparisons, which
    /// affine_inequalities() reads from the steps.
    void apply(const FormulaOperation& operation) {
        const auto last = std::span(steps_).last(operation.arguments == 1 ? 1 : 2);
        const bool compares = operation.binding > 0 && operation.binding <= comparison_binding;
        if (compares || std::ranges::any_of(last, [](const FormulaStep& step) {
                return step.kind != FormulaStep::number;
            })) {
            const std::size_t quick = std::string_view("+-*").find(operation.name) + 1;
            add({static_cast<FormulaStep::Kind>(FormulaStep::operation + quick), 0, 0, &operation});
            return;
        }
        last.front().value = operation.value(last.front().value, last.back().value);
        if (last.size() == 2) steps_.pop_back();
    }

    [[nodiscard]] std::string_view token() const { return text_.substr(begin_, end_ - begin_); }
    [[nodiscard]] bool is(std::string_view sign) const {
        return token_ == Token::sign && token() == sign;
    }
    [[nodiscard]] std::string_view after_blanks(std::size_t at) const {
        return text_.substr(std::min(text_.find_first_not_of(blanks, at), text_.size()));
    }

    void next() {
        left_ = is("==") || is("!=") ? before_ : std::nullopt;
        before_ = std::exchange(named_, std::nullopt);
        const std::string_view rest = after_blanks(end_);
        begin_ = text_.size() - rest.size();
        if (rest.empty())
            token_ = Token::end;
        else if (read_number(rest))
            token_ = Token::value;
        else if (names_ && (rest[0] == '"' || rest[0] == '\''))
            read_quoted();
        else if (name_letters.find(rest[0]) != rest.npos)
            read_name(first_word(rest));
        else
            read_sign(rest);
    }

    bool read_number(std::string_view rest) {
        // Signs, and words such as inf, are not numbers here.
        if (rest[0] != '.' && !(rest[0] >= '0' && rest[0] <= '9')) return false;
        value_ = {FormulaStep::number};
        const auto [end, error] =
            std::from_chars(rest.data(), rest.data() + rest.size(), value_.value);
        end_ = begin_ + static_cast<std::size_t>(end - rest.data());
        return error == std::errc();
    }

    void read_name(std::string_view name) {
        end_ = begin_ + name.size();
        operation_ = find_operation(name, true);
        token_ = operation_ ? Token::function : Token::value;
        if (operation_ && text_.substr(end_).starts_with('(')) return;
        named_ = coordinate(name);
        if (name == "e" || name == "pi")
            value_ = {FormulaStep::number, name == "e" ? std::numbers::e : std::numbers::pi};
        else if (named_ && !operation_)
            value_ = {FormulaStep::coordinate, 0, *named_};
        else
            refuse(name, operation_ ? "expected '(' after it" : expectation());
    }

    [[nodiscard]] std::optional<std::size_t> coordinate(std::string_view name) const {
        if (names_) return may_name_variable(name) ? names_->find(name) : std::nullopt;
        std::size_t k = dimension_ <= letters.size() ? letters.find(name) : name.npos;
        if (name.size() > 1) k = parse_unsigned(name.substr(1)).value_or(0) - 1;
        return k < dimension_ && (name.size() == 1 || name == fmt::format("x{}", k + 1))
                   ? std::optional(k)
                   : std::nullopt;
    }

    /// Reads a name or a level in quotes.
    void read_quoted() {
        const std::size_t close = text_.find(text_[begin_], begin_ + 1);
        end_ = close == text_.npos ? begin_ + 1 : close + 1;
        if (close == text_.npos) refuse(token(), "expected a closing quote");
        const std::string word(text_.substr(begin_ + 1, close - begin_ - 1));
        token_ = Token::value;
        named_ = names_->find(word);
        if (const auto k = compared()) {
            const auto& words = names_->words(*k);
            const auto at = std::ranges::find(words, word);
            value_ = {FormulaStep::number, static_cast<double>(at - words.begin())};
            if (at != words.end()) return;
            if (!named_) unknown(word, fmt::format("a level of {}", names_->names()[*k]), words);
        }
        if (!named_) unknown(word, "a name, or a level next to == or !=", names_->names());
        value_ = {FormulaStep::coordinate, 0, *named_};
    }

    /// Coordinate with levels that == or != compares with the current token; nullopt if none.
    [[nodiscard]] std::optional<std::size_t> compared() const {
        if (left_ && !names_->words(*left_).empty()) return left_;
        std::string_view rest = after_blanks(end_);
        if (!rest.starts_with("==") && !rest.starts_with("!=")) return std::nullopt;
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks, 2), rest.size()));
        std::string_view word = first_word(rest);
        if (word == "'" || word == "\"") word = rest.substr(1, rest.find(word, 1) - 1);
        const auto k = names_->find(word);
        return k && !names_->words(*k).empty() ? k : std::nullopt;
    }

    void read_sign(std::string_view rest) {
        token_ = Token::sign;
        for (const std::size_t size : {2U, 1U}) {
            end_ = begin_ + size;
            operation_ = find_operation(token(), false);
            if (operation_) return;
        }
        if (std::string_view("(),?:").find(rest[0]) != rest.npos) return;
        if (rest[0] == '=' && begin_ > 0 &&
            std::string_view("=<>!").find(text_[begin_ - 1]) != rest.npos)
            refuse_token(false);
        if (rest[0] == '=') refuse("=", "expected == to compare");
        if (std::string_view("~@\"'").find(rest[0]) != rest.npos)
            refuse(token(), "expected a number, a variable or an operator");
        refuse(first_word(rest), expectation());
    }

    /// Throws an error at the current token.
    [[noreturn]] void refuse(std::string_view found, std::string_view expected) const {
        fail(ErrorKind::usage, "--{}: '{}', column {}: {}{}", option_, text_, begin_ + 1,
             found.empty() ? "" : fmt::format("'{}': ", found), expected);
    }

    /// Throws an error at a token that cannot begin a value, or cannot follow one.
    [[noreturn]] void refuse_token(bool follows_value) const {
        constexpr const char* otherwise = "':' and the value otherwise";
        std::string_view wanted = "a number, a variable, a function or '('";
        if (token_ == Token::end) {
            if (follows_value) wanted = parentheses_ > 0 ? "')'" : otherwise;
            fail(ErrorKind::usage,
                 "--{}: '{}': the formula ends at column {}, where {} was expected", option_, text_,
                 text_.find_last_not_of(" \t") + 2, wanted);
        }
        if (is(","))
            refuse(",", "expected one formula; commas only separate arguments of a function");
        if (is(")") && (!follows_value || parentheses_ == 0))
            refuse(")", "expected a '(' before it, and a formula between them");
        if (is("^")) refuse("^", expectation());
        if (follows_value) wanted = is(":") ? "a '?'" : (is(")") ? otherwise : "an operator");
        refuse(token(), fmt::format("expected {} before it", wanted));
    }

    /// Throws an error at a < b < c, which would compare c with 0 or 1.
    [[noreturn]] void refuse_chain(std::size_t begin, std::size_t operand) const {
        const auto piece = [&](std::size_t from, std::size_t to) {
            return trim(text_.substr(from, to - from));
        };
        Reader rest = *this;
        rest.next();
        rest.binary(comparison_binding + 1);
        refuse(token(),
               fmt::format("comparisons cannot be chained; write {} && {} {}", piece(begin, begin_),
                           piece(operand, begin_), piece(begin_, rest.begin_)));
    }

    [[noreturn]] void unknown(const std::string& word, const std::string& expected,
                              const std::vector<std::string>& known) const {
        fail_with_hint(ErrorKind::usage, suggest(word, known),
                       "--{}: '{}', column {}: {}: expected {}", option_, text_, begin_ + 1,
                       token(), expected);
    }

    /// Text on what may follow, with the names of at most twelve variables, for errors.
    [[nodiscard]] std::string expectation() const {
        constexpr std::size_t most = 12;
        std::string all;
        for (std::size_t k = 0; names_ && k < std::min(most, dimension_); ++k) {
            const std::string& name = names_->names()[k];
            all += fmt::format("{0}{1}{0}, ", may_name_variable(name) ? "" : "\"", name);
        }
        if (names_ && dimension_ > most) all += "..., ";
        if (!names_ && dimension_ > letters.size()) all = fmt::format("x1 to x{}, ", dimension_);
        for (std::size_t k = 0; !names_ && dimension_ <= letters.size() && k < dimension_; ++k)
            all += fmt::format("{}, ", letters[k]);
        return "expected a number, an operator, " + all + "pi, e or a function such as exp";
    }

    std::string_view option_;
    std::string_view text_;
    std::size_t dimension_;
    const FormulaNames* names_;
    std::vector<FormulaStep> steps_;
    std::size_t depth_ = 0;
    std::size_t parentheses_ = 0;  ///< number of open parentheses

    // The current token
    Token token_ = Token::end;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    FormulaStep value_{FormulaStep::number};
    const FormulaOperation* operation_ = nullptr;  ///< if the token is a function or an operator
    std::optional<std::size_t> named_;             ///< coordinate that the token names
    std::optional<std::size_t> before_;            ///< coordinate that the previous token names
    std::optional<std::size_t> left_;              ///< coordinate left of a preceding == or !=
};

}  // namespace

Expression::Expression(std::string_view option, std::string_view text, std::size_t dimension,
                       const FormulaNames* names)
    : dimension_(dimension), steps_(Reader(option, text, dimension, names).read()) {
    char quote = 0;
    for (const char c : text) {
        if (quote == 0 ? c == '"' || c == '\'' : c == quote) quote = quote == 0 ? c : '\0';
        if (quote != 0 || (c != ' ' && c != '\t')) text_ += c;
    }
}

bool may_name_variable(std::string_view name) {
    return !name.empty() && name.find_first_not_of(name_letters) == name.npos &&
           !(name[0] >= '0' && name[0] <= '9') && name != "e" && name != "pi" &&
           !find_operation(name, true);
}

}  // namespace stipple
