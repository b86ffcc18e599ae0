// SPDX-License-Identifier: MIT
#include "experiments/parameters/parameter_space.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "experiments/parameters/linear_correlation.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "math/combinatorics/order.hpp"
#include "math/distributions/families.hpp"
#include "math/distributions/outcomes.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple::parameters {
namespace {

/// A value of the file and its path, such as $.parameters[2].range.
class Place {
  public:
    Place(const Json& value, std::string path, const std::string& source)
        : value_(value), path_(std::move(path)), source_(source) {}

    [[nodiscard]] const Json& value() const { return value_; }

    [[noreturn]] void refuse(const std::string& what, const std::string& hint = {}) const {
        throw Error(ErrorKind::input, fmt::format("{}: {}: {}", source_, path_, what), hint);
    }

    /// Runs work(); its usage errors become errors at this path.
    template <class Work>
    auto naming(const Work& work) const {
        try {
            return work();
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::usage) throw;
            const std::string_view what = e.what();
            const auto option = what.starts_with("--") ? what.find(": ") : std::string_view::npos;
            refuse(std::string(option == what.npos ? what : what.substr(option + 2)), e.hint());
        }
    }

    [[nodiscard]] bool has(const std::string& key) const { return value_.contains(key); }
    [[nodiscard]] Place at(const std::string& key) const {
        return {value_.at(key), path_ + "." + key, source_};
    }
    [[nodiscard]] std::optional<Place> find(const std::string& key) const {
        return has(key) ? std::optional(at(key)) : std::nullopt;
    }
    [[nodiscard]] std::vector<Place> list(const char* expected) const {
        if (!value_.is_array() || value_.empty()) refuse(expected);
        std::vector<Place> places;
        for (std::size_t i = 0; i < value_.size(); ++i)
            places.emplace_back(value_[i], fmt::format("{}[{}]", path_, i), source_);
        return places;
    }
    [[nodiscard]] std::string text(const std::string& expected) const {
        if (!value_.is_string()) refuse(expected);
        return value_.get<std::string>();
    }
    /// Value of the key, which must be one of `words`; empty if the key is missing.
    [[nodiscard]] std::string choice(const char* key, const std::vector<std::string>& words) const {
        const auto place = find(key);
        if (!place) return {};
        const std::string allowed = join(words, " or ");
        std::string word = place->text("expected " + allowed);
        if (std::ranges::find(words, word) == words.end())
            place->refuse(fmt::format("{} is not {}", shown(word), allowed));
        return word;
    }
    [[nodiscard]] double number() const {
        const double x = value_.is_number() ? value_.get<double>() : NAN;
        if (!std::isfinite(x)) refuse(fmt::format("{} is not a number", shown(json_text(value_))));
        return x;
    }

    /// Rejects unknown keys, and a value that is not an object.
    void check_keys(const std::vector<std::string>& known, const char* expected) const {
        if (!value_.is_object()) refuse(expected);
        for (const auto& [key, ignored] : value_.items())
            if (std::ranges::find(known, key) == known.end())
                refuse(fmt::format("the key {} is not known", shown(key)), suggest(key, known));
    }

  private:
    const Json& value_;
    std::string path_;
    const std::string& source_;
};

/// A number, or a formula that may use the preceding parameters.
struct Entry {
    double number = 0;
    std::optional<Expression> formula = {};

    [[nodiscard]] double at(std::span<const double> before) const {
        return formula ? formula->at(before.first(formula->dimension())) : number;
    }
};

Entry entry_of(const Place& place, const FormulaNames& before) {
    if (!place.value().is_string()) return {.number = place.number()};
    return place.naming(
        [&] { return Entry{.formula = Expression("", place.value().get<std::string>(), before)}; });
}

/// Limits the length of lists, since all of them are stored in the points' provenance.
void check_size(const Place& values, std::size_t count) {
    constexpr std::size_t most = 100'000;
    if (count > most)
        values.refuse(fmt::format("{} numbers; expected 1 to {}", count, most),
                      "use some thousand of their quantiles");
}

