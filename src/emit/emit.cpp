// SPDX-License-Identifier: MIT
#include "emit/emit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "emit/template.hpp"
#include "pipeline/units.hpp"

namespace stipple::emit {

const char* library_c();
const char* library_python();
const char* library_glsl();

namespace {

constexpr std::uint64_t words_end = std::uint64_t{1} << 32;
constexpr std::size_t columns = 92;  // width of lists and of text in comments

bool is_shader(Language language) {
    return language == Language::glsl || language == Language::hlsl;
}

std::string wrapped(const std::vector<std::string>& items, std::string_view separator) {
    std::string text;
    std::size_t line = 0;
    for (const std::string& item : items) {
        const bool begins = text.empty() || line + item.size() > columns;
        if (begins && !text.empty()) {
            text.erase(text.find_last_not_of(' ') + 1);
            text += '\n';
        }
        line = (begins ? 0 : line) + item.size() + separator.size();
        text += item;
        text += separator;
    }
    text.erase(text.find_last_not_of(", ") + 1);
    return text;
}

std::string wrapped_text(std::string_view text) {
    std::vector<std::string> items;
    for (const auto word : split(text, ' ')) items.emplace_back(word);
    return wrapped(items, " ");
}

/// Adds a list of integers as text: KEY, which in shaders has a pair of 32-bit words for a 64-bit
/// number; KEY.words, without such pairs; and the length, KEY.size.
void add_list(Words& words, const Constants& list, Language language) {
    const bool hex = std::ranges::any_of(list.numbers, [](std::uint64_t x) { return x >> 31; });
    const auto word = [&](std::uint64_t x) {
        const char* suffix = language == Language::python ? "" : "u";
        return hex ? fmt::format("{:#x}{}", x, suffix) : fmt::format("{}{}", x, suffix);
    };
    std::vector<std::string> numbers;
    std::vector<std::string> pairs;
    for (const std::uint64_t x : list.numbers) {
        numbers.push_back(word(x));
        pairs.push_back(fmt::format("uvec2({}, {})", word(x & 0xffffffff), word(x >> 32)));
    }
    const bool in_pairs = is_shader(language) && !list.words;
    words[list.name] = wrapped(in_pairs ? pairs : numbers, ", ");
    words[list.name + ".words"] = wrapped(numbers, ", ");
    words[list.name + ".size"] = std::to_string(numbers.size());
}

/// Adds the values of options as KEY; the elements of lists of numbers also as KEY.0, KEY.1, ...
void add_options(Words& words, const Schema& schema, const Values& values) {
    for (const Option& option : schema.options()) {
        const auto& item = values.find(option.name);
        if (option.optional && !item.given) continue;
        std::string text = format_value(item.value);
        words[option.name] = words[option.name + ".text"] = text;
        if (option.type != "numbers" && option.type != "points") continue;
        std::ranges::replace(text, ' ', ',');
        std::vector<std::string> numbers;
        for (const auto number : split(text, ',')) {
            words[fmt::format("{}.{}", option.name, numbers.size())] = number;
            numbers.emplace_back(number);
        }
        words[option.name + ".size"] = std::to_string(numbers.size());
        if (option.type == "points") words[option.name] = wrapped(numbers, ", ");
    }
}

template <class Unit>
std::string names_in(const Template& code, const std::vector<Unit>& units) {
    std::vector<std::string> names;
    for (const Unit& unit : units)
        if (code.has(unit.name)) names.push_back(unit.name);
    return join(names, ", ");
}

/// Adds a unit's part of the library; refuses a unit without one, and options that it does not use.
template <class Unit>
void add_unit(Template& code, const Unit& unit, const std::vector<Unit>& all, const Values& options,
              const Words& words) {
    if (!code.has(unit.name))
        fail_with_hint(ErrorKind::usage, "these can be: " + names_in(code, all),
                       "emit: {} cannot be emitted", unit.name);
    code.add(unit.name, words);
    for (const auto& item : options.items())
        if (item.given && !code.used(item.name))
            fail(ErrorKind::usage, "--{}: cannot be emitted for {}", item.name, unit.name);
}

/// A comment with the first two points for each of three seeds.
std::string examples(const GeneratedSets& sets, Language language, const RunContext& run) {
    std::string text;
    const std::uint64_t count = std::min<std::uint64_t>(2, sets.plan().count);
    for (std::uint64_t set = 0; set < sets.different_sets(); ++set) {
        std::vector<double> rows(count * sets.dimension());
        sets.stream(set, run, 0, count)(rows);
        for (std::uint64_t i = 0; i < count; ++i) {
            std::vector<std::string> line = {fmt::format("point {}:", i)};
            if (sets.different_sets() > 1)
                line.insert(line.begin(), fmt::format("seed {},", set + 1));
            for (std::size_t k = 0; k < sets.dimension(); ++k) {
                const double x = rows[i * sets.dimension() + k];
                line.push_back(is_shader(language) ? fmt::format("{}", to_single(x))
                                                   : format_number(x));
            }
            text += wrapped(line, " ") + "\n";
        }
    }
    text.pop_back();
    return text;
}

/// Statements that set a point's coordinates.
class Statements {
  public:
    Statements(Language language, std::string name, std::size_t dimension)
        : language_(language), name_(std::move(name)) {
        for (std::size_t k = 0; k < dimension; ++k)
            row_.push_back(
                fmt::format("{}(index, {}{}, seed)", name_, k, is_shader(language) ? "u" : ""));
    }

