// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::npy_test {

using namespace std::string_literals;

namespace {

/// Header written by numpy.save (1.24).
std::string numpy_header(std::string dictionary) {
    dictionary.resize(117, ' ');
    return "\x93NUMPY\x01\0v\0"s + dictionary + "\n";
}

// numpy.save of [[0, 0.5], [0.1, 1/3], [0.999, -2e-300]], as written by NumPy.
const std::string numpy_file =
    numpy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }") +
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xe0?"
    "\x9a\x99\x99\x99\x99\x99\xb9?UUUUUU\xd5?"
    "+\x87\x16\xd9\xce\xf7\xef?Y\xf3\xf8\xc2\x1fn\xb5\x81"s;
const PointSet numpy_points = points_of({{0, 0.5}, {0.1, 1.0 / 3}, {0.999, -2e-300}});

std::string refused(std::string_view bytes, const ReadOptions& options = {}) {
    return refusal("npy", bytes, options);
}

}  // namespace

TEST(Npy, WritesTheBytesThatNumPyWrites) {
    EXPECT_EQ(written("npy", {numpy_points}), numpy_file);
    EXPECT_EQ(written("npy", {points_of({{1, 2}, {3, -4}})}, {.single = true}),
              numpy_header("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }") +
                  "\0\0\x80?\0\0\0@\0\0@@\0\0\x80\xc0"s);
    const std::string sets = written("npy", {numpy_points, numpy_points});
    EXPECT_EQ(sets.substr(0, 128),
              numpy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3, 2), }"));
    EXPECT_EQ(sets.substr(128), numpy_file.substr(128) + numpy_file.substr(128));
}

TEST(Npy, HeaderIsPaddedTo64Bytes) {
    for (const std::size_t count : {1U, 99U, 12345U}) {
        const std::string file = written("npy", {random_points(count, 1)}, {.extras = {}});
        EXPECT_EQ((file.size() - 8 * count) % 64, 0U);
        EXPECT_EQ(file[file.size() - 8 * count - 1], '\n');
    }
}

TEST(Npy, ReadsBack) {
    const std::vector<PointSet> sets{random_points(100, 3, 1), random_points(100, 3, 2)};
    EXPECT_EQ(read_as("npy", written("npy", sets)), sets);
    EXPECT_EQ(read_as("npy", numpy_file).at(0), numpy_points);
    EXPECT_EQ(read_as("npy", numpy_file, {.columns = {"y"}}).at(0),
              points_of({{0.5}, {1.0 / 3}, {-2e-300}}));
}

TEST(Npy, SingleNeverHoldsOne) {
    const std::string file = written("npy", {points_of({{1 - 0x1p-53, 0.1}})}, {.single = true});
    const PointSet back = read_as("npy", file).at(0);
    EXPECT_EQ(back[0][0], 1 - 0x1p-24);
    EXPECT_LE(back[0][1], 0.1);
}

// The arrays below were also saved by NumPy.
TEST(Npy, ReadsOtherOrdersAndTypes) {
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2), }") +
                           "\x00\x00\x00\x00\x00\x00\x00\x00\x9a\x99\x99\x99\x99\x99\xb9?"
                           "+\x87\x16\xd9\xce\xf7\xef?\x00\x00\x00\x00\x00\x00\xe0?"
                           "UUUUUU\xd5?Y\xf3\xf8\xc2\x1fn\xb5\x81"s)
            .at(0),
        numpy_points);
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '>f8', 'fortran_order': False, 'shape': (3, 2), }") +
                           "\x00\x00\x00\x00\x00\x00\x00\x00?\xe0\x00\x00\x00\x00\x00\x00"
                           "?\xb9\x99\x99\x99\x99\x99\x9a?\xd5UUUUUU"
                           "?\xef\xf7\xce\xd9\x16\x87+\x81\xb5n\x1f\xc2\xf8\xf3Y"s)
            .at(0),
        numpy_points);
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '<i4', 'fortran_order': False, 'shape': (2, 2), }") +
                           "\x01\0\0\0\x02\0\0\0\x03\0\0\0\xfc\xff\xff\xff"s)
            .at(0),
        points_of({{1, 2}, {3, -4}}));
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2), }") +
                           "\x01\xff"s)
            .at(0),
        points_of({{1, 255}}));
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '|b1', 'fortran_order': False, 'shape': (1, 2), }") +
                           "\x01\0"s)
            .at(0),
        points_of({{1, 0}}));
    EXPECT_EQ(
        read_as("npy", numpy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }") +
                           "\0\0\0\0\0\0\xd0?\0\0\0\0\0\0\xe0?"s)
            .at(0),
        points_of({{0.25}, {0.5}}));
}