/// Reads the keys of one parameter. @param before names of the preceding parameters
class ParameterReader {
  public:
    ParameterReader(const Place& place, const FormulaNames& before)
        : place_(place), before_(before) {}

    Parameter read() {
        const std::vector<std::string> kinds = {"range",  "distribution", "integers",
                                                "levels", "values",       "file"};
        if (!place_.value().is_object()) place_.refuse("expected an object, {\"name\": ...}");
        const auto given =
            std::ranges::count_if(kinds, [&](const auto& k) { return place_.has(k); });
        if (given != 1)
            place_.refuse(fmt::format("expected one of the keys {}; {}", join(kinds, ", "),
                                      given == 0 ? "none is given" : "several are given"));
        Parameter parameter{.name = name(), .unit = unit(), .levels = {}, .law = {}};
        if (place_.has("levels"))
            take_levels(parameter);
        else if (place_.has("values"))
            take_values(parameter);
        else if (place_.has("file"))
            place_.at("file").refuse("only --parameters FILE reads columns of other files",
                                     "put their numbers here, \"values\": [...]");
        else
            take_law(parameter);
        return parameter;
    }

  private:
    std::string name() const {
        if (!place_.has("name")) place_.refuse("the name is missing");
        const Place at = place_.at("name");
        std::string name = at.text("expected a name, such as \"length\"");
        if (before_.find(name)) at.refuse(fmt::format("{} is given twice", shown(name)));
        check_word(at, name);
        std::string header = name;
        std::ranges::replace(header, ',', '.');  // since 1,5 may be read as 1.5
        if (!io::is_word(header)) refuse_word(at, name);
        if (name == "set" || name == "pdf" || name == "weight")
            at.refuse(fmt::format("the column name {} is reserved", name));
        if (name == "e" || name == "pi")
            at.refuse(
                fmt::format("{} is a constant in formulas, which the name would hide", shown(name)),
                "choose a longer name");
        return name;
    }

    std::string unit() const {
        const auto at = place_.find("unit");
        if (!at) return {};
        std::string unit = at->text("expected a unit, such as \"mm\"");
        if (unit != printable(unit)) at->refuse("the unit has unprintable characters");
        return unit;
    }

    /// Checks that a word can be used in a table's header and cells, and in a spec.
    static void check_word(const Place& at, const std::string& word) {
        if (word.empty() || word != printable(word) || word != trim(word) || word.size() > 200 ||
            word.find_first_of("\"[]") != std::string::npos || word[0] == '#' || word[0] == '{' ||
            parse_number(word))
            refuse_word(at, word);
    }

    [[noreturn]] static void refuse_word(const Place& at, const std::string& word) {
        at.refuse(
            fmt::format("{} cannot be a name; expected printable characters, not a number, "
                        "without quotes and brackets",
                        shown(word)));
    }

    void check_keys(std::vector<std::string> more) const {
        more.insert(more.end(), {"name", "unit"});
        place_.check_keys(more, "expected an object");
    }

    struct Law {
        const char* key;  ///< the key that selects the distribution
        std::string family;
        std::vector<std::pair<std::string, Entry>> numbers = {};
        std::optional<std::pair<Entry, Entry>> within = {};

        [[nodiscard]] bool depends() const {
            const auto by_formula = [](const Entry& entry) { return entry.formula.has_value(); };
            return std::ranges::any_of(numbers, by_formula,
                                       &std::pair<std::string, Entry>::second) ||
                   (within && (by_formula(within->first) || by_formula(within->second)));
        }

        [[nodiscard]] MarginalPtr at(std::span<const double> before) const {
            NamedNumbers values;
            for (const auto& [name, entry] : numbers) values.emplace_back(name, entry.at(before));
            MarginalPtr made = make_marginal(family, values);
            if (!within) return made;
            return truncated(made, within->first.at(before), within->second.at(before));
        }
    };