    /// Replaces two coordinates by the image under a warp.
    void warp(const std::string& function, std::vector<std::size_t> coordinates,
              std::size_t gives) {
        if (coordinates.empty()) coordinates = {0, 1};
        const std::size_t a = coordinates[0];
        const std::size_t b = coordinates[1];
        const std::string image = fmt::format("image{}", ++images_);
        const std::string arguments = fmt::format("{}, {}", row_[a], row_[b]);
        if (language_ == Language::c)
            add(fmt::format("double {}[{}];\n{}({}, {})", image, gives, function, arguments,
                            image));
        else if (language_ == Language::python)
            add(fmt::format("{} = {}({})", image, function, arguments));
        else
            add(fmt::format("vec{} {} = {}({})", gives, image, function, arguments));
        std::vector<std::string> numbers;
        for (std::size_t j = 0; j < gives; ++j) numbers.push_back(fmt::format("{}[{}]", image, j));
        if (gives == 2) {
            row_[a] = numbers[0];
            row_[b] = numbers[1];
            return;
        }
        // As in WarpChain, all numbers of the image replace the first coordinate.
        row_.erase(row_.begin() + static_cast<std::ptrdiff_t>(std::max(a, b)));
        row_.erase(row_.begin() + static_cast<std::ptrdiff_t>(std::min(a, b)));
        row_.insert(row_.begin() + static_cast<std::ptrdiff_t>(a > b ? a - 1 : a), numbers.begin(),
                    numbers.end());
    }

    [[nodiscard]] std::string text() {
        for (std::size_t k = 0; k < row_.size(); ++k)
            add(fmt::format("{}[{}] = {}", is_shader(language_) ? "p" : "point", k, row_[k]));
        text_.pop_back();
        return text_;
    }

  private:
    void add(const std::string& statement) {
        text_ += statement + (language_ == Language::python ? "\n" : ";\n");
    }

