// SPDX-License-Identifier: MIT
#include "generators/lattices/lattice_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/net_sequence.hpp"
#include "math/decaying_weights.hpp"
#include "math/digital/gf2.hpp"
#include "media/token_file.hpp"

namespace stipple {
namespace {

/// Reads the lines before the vector; returns the length of the vector.
std::size_t read_header(TokenFile& file, bool polynomial, VectorFile& found) {
    const auto take = [&](std::string_view what, std::uint64_t low, std::uint64_t high) {
        const std::uint64_t value = file.number(what, low, high);
        file.expect_line_end();
        return value;
    };
    if (file.is_headed("# plattice")) take("the base 2", 2, 2);
    std::size_t dimension = take("the number of dimensions", 1, 1'000'000);
    if (polynomial && file.comment_has(interlacing_comment)) {
        found.interlaced = take("the interlacing factor", 1, 64);
        const std::size_t components = dimension * found.interlaced;
        dimension = take("the number of components", components, components);
    }
    if (!polynomial) {
        found.points = take("the number of points", 1, std::uint64_t{1} << 53);
        return dimension;
    }
    found.points = std::uint64_t{1} << take("the degree of the modulus", 1, 52);
    found.modulus = take("the modulus, of that degree", found.points, 2 * found.points - 1);
    return dimension;
}

}  // namespace

VectorFile vector_in_file(const Values& options, bool polynomial) {
    VectorFile found;
    if (!options.given(vector_file)) return found;
    TokenFile file(options[vector_file]);
    const bool of_polynomials = file.is_headed("# plattice") ||
                                file.is_headed("# Parameters for a polynomial lattice rule");
    const bool of_numbers =
        file.is_headed("# lattice") || file.is_headed("# Parameters for a lattice rule");
    if (polynomial ? of_numbers : of_polynomials)
        file.refuse_whole(polynomial ? "a lattice of whole numbers, which rank1-lattice reads"
                                     : "a polynomial lattice, which polynomial-lattice reads");
    std::size_t wanted = 0;  // length of the vector; 0: not known
    if (of_polynomials || of_numbers) wanted = read_header(file, polynomial, found);
    std::optional<bool> numbered;
    while (!file.at_end()) {
        const Token token = file.peek();
        std::uint64_t value = file.number("a component of the vector");
        if (!numbered) numbered = !file.at_line_end() && wanted == 0;
        if (*numbered) {
            const std::size_t next = found.vector.size() + 1;
            if (value != next)
                file.refuse(token, fmt::format("{} is out of order; expected {}, the number of "
                                               "the next component",
                                               value, next));
            value = file.number_on_line("a component of the vector");
        }
        file.expect_line_end();
        found.vector.push_back(value);
    }
    if (found.vector.empty() || (wanted > 0 && found.vector.size() != wanted))
        file.refuse_whole(fmt::format("{} components; expected {}", found.vector.size(),
                                      wanted > 0 ? std::to_string(wanted) : "some"));
    return found;
}

std::vector<std::pair<std::string, std::string>> found_vector(
    const std::vector<std::uint64_t>& vector, double squared_error, const char* name) {
    std::vector<std::pair<std::string, std::string>> found{{"vector", join(vector, ",")}};
    if (std::isfinite(squared_error)) found.emplace_back(name, format_number(squared_error));
    return found;
}

std::vector<SideFile> vector_files(const Values& options, const VectorFile& lattice) {
    if (!options.given(vector_output)) {
        if (options.given(vector_format))
            fail(ErrorKind::usage,
                 "--vector-format applies to --vector-output only; give that too");
        return {};
    }
    const bool latnet = options[vector_format] == "latnet-builder";
    const bool polynomial = lattice.modulus > 0;
    if (lattice.interlaced > 1 && !latnet)
        fail(ErrorKind::usage,
             "--vector-format: lddata cannot hold interlaced lattices; latnet-builder can");
    std::string text = latnet       ? "# Parameters for a lattice rule\n"
                       : polynomial ? "# plattice\n2  # base\n"
                                    : "# lattice\n";
    if (latnet && polynomial) text = "# Parameters for a polynomial lattice rule in base 2\n";
    const auto line = [&text](std::uint64_t number, std::string_view what) {
        text += fmt::format("{}  # {}\n", number, what);
    };
    line(lattice.vector.size() / lattice.interlaced, "dimensions");
    if (lattice.interlaced > 1) {
        line(lattice.interlaced, interlacing_comment);
        line(lattice.vector.size(), "Number of components");
    }
    if (polynomial) {
        line(static_cast<std::uint64_t>(gf2::degree(lattice.modulus)), "m, of 2^m points");
        line(lattice.modulus, "modulus");
    } else {
        line(lattice.points, "points");
    }
    for (const std::uint64_t component : lattice.vector) text += fmt::format("{}\n", component);
    return {{options[vector_output], std::move(text)}};
}

void check_weights(const Values& options, bool searches, std::string_view searching,
                   std::string_view rule) {
    const bool given = options.given(product_weights);
    const bool decays = options.given(weight_decay);
    if (!searches && (given || decays))
        fail(ErrorKind::usage, "--{} applies to {} only; the rule here is {}",
             given ? product_weights.name : weight_decay.name, searching, rule);
    if (given && decays) fail(ErrorKind::usage, "--weights contradicts --decay; give one of them");
}

std::vector<std::uint64_t> given_components(const Values& options, const VectorFile& file,
                                            const Param<Numbers>& vector, std::size_t dimension,
                                            double least, double most, std::string_view range) {
    std::vector<double> numbers = options[vector];
    numbers.insert(numbers.end(), file.vector.begin(), file.vector.end());
    const std::string who = options.given(vector) ? "--vector" : options[vector_file];
    std::vector<std::uint64_t> components;
    for (const double z : numbers) {
        if (!(z >= least && z <= most && z == std::floor(z)))
            fail(ErrorKind::usage, "{}: {} is not {}", who, z, range);
        components.push_back(static_cast<std::uint64_t>(z));
    }
    if (components.size() < dimension)
        fail(ErrorKind::usage, "{}: {} components are too few for dimension {}", who,
             components.size(), dimension);
    components.resize(dimension);
    return components;
}

std::vector<double> weights_of(const Values& options, std::size_t dimension) {
    std::vector<double> found = options.given(product_weights)
                                    ? options[product_weights]
                                    : decaying_weights(options[weight_decay], dimension);
    if (found.size() < dimension)
        fail(ErrorKind::usage, "--weights: {} numbers for {} coordinates; give one for each",
             found.size(), dimension);
    for (const double weight : found)
        if (!(weight > 0 && weight <= 1e6))
            fail(ErrorKind::usage, "--weights: {} is outside (0, 1000000]", weight);
    found.resize(dimension);
    return found;
}

}  // namespace stipple