    std::pair<Entry, Entry> pair_of(const char* key) const {
        const Place at = place_.at(key);
        const auto ends = at.list("expected two numbers, [low, high]");
        if (ends.size() != 2) at.refuse("expected two numbers, [low, high]");
        return {entry_of(ends[0], before_), entry_of(ends[1], before_)};
    }

    Law ends(std::string family, const char* key) const {
        const auto [low, high] = pair_of(key);
        return {key, std::move(family), {{"low", low}, {"high", high}}};
    }

    Law law() const {
        if (place_.has("integers")) {
            check_keys({"integers"});
            return ends("integers", "integers");
        }
        if (place_.has("range")) {
            check_keys({"range", "scale"});
            const bool log = place_.choice("scale", {"log", "linear"}) == "log";
            return ends(log ? "log-uniform" : "uniform", "range");
        }
        return distribution();
    }

    Law distribution() const {
        const Place at = place_.at("distribution");
        Law law{.key = "distribution", .family = at.text("expected the name of a distribution")};
        const auto parameters = at.naming([&] { return marginal_family(law.family).parameters; });
        std::vector<std::string> keys;
        for (const MarginalParameter& parameter : parameters) keys.emplace_back(parameter.name);
        keys.insert(keys.end(), {"distribution", "truncate"});
        check_keys(keys);
        for (const MarginalParameter& parameter : parameters)
            if (const auto number = place_.find(std::string(parameter.name)))
                law.numbers.emplace_back(parameter.name, entry_of(*number, before_));
        if (place_.has("truncate")) law.within = pair_of("truncate");
        return law;
    }

    void take_law(Parameter& parameter) const {
        const Law law = this->law();
        if (law.depends())
            parameter.law_given = [law, name = parameter.name](std::span<const double> before) {
                try {
                    return law.at(before);
                } catch (const Error& e) {
                    throw Error(ErrorKind::input,
                                fmt::format("the parameter {}, with the preceding values {}: {}",
                                            name, join(before, ", "), e.what()));
                }
            };
        else
            parameter.law = place_.at(law.key).naming([&] { return law.at({}); });
        parameter.uniform = law.family == "uniform";
    }

    void take_levels(Parameter& parameter) const {
        check_keys({"levels", "probabilities", "normalize"});
        const auto levels = place_.at("levels").list("expected a list of words or of numbers");
        std::vector<double> values;
        std::set<std::string> seen;
        for (const Place& level : levels) {
            const bool number = level.value().is_number();
            const auto text = number ? format_number(level.number()) : json_text(level.value());
            if (!seen.insert(text).second) level.refuse(fmt::format("{} is given twice", text));
            if (number && parameter.levels.empty()) {
                values.push_back(level.number());
                continue;
            }
            if (values.size() > parameter.levels.size()) level.refuse("expected only numbers");
            parameter.levels.push_back(level.text("expected only words"));
            check_word(level, parameter.levels.back());
            values.push_back(static_cast<double>(parameter.levels.size() - 1));
        }
        const auto weights = probabilities(levels.size());
        std::vector<double> rising, of_rising;
        for (const auto i : order_by(values.size(), [&](std::size_t k) { return values[k]; })) {
            rising.push_back(values[i]);
            of_rising.push_back(weights[i]);
        }
        parameter.law =
            std::make_shared<const Outcomes>("levels", std::move(rising), std::move(of_rising));
    }

    void take_values(Parameter& parameter) const {
        check_keys({"values", "interpolation"});
        const Place at = place_.at("values");
        const auto list = at.list("expected a list of numbers");
        check_size(at, list.size());
        std::vector<double> numbers;
        for (const Place& number : list) numbers.push_back(number.number());
        const bool linear = place_.choice("interpolation", {"steps", "linear"}) == "linear";
        parameter.law = at.naming(
            [&] { return measured_law(std::move(numbers), linear, ErrorKind::usage, "--values"); });
    }