    Language language_;
    std::string name_;
    std::vector<std::string> row_;  ///< expression of each coordinate
    std::string text_;
    std::size_t images_ = 0;
};

/// Adds the functions of the warps, and a function that returns whole points.
void add_warps(Template& code, const SetsToMake& job, const GeneratedSets& sets, Language language,
               const std::string& name, const RunContext& run) {
    Statements statements(language, name, sets.plan().dimension);
    for (const Spec& spec : job.warps) {
        if (scramble_named(spec.name) != nullptr)
            fail_with_hint(ErrorKind::usage, "--scramble of some generators can be",
                           "emit: the scramble {} cannot be emitted", spec.name);
        const Warp& warp = find_warp(spec.name);
        const Values values = spec.values(warp.options);
        const std::size_t gives = warp.make(values, 2, run)->domain()->dimension();
        std::string function = fmt::format("{}_{}", name, warp.name);
        while (code.text().find(function + "(") != std::string::npos) function += "_";
        Words words = {{"name", warp.name},
                       {"function", function},
                       {"dims", std::to_string(gives)},
                       {"summary", warp.summary}};
        add_options(words, warp.options, values);
        add_unit(code, warp, warps::all(), values, words);
        statements.warp(function, spec.coordinates, gives);
    }
    code.add("point",
             {{"out", std::to_string(sets.dimension())}, {"statements", statements.text()}});
}

/// Translates GLSL to HLSL, word by word.
std::string to_hlsl(std::string text) {
    for (const auto& [glsl, hlsl] : {std::pair{"uvec2", "uint2"},
                                     {"vec2", "float2"},
                                     {"vec3", "float3"},
                                     {"uintBitsToFloat", "asfloat"},
                                     {"findMSB", "firstbithigh"}})
        replace_all(text, glsl, hlsl);
    std::string out;
    for (const auto line : split(std::string_view(text).substr(0, text.size() - 1), '\n')) {
        const auto begin = std::min(line.find_first_not_of(' '), line.size());
        if (line.substr(begin) == ");")
            out += fmt::format("{}}};\n", line.substr(0, begin));
        else if (line.substr(begin).starts_with("const ") && line.ends_with("]("))
            out += fmt::format("{}static {}= {{\n", line.substr(0, begin),
                               line.substr(begin, line.find("= ") - begin));
        else
            out += fmt::format("{}\n", line);
    }
    return out;
}

bool in_name(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 128 && (std::isalnum(byte) != 0 || c == '_');
}

/// Checks the name of a function; an empty name is replaced by that of the generator.
std::string function_name(std::string name, const std::string& generator) {
    if (name.empty()) {
        name = generator;
        std::ranges::replace(name, '-', '_');
    }
    const bool valid = !name.empty() && std::ranges::all_of(name, in_name);
    if (!valid || std::isdigit(static_cast<unsigned char>(name[0])) != 0)
        fail(ErrorKind::usage, "--name: '{}' is not a name of letters, digits and _", name);
    return name;
}

/// Whether a text has this word, not just as a part of another name.
bool has_word(std::string_view text, std::string_view word) {
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !in_name(text[at - 1])) && (end == text.size() || !in_name(text[end])))
            return true;
    }
    return false;
}

/// Whether a name is in a list of words, in which gl_* stands for all names that begin with gl_,
/// and *__* for all that contain __.
bool is_reserved(const std::string& name, const std::string& list) {
    std::istringstream words(list);
    for (std::string word; words >> word;) {
        const bool anywhere = word.front() == '*';
        const bool open = word.back() == '*';
        const std::string part = word.substr(anywhere, word.size() - anywhere - open);
        if (anywhere ? name.find(part) != name.npos : open ? name.starts_with(part) : name == part)
            return true;
    }
    return false;
}

/// Code without comments, preprocessor lines and docstrings.
std::string without_comments(std::string code) {
    for (const auto& [begin, end] : {std::pair{"/*", "*/"}, {"\"\"\"", "\"\"\""}, {"#", "\n"}})
        for (auto at = code.find(begin); at != code.npos; at = code.find(begin, at)) {
            const auto last = code.find(end, at + std::string_view(begin).size());
            code.replace(at, std::min(last, code.size()) - at + std::string_view(end).size(), " ");
        }
    return code;
}

/// Refuses a name that is reserved in the language or that the emitted code uses itself.
void check_name(const std::string& name, const std::string& code, const std::string& reserved,
                const std::string& language) {
    const bool taken = is_reserved(name, reserved);
    const std::string other = "my_" + name;
    if (taken || has_word(without_comments(code), name))
        fail_with_hint(
            ErrorKind::usage,
            "choose another" + (is_reserved(other, reserved) ? "" : ", such as " + other),
            "--name: '{}' is {}", name,
            taken ? "a word of " + (language == "C" ? "C or C++" : language)
                  : "a name that the code uses itself");
}