// numpy.asfortranarray(numpy.arange(12.).reshape(2, 3, 2) / 16): stored in the order, times 16, 0 6
// 2 8 4 10 1 7 3 9 5 11.
TEST(Npy, ReadsSetsInColumnMajorOrder) {
    PointSet stored(12, 1);
    const std::vector<double> order{0, 6, 2, 8, 4, 10, 1, 7, 3, 9, 5, 11};
    for (std::size_t i = 0; i < 12; ++i) stored[i][0] = order[i] / 16;
    const std::string file =
        numpy_header("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3, 2), }") +
        written("bin", {stored});
    const auto sets = read_as("npy", file);
    ASSERT_EQ(sets.size(), 2U);
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ(sets[i / 6].flat()[i % 6], static_cast<double>(i) / 16);
}

TEST(Npy, ReadsLaterVersions) {
    const std::string header = numpy_file.substr(10, 118);
    for (const char version : {'\2', '\3'})
        EXPECT_EQ(
            read_as("npy", "\x93NUMPY"s + version + "\0v\0\0\0"s + header + numpy_file.substr(128))
                .at(0),
            numpy_points);
}

TEST(Npy, RefusesEveryTruncationAndWhatFollows) {
    for (std::size_t size = 0; size < numpy_file.size(); ++size)
        EXPECT_NE(refused(std::string_view(numpy_file).substr(0, size)), "") << size;
    EXPECT_EQ(refused(numpy_file.substr(0, 170)),
              "input: p: byte 170: the file ends too soon; expected 48 bytes of numbers, found 42");
    EXPECT_EQ(refused(numpy_file + "junk"),
              "input: p: byte 176: 4 bytes follow the numbers; expected the end of the file");
    EXPECT_EQ(refused(numpy_file.substr(0, 100)),
              "input: p: byte 100: the header is cut off; expected 118 bytes of it");
    EXPECT_EQ(refused("x,y\n1,2\n"),
              "input: p: byte 0: not an npy file; expected the bytes \\x93NUMPY");
}

TEST(Npy, RefusesWhatHoldsNoPoints) {
    const auto header = [](const std::string& type, const std::string& shape) {
        return numpy_header("{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape +
                            ", }");
    };
    EXPECT_EQ(
        refused(header("'<c16'", "(1, 1)")),
        "input: p: byte 10: numbers of type '<c16'; expected float64, float32, integers or bool");
    EXPECT_EQ(
        refused(header("'<f2'", "(1, 1)")),
        "input: p: byte 10: numbers of type '<f2'; expected float64, float32, integers or bool");
    EXPECT_EQ(refused(header("'<f8'", "(0, 2)")),
              "input: p: byte 10: an array of shape (0, 2) holds no points");
    EXPECT_EQ(refused(header("'<f8'", "()")),
              "input: p: byte 10: an array of shape (); expected (n,), (n, d) or (sets, n, d)");
    EXPECT_EQ(refused(header("'<f8'", "(1, 1, 1, 1)")),
              "input: p: byte 10: an array of shape (1, 1, 1, 1); expected (n,), (n, d) or (sets, "
              "n, d)");
    EXPECT_EQ(refused(header("'<f8'", "(9000000000000000000, 9000000000000000000)")),
              "input: p: byte 128: the shape is larger than any file");
    EXPECT_EQ(
        refused(header("'<f8'", "(-1, 2)")),
        "input: p: byte 10: the header's shape is not a tuple of whole numbers such as (1024, 2)");
    EXPECT_EQ(refused(numpy_header("{'descr': '<f8'}")),
              "input: p: byte 10: the header has no 'shape'");
    EXPECT_NE(refused(header("[('x', '<f8')]", "(1,)")), "");
    EXPECT_EQ(refused(numpy_file, {.dimension = 3}),
              "input: p: points have 2 coordinates; --dimension is 3 | --column picks columns by "
              "name or number");
}

TEST(Npy, RefusesNumbersThatAreNotFinite) {
    std::string file = numpy_file;
    file.replace(128 + 24, 8, "\0\0\0\0\0\0\xf0\x7f"s);
    EXPECT_EQ(refused(file), "input: p: byte 152: inf in point 1; expected finite numbers");
}

}  // namespace stipple::testing::npy_test