    /// Probabilities of the levels, by default equal; whole numbers are ratios, as in 2:1:1.
    std::vector<double> probabilities(std::size_t count) const {
        std::vector<double> p(count, 1);
        bool ratios = true;
        if (const auto at = place_.find("probabilities")) {
            const auto list = at->list("expected a list of numbers");
            if (list.size() != count)
                at->refuse(fmt::format("{} probabilities for {} levels", list.size(), count));
            for (std::size_t i = 0; i < count; ++i) {
                p[i] = list[i].number();
                if (p[i] < 0) list[i].refuse("a probability is below 0");
                ratios = ratios && p[i] == std::floor(p[i]);
            }
        }
        double sum = 0;
        for (const double x : p) sum += x;
        const auto given = place_.find("normalize");
        if (given && !given->value().is_boolean()) given->refuse("expected true or false");
        const bool asked = given && given->value() == true;
        if (!(sum > 0)) place_.at("probabilities").refuse("all of them are 0");
        if (!std::isfinite(sum)) place_.at("probabilities").refuse("their sum exceeds float64");
        if (std::abs(sum - 1) > 1e-12 && !ratios && !asked)
            place_.at("probabilities")
                .refuse(fmt::format("the sum is {}; expected 1", sum),
                        "\"normalize\": true divides by the sum; integers are taken as ratios");
        for (double& x : p) x /= sum;
        return p;
    }

    const Place& place_;
    const FormulaNames& before_;
};

/// Dependence between parameters: a copula, a reordering, or neither.
struct Joint {
    std::optional<Copula> copula = {};
    std::optional<Reordering> reordering = {};
};

class CorrelationReader {
  public:
    CorrelationReader(const Place& place, const std::vector<Parameter>& parameters)
        : place_(place),
          parameters_(parameters),
          matrix_(parameters.size() * parameters.size()),
          spearman_(matrix_.size()),
          given_(matrix_.size()),
          numbers_(parameters.size()),
          ranks_(parameters.size()) {
        for (const Parameter& parameter : parameters) names_.push_back(parameter.name);
    }

    Joint read() {
        place_.check_keys({"copula", "degrees", "reordering", "spearman", "kendall", "pearson"},
                          "expected an object, {\"spearman\": [[\"length\", \"load\", 0.7]]}");
        const std::size_t d = parameters_.size();
        for (std::size_t i = 0; i < d; ++i) matrix_[i * d + i] = spearman_[i * d + i] = 1;
        const bool reordered = read_reordering();
        const auto degrees = read_degrees();
        if (degrees)
            refuse_keys({"spearman"}, "for Student's copula no closed form is known",
                        "give \"kendall\"");
        for (const char* kind : {"spearman", "kendall", "pearson"})
            if (const auto pairs = place_.find(kind))
                for (const Place& pair : pairs->list("expected a list of pairs"))
                    read_pair(pair, kind, degrees.has_value());
        if (!is_correlation(matrix_, d)) offer_nearest();
        if (!reordered) return {.copula = Copula(matrix_, degrees)};
        std::vector<MarginalPtr> laws;
        for (const Parameter& parameter : parameters_)
            laws.push_back(parameter.law && parameter.law->discrete() ? parameter.law : nullptr);
        return {.reordering = Reordering{spearman_, matrix_, names_, std::move(laws)}};
    }

  private:
    void refuse_keys(std::initializer_list<const char*> keys, const std::string& what,
                     const std::string& hint = {}) const {
        for (const char* key : keys)
            if (const auto at = place_.find(key)) at->refuse(what, hint);
    }

    /// Whether the file requests a reordering of sets instead of a copula.
    bool read_reordering() const {
        if (place_.choice("reordering", {"iman-conover"}).empty()) return false;
        refuse_keys({"copula", "degrees"}, "belongs to copulas, but \"reordering\" is given");
        refuse_keys({"kendall", "pearson"},
                    "not possible with a reordering, which gives rank correlations",
                    "give \"spearman\"");
        return true;
    }