/// A command as text of a comment, without characters that would end the comment.
std::string as_comment(std::string text) {
    for (const char* end : {"*/", "\"\"\"", "\\"}) replace_all(text, end, "?");
    return wrapped_text(text);
}

/// Values of {{KEY}} for the generator's part and the head of the file.
Words words_of(const SetsToMake& job, const Plan& plan, Language language, const RunContext& run) {
    const Generator& generator = *job.generator;
    constexpr const char* names[] = {"C", "GLSL", "HLSL", "Python"};
    Words words = {{"language", names[static_cast<std::size_t>(language)]},
                   {"version", STIPPLE_VERSION},
                   {"cache", "@lru_cache(4096)"},  // in a template, @ would begin a name
                   {"command", as_comment(job.command)},
                   {"title", wrapped_text(generator.summary + ".")},
                   {"source", wrapped_text(generator.source)},
                   {"count", std::to_string(plan.count)},
                   {"dimension", std::to_string(plan.dimension)},
                   {"last", std::to_string(plan.dimension - 1)}};
    add_options(words, generator.options, job.options);
    std::uint64_t end = generator.traits.prefix ? generator.traits.max_index : plan.count;
    if (generator.bases) {
        Constants bases{"bases", {}, true};
        for (const std::uint32_t base : generator.bases(plan, job.options))
            bases.numbers.push_back(base);
        std::uint64_t most = 0;  // largest number of images of digits, over all bases
        constexpr std::uint64_t last = (std::uint64_t{1} << 62) - 1;  // number with most digits
        for (const std::uint64_t base : bases.numbers)
            for (std::uint64_t rest = last, images = 0; rest > 0; rest /= base)
                most = std::max(most, images += base);
        words["all_images"] = std::to_string(most);
        const std::uint64_t largest = std::ranges::max(bases.numbers);
        words["largest_base"] = std::to_string(largest);
        end = std::min(end, (std::uint64_t{1} << 62) / largest);  // reversed digits stay below 2^62
        add_list(words, bases, language);
    }
    if (is_shader(language)) end = std::min(end, words_end);
    words["end"] = std::to_string(end);
    if (generator.constants)
        for (const Constants& list : generator.constants(plan, job.options, run))
            add_list(words, list, language);
    return words;
}

}  // namespace

bool can_emit(std::string_view unit) { return Template(library_c(), {}).has(unit); }

std::string emitted(SetsToMake job, Language language, std::string name, const RunContext& run) {
    const Generator& generator = *job.generator;
    RunContext quiet = run;
    quiet.warn = nullptr;
    name = function_name(std::move(name), generator.name);
    if (generator.traits.prefix) job.request.count = 2;
    job.request.seed = 1;
    job.sets = 3;
    const Plan plan = plan_for(generator, job.request, job.options);
    if (plan.dimension > most_dimensions)  // only a given vector can have so many
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], the range of emitted code",
             plan.dimension, most_dimensions);
    if (is_shader(language) && plan.count >= words_end)
        fail(ErrorKind::usage, "--count: {} is beyond the 32 bits of an index in GLSL and HLSL",
             plan.count);
    const char* const libraries[] = {library_c(), library_glsl(), library_glsl(), library_python()};
    const std::string mark = "\x01";  // placeholder of the name, to find the code's own names
    Template code(libraries[static_cast<std::size_t>(language)], mark);
    if (language == Language::python) code.gap = "\n\n";
    Words words = words_of(job, plan, language, quiet);
    add_unit(code, generator, generators::all(), job.options, words);
    const GeneratedSets sets(job, quiet);
    if (!job.warps.empty()) {
        words["warped"] = "";
        add_warps(code, job, sets, language, mark, quiet);
    }
    for (const char* trait : {"rare", "fusible", "integers", "cached", "keyed"})
        if (code.used(trait)) words[trait] = "";
    words["points"] = examples(sets, language, quiet);
    words["parts"] = code.text().substr(0, code.text().size() - 1);
    std::string file = code.filled("file", words);
    if (language == Language::hlsl) file = to_hlsl(file);
    check_name(name, file, code.filled("reserved", words), words["language"]);
    replace_all(file, mark, name);
    return file;
}

}  // namespace stipple::emit
