// SPDX-License-Identifier: MIT
//
// Adapts a method that maps one point at a time to a Mapping. The loop over rows is here, in one
// function that compilers can vectorize.
//
//     struct Method {
//         std::array<double, m> forward(const std::array<double, d>& xi) const;
//         std::array<double, d> inverse(std::span<const double> point) const;   // if not the
//                                                                               // domain's to_cube
//         static constexpr const char* no_way_back;                             // no inverse: why
//         bool keeps(const std::array<double, d>& xi) const;                    // if it drops any
//         double density(std::span<const double> point) const;                  // if not domain's
//     };
//
// If a domain has several methods, those with the domain's own density need no density().
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "core/machine/wide.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {

namespace detail {

template <class Image, std::size_t d, class Method>
struct Arity {
    static constexpr std::size_t cube = d;
    static constexpr std::size_t image = std::tuple_size_v<Image>;
};
template <class Image, std::size_t d, class Method>
Arity<Image, d, Method> arity(Image (Method::*)(const std::array<double, d>&) const);

}  // namespace detail

template <class Method>
using ArityOf = decltype(detail::arity(&Method::forward));

template <class Method>
concept DropsPoints = requires {
    &Method::keeps;
};

template <std::size_t d>
std::array<double, d> row_of(std::span<const double> rows, std::size_t i) {
    std::array<double, d> row;
    for (std::size_t k = 0; k < d; ++k) row[k] = rows[d * i + k];
    return row;
}

/// Points per pass of the loop.
inline constexpr std::size_t rows_at_once = 128;

// Takes the method by value: writes to the image cannot alias it, so its constants stay in
// registers. All calls are inlined, since a call would prevent vectorization of the loop. Images
// are collected in `columns` first; without that, compilers would vectorize each coordinate
// separately, and repeat for each one the computations that all coordinates share.
template <class Method>
STIPPLE_WIDE [[gnu::flatten]] void map_rows(const Method method, std::span<const double> cube,
                                            std::span<double> image) {
    constexpr std::size_t d = ArityOf<Method>::cube;
    constexpr std::size_t m = ArityOf<Method>::image;
    std::array<std::array<double, rows_at_once>, m> columns;
    for (std::size_t first = 0; first < cube.size() / d; first += rows_at_once) {
        const std::size_t size = std::min(rows_at_once, cube.size() / d - first);
        for (std::size_t i = 0; i < size; ++i) {
            const std::array<double, m> point = method.forward(row_of<d>(cube, first + i));
            for (std::size_t k = 0; k < m; ++k) columns[k][i] = point[k];
        }
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < m; ++k) image[m * (first + i) + k] = columns[k][i];
    }
}

/// Inverse of a point of the domain: the method's, or else the domain's.
template <class Known, class Method, std::size_t m>
[[gnu::flatten]] auto row_back(const Known& domain, const Method& method,
                               const std::array<double, m>& point) {
    std::array<double, ArityOf<Method>::cube> xi{};
    if constexpr (requires { &Method::inverse; })
        put_clamped(method.inverse(point), xi);
    else
        domain.to_cube(point, xi);
    return xi;
}

/// Maps rows back into the cube; false if a row is not in the domain. Its loop is like that of
/// map_rows(), with one version: wider vectors would make it 1.2 times as fast, and the program
/// 200 kB larger.
template <class Known, class Method>
STIPPLE_LOOPS [[gnu::flatten]] bool map_rows_back(const Known& domain, const Method& method,
                                                  std::span<const double> image,
                                                  std::span<double> cube) {
    constexpr std::size_t d = ArityOf<Method>::cube;
    constexpr std::size_t m = ArityOf<Method>::image;
    std::array<std::array<double, rows_at_once>, d> columns;
    for (std::size_t first = 0; first < image.size() / m; first += rows_at_once) {
        const std::size_t size = std::min(rows_at_once, image.size() / m - first);
        bool inside = true;
        for (std::size_t i = 0; i < size; ++i)
            inside &= domain.contains(row_of<m>(image, first + i));
        if (!inside) return false;
        for (std::size_t i = 0; i < size; ++i) {
            const auto xi = row_back(domain, method, row_of<m>(image, first + i));
            for (std::size_t k = 0; k < d; ++k) columns[k][i] = xi[k];
        }
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < d; ++k) cube[d * (first + i) + k] = columns[k][i];
    }
    return true;
}

template <class Known, class Method>
class RowMapping final : public Mapping {
  public:
    RowMapping(const std::shared_ptr<Known>& domain, Method method)
        : Mapping(domain, why_no_way_back()), known_(*domain), method_(std::move(method)) {}

    std::size_t cube_dimension() const override { return d; }
    bool drops() const override { return DropsPoints<Method>; }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> keep) const override {
        map_rows(method_, cube, image);
        if constexpr (DropsPoints<Method>)
            for (std::size_t i = 0; i < keep.size(); ++i)
                keep[i] = method_.keeps(row_of<d>(cube, i));
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        check_way_back();
        if (!map_rows_back(known_, method_, image, cube)) expect_inside(image);
    }

    bool biased() const override {
        return requires { &Method::density; };
    }

    double density(std::span<const double> point) const override {
        if constexpr (requires { &Method::density; })
            return known_.contains(point) ? method_.density(point) : 0;
        else
            return known_.density(point);
    }

  private:
    static constexpr std::size_t d = ArityOf<Method>::cube;

    static const char* why_no_way_back() {
        if constexpr (requires { Method::no_way_back; })
            return Method::no_way_back;
        else
            return "";
    }

    const Known& known_;
    Method method_;
};

template <class Known, class Method>
std::unique_ptr<Mapping> row_mapping(const std::shared_ptr<Known>& domain, Method method) {
    return std::make_unique<RowMapping<Known, Method>>(domain, std::move(method));
}

}  // namespace stipple::warps