    std::optional<double> read_degrees() const {
        if (place_.choice("copula", {"gaussian", "student"}) != "student") {
            refuse_keys({"degrees"}, "applies to \"copula\": \"student\" only");
            return std::nullopt;
        }
        const auto at = place_.find("degrees");
        if (!at) place_.refuse("the key degrees is missing; \"copula\": \"student\" needs it");
        const double degrees = at->number();
        if (!(degrees >= 1 && degrees <= 1e6))
            at->refuse(fmt::format("{} is outside [1, 1e6]", degrees));
        return degrees;
    }

    std::size_t index_of(const Place& place) const {
        const std::string name = place.text("expected the name of a parameter");
        const auto at = std::ranges::find(names_, name);
        if (at == names_.end())
            place.refuse(fmt::format("there is no parameter {}", shown(name)),
                         suggest(name, names_));
        return static_cast<std::size_t>(at - names_.begin());
    }

    void read_pair(const Place& pair, std::string_view kind, bool student) {
        const char* expected = "expected two names and a number, [\"length\", \"load\", 0.7]";
        const auto parts = pair.list(expected);
        if (parts.size() != 3) pair.refuse(expected);
        const std::size_t i = index_of(parts[0]);
        const std::size_t j = index_of(parts[1]);
        const double r = parts[2].number();
        if (i == j) pair.refuse("both names are the same; expected two parameters");
        if (!(r > -1 && r < 1)) parts[2].refuse(fmt::format("{} is outside (-1, 1)", r));
        const std::size_t d = parameters_.size();
        if (given_[i * d + j]) pair.refuse("the pair is given twice");
        given_[i * d + j] = given_[j * d + i] = true;
        spearman_[i * d + j] = spearman_[j * d + i] = r;  // used only for a reordering
        matrix_[i * d + j] = matrix_[j * d + i] = of_scores(pair, i, j, r, kind, student);
    }

    /// Correlation of the copula's scores for which parameters i and j have the correlation r.
    double of_scores(const Place& pair, std::size_t i, std::size_t j, double r,
                     std::string_view kind, bool student) {
        const MarginalPtr& a = parameters_[i].law;
        const MarginalPtr& b = parameters_[j].law;
        const bool discrete = (a && a->discrete()) || (b && b->discrete());
        if (kind == "kendall" && discrete)
            pair.refuse(
                "Kendall's tau cannot be prescribed for integers, levels and other parameters with "
                "ties",
                student ? "" : "give \"spearman\"");
        if (kind == "kendall") return std::copysign(cos_sin_turns(std::abs(r) / 4).sin, r);
        // For a parameter that depends on others, r is that of its conditional probability.
        if (kind == "spearman" && (!a || !b || !discrete)) return score_correlation(r);
        if (!a || !b)
            pair.refuse("the correlation of a parameter that depends on others cannot be computed");
        if (student)
            pair.refuse("can be computed for the Gaussian copula only", "give \"kendall\"");
        ranks_only_ = ranks_only_ && !discrete;
        const auto of = kind == "spearman" ? Scored::Of::ranks : Scored::Of::numbers;
        return pair.naming([&] { return scored(i, of).scores_for(scored(j, of), r); });
    }

    const Scored& scored(std::size_t i, Scored::Of of) {
        auto& made = (of == Scored::Of::ranks ? ranks_ : numbers_)[i];
        if (!made) made = std::make_shared<const Scored>(parameters_[i].law, of);
        return *made;
    }

    /// Reports the nearest possible correlations. @throws Error(input)
    [[noreturn]] void offer_nearest() const {
        const std::size_t d = parameters_.size();
        auto nearest = nearest_correlation(matrix_, d);
        const bool ranks = ranks_only_ && !place_.has("kendall") && !place_.has("pearson");
        for (double& r : nearest)
            if (ranks) r = 6 / std::numbers::pi * std::asin(r / 2);
        std::vector<std::string> pairs;
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t j = i + 1; j < d; ++j)
                if (std::abs(nearest[i * d + j]) >= 5e-7 || matrix_[i * d + j] != 0)
                    pairs.push_back(
                        fmt::format("{} and {} {:.6f}", names_[i], names_[j], nearest[i * d + j]));
        place_.refuse("these correlations are not possible together",
                      fmt::format("the nearest possible ones, {}: {}",
                                  ranks ? "as \"spearman\"" : "for the scores of a Gaussian copula",
                                  join(pairs, ", ")));
    }

    const Place& place_;
    const std::vector<Parameter>& parameters_;
    std::vector<std::string> names_;
    std::vector<double> matrix_;  ///< correlations of the scores
    std::vector<double> spearman_;
    std::vector<bool> given_;
    bool ranks_only_ = true;  ///< whether scores and parameters have equal rank correlations
    std::vector<std::shared_ptr<const Scored>> numbers_;  ///< per parameter; null until needed
    std::vector<std::shared_ptr<const Scored>> ranks_;
};

/// Numbers in the column of a file to which the parameter refers.
Json column_of(const Place& parameter, const RunContext& run) {
    const Place file = parameter.at("file");
    const std::string path = file.text("expected the name of a file");
    ReadOptions how{.all_columns = true};
    if (const auto column = parameter.find("column"))
        how.columns = {column->value().is_number_unsigned()
                           ? json_text(column->value())
                           : column->text("expected a column's name, or its number from 1")};
    const PointSet read = file.naming([&] { return io::read_given("file", path, how, run); });
    if (read.dimension() != 1)
        file.refuse(fmt::format("{} has {} columns; expected 1", path, read.dimension()),
                    "\"column\" selects one of them");
    check_size(file, read.count());
    return Json(std::vector<double>(read.flat().begin(), read.flat().end()));
}

}  // namespace

ParameterSpace parse_parameters(std::string_view json, const std::string& source) {
    const Json value = parse_written_json(json, source);
    const Place root(value, "$", source);
    root.check_keys({"parameters", "correlation", "constraints", "$schema"},
                    "expected an object, {\"parameters\": [...]}");
    if (!root.has("parameters")) root.refuse("the key parameters is missing");
    std::vector<Parameter> parameters;
    FormulaNames names;
    for (const Place& place : root.at("parameters").list("expected a list of objects")) {
        parameters.push_back(ParameterReader(place, names).read());
        names.add(parameters.back().name, parameters.back().levels);
    }
    Joint joint;
    if (const auto at = root.find("correlation")) joint = CorrelationReader(*at, parameters).read();
    std::vector<Expression> constraints;
    if (const auto at = root.find("constraints"))
        for (const Place& place : at->list("expected a list of formulas"))
            constraints.push_back(place.naming([&] {
                return Expression("", place.text("expected a formula, \"length*load < 300\""),
                                  names);
            }));
    const Place at = constraints.empty() ? root : root.at("constraints");
    return at.naming([&] {
        return ParameterSpace(std::move(parameters), std::move(joint.copula),
                              std::move(constraints), std::move(joint.reordering));
    });
}

std::string one_line(std::string_view json, const std::string& source) {
    Json value = parse_written_json(json, source);
    if (value.is_object()) value.erase("$schema");
    return json_text(value);
}

std::string text_with_columns(const std::string& path, const RunContext& run) {
    const std::string text = read_file(path);
    Json value = parse_written_json(text, path);
    if (!value.is_object() || !value.contains("parameters")) return text;
    std::size_t index = 0;
    for (Json& parameter : value["parameters"]) {
        const std::string place = fmt::format("$.parameters[{}]", index++);
        if (!parameter.is_object() || !parameter.contains("file") || parameter.contains("values"))
            continue;
        parameter["values"] = column_of(Place(parameter, place, path), run);
        parameter.erase("file");
        parameter.erase("column");
    }
    return json_text(value);
}

}  // namespace stipple::parameters
