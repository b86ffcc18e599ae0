// SPDX-License-Identifier: MIT
#include "io/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "io/feed.hpp"
#include "io/io_support.hpp"
#include "io/output.hpp"
#include "support/system.hpp"

namespace stipple::testing::files_test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

/// A directory for each test, removed at the end.
class Files : public ::testing::Test {
  protected:
    Files() {
        std::string name = (fs::temp_directory_path() / "stipple-files-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~Files() override { fs::remove_all(folder); }

    std::string path(const std::string& name) const { return (folder / name).string(); }

    void put(const std::string& name, std::string_view bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
    }
    std::string get(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    std::string input_error(const std::string& name) const {
        return error_of([&] { io::read_bytes(path(name), {}); });
    }
    std::string output_error(const std::string& name) const {
        return error_of([&] { io::Output{path(name)}; });
    }

    fs::path folder;
};

}  // namespace

TEST_F(Files, InputGivesTheBytes) {
    put("a", "bytes\n");
    EXPECT_EQ(io::read_bytes(path("a"), {}), "bytes\n");
    put("empty", "");
    EXPECT_EQ(io::read_bytes(path("empty"), {}), "");
    if (fs::exists("/proc/self/status")) {  // which has size 0
        EXPECT_FALSE(io::read_bytes("/proc/self/status", {}).empty());
    }
}

TEST_F(Files, InputSaysWhyNot) {
    EXPECT_EQ(input_error("none.csv"), "io: " + path("none.csv") + ": no such file");
    EXPECT_EQ(input_error("."), "io: " + path(".") + ": is a folder, not a file");
    put("a", "");
    EXPECT_EQ(input_error("a/b"), "io: " + path("a/b") + ": a part of its path is not a folder");
    if (::geteuid() != 0) {
        fs::permissions(path("a"), fs::perms::none);
        EXPECT_EQ(input_error("a"), "io: " + path("a") + ": permission denied");
    }
}

TEST_F(Files, InputReadsPipesToTheirEnd) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const std::string bytes(3'000'000, 'x');
    std::jthread writer([&] { std::ofstream(path("pipe")) << bytes; });
    EXPECT_EQ(io::read_bytes(path("pipe"), {}), bytes);
}

// Without checking the stop token, reading a pipe without a writer would never return.
TEST_F(Files, InputStopsWaitingWhenAsked) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    std::stop_source stop;
    std::jthread asker([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        stop.request_stop();
    });
    EXPECT_EQ(error_of([&] { io::read_bytes(path("pipe"), {.stop = stop.get_token()}); }),
              "cancelled: interrupted");
}

TEST_F(Files, InputHonoursTheMemoryLimit) {
    const std::string error =
        error_of([] { io::read_bytes("/dev/zero", {.max_memory = 1 << 20}); });
    EXPECT_TRUE(error.starts_with("limit: the content of /dev/zero needs")) << error;
}

// A file that grows, shrinks or is rewritten while it is read is not one file.
TEST_F(Files, InputThatChangesWhileItIsReadIsNamed) {
    const std::string bytes(3 * io::Feed::front_size, 'x');
    const std::vector<std::function<void()>> changes = {
        [&] { fs::resize_file(path("a"), io::Feed::front_size + 10); },
        [&] { std::ofstream(path("a"), std::ios::app) << "more"; },
        [&] { fs::last_write_time(path("a"), fs::file_time_type::clock::now() + 1h); },
        [] {},
    };
    for (const auto& change : changes) {
        put("a", bytes);
        io::Feed feed(path("a"), {});
        change();
        std::string taken(bytes.size() + 100, '\0');
        const std::string error = error_of([&] { feed.read(taken); });
        const bool last = &change == &changes.back();
        EXPECT_EQ(error, last ? "" : "io: " + path("a") + ": the file changed while it was read");
    }
}

TEST_F(Files, OutputAppearsWhenItIsWhole) {
    {
        io::Output out(path("a.csv"));
        EXPECT_TRUE(out.write("one "));
        EXPECT_TRUE(out.write("two"));
        EXPECT_FALSE(fs::exists(path("a.csv")));
        out.commit();
        EXPECT_EQ(get("a.csv"), "one two");
    }
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, OutputLeavesNothingBehind) {
    put("old.csv", "old");
    {
        io::Output fresh(path("new.csv"));
        io::Output again(path("old.csv"));
        fresh.write("half");
        again.write("half");
    }
    EXPECT_EQ(entries(), 1U);
    EXPECT_EQ(get("old.csv"), "old");
}

// A killed process leaves nothing: until commit() the bytes have no name.
TEST_F(Files, OutputHasNoNameBeforeItIsWhole) {
    SKIP_WITHOUT("/proc/self/fd");
#ifdef O_TMPFILE
    io::Output out(path("a.csv"));
    out.write("half");
    if (::open(folder.c_str(), O_TMPFILE | O_WRONLY, 0600) < 0)
        GTEST_SKIP() << "the file system has no files without a name";
    EXPECT_EQ(entries(), 0U);
#endif
}

TEST_F(Files, OutputsAppearTogetherOrNotAtAll) {
    put("old.csv", "old");
    {
        io::Outputs failing;
        failing.add(path("new.csv")).write("new");
        failing.add(path("old.csv")).write("new");
        EXPECT_NE(error_of([&] { failing.add(path("none/a.csv")); }), "");
    }
    EXPECT_EQ(entries(), 1U);
    EXPECT_EQ(get("old.csv"), "old");

    // If a directory is created at a file's path in the meantime, the file cannot be moved there.
    io::Outputs halfway;
    halfway.add(path("old.csv")).write("new");
    halfway.add(path("folder")).write("new");
    fs::create_directory(path("folder"));
    const std::string error = error_of([&] { halfway.commit(); });
    EXPECT_TRUE(error.starts_with("io: " + path("folder") + ": ")) << error;
    EXPECT_TRUE(error.ends_with("; already written: " + path("old.csv"))) << error;
}

// As many files as a command may write, with fewer file descriptors.
TEST_F(Files, OutputsMayBeMoreThanTheSystemLetsBeOpen) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit few{.rlim_cur = 80, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    {
        io::Outputs many;
        for (int i = 0; i < 200; ++i) many.add(path(std::to_string(i))).write("bytes");
        many.commit();
    }
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_EQ(entries(), 200U);
    EXPECT_EQ(get("199"), "bytes");
}

TEST_F(Files, OutputKeepsTheModeOfWhatItReplaces) {
    const auto mode_of = [&](const char* name) {
        return fs::status(path(name)).permissions() & fs::perms::all;
    };
    put("old.csv", "old");
    fs::permissions(path("old.csv"), fs::perms(06640));  // without setuid and setgid
    io::Output again(path("old.csv"));
    again.write("new");
    again.commit();
    EXPECT_EQ(get("old.csv"), "new");
    EXPECT_EQ(mode_of("old.csv"), fs::perms(0640));

    const mode_t mask = ::umask(027);
    io::Output fresh(path("new.csv"));
    fresh.commit();
    ::umask(mask);
    EXPECT_EQ(mode_of("new.csv"), fs::perms(0640));
}

TEST_F(Files, OutputReplacesWhatALinkPointsTo) {
    fs::create_directory(path("data"));
    put("data/real.csv", "old");
    fs::create_symlink("data/real.csv", path("link.csv"));
    fs::create_symlink("data/later.csv", path("dangling.csv"));
    for (const char* name : {"link.csv", "dangling.csv"}) {
        io::Output out(path(name));
        out.write("new");
        out.commit();
        EXPECT_TRUE(fs::is_symlink(path(name)));
    }
    EXPECT_EQ(get("data/real.csv"), "new");
    EXPECT_EQ(get("data/later.csv"), "new");
}

TEST_F(Files, OutputSaysWhyNot) {
    EXPECT_EQ(output_error("none/a.csv"), "io: " + path("none/a.csv") + ": there is no folder '" +
                                              path("none").substr(0, 32) +
                                              (path("none").size() > 32 ? "...'" : "'"));
    EXPECT_EQ(output_error("."), "io: " + path(".") + ": is a folder, not a file");
    put("protected.csv", "old");
    fs::permissions(path("protected.csv"), fs::perms(0444));
    EXPECT_EQ(output_error("protected.csv"),
              "io: " + path("protected.csv") + ": the file is read-only");
    EXPECT_EQ(output_error("protected.csv/a"),
              "io: " + path("protected.csv/a") + ": a part of its path is not a folder");
    EXPECT_EQ(get("protected.csv"), "old");
    EXPECT_TRUE(
        error_of([] { io::Output{"/proc/stipple.csv"}; }).starts_with("io: /proc/stipple.csv: "));
    EXPECT_EQ(error_of([] { io::Output{""}; }),
              "io: the output's name is empty; expected a file name");
    if (::geteuid() != 0) {
        fs::create_directory(path("closed"));
        fs::permissions(path("closed"), fs::perms(0555));
        EXPECT_EQ(output_error("closed/a.csv"),
                  "io: " + path("closed/a.csv") + ": permission denied");
    }
}

TEST_F(Files, AFullDiskIsAnError) {
    SKIP_WITHOUT("/dev/full");
    EXPECT_EQ(error_of([] {
                  io::Output out("/dev/full");
                  out.write("bytes");
              }),
              "io: /dev/full: no space left on the device");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    io::Output null("/dev/null");
    EXPECT_TRUE(null.write("bytes"));
    null.commit();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, AClosedPipeIsNotAnError) {
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
    io::Output out(path("pipe"));
    EXPECT_TRUE(out.write("read me"));
    ::close(reader);
    EXPECT_FALSE(out.write("too late"));
    EXPECT_FALSE(out.write("still"));
    out.commit();
    std::signal(SIGPIPE, before);
}

TEST_F(Files, ReadPointsKnowsTheFormat) {
    const PointSet points = random_points(10, 2);
    for (const char* format : {"csv", "txt", "json", "jsonl", "npy"}) {
        const std::string bytes = written(format, {points});
        put(std::string("a.") + format, bytes);
        put("without", bytes);
        put("lying.csv", bytes);
        for (const char* name : {"without", "lying.csv"})
            EXPECT_EQ(io::read_points(path(name), {}, {}), std::vector{points}) << format;
        EXPECT_EQ(io::read_points(path(std::string("a.") + format), {}, {}), std::vector{points});
    }
    put("a.psa", written("psa", {points}));
    EXPECT_EQ(io::read_points(path("a.psa"), {}, {}, &io::format_named("psa")).at(0), points);
    put("a.f32", written("bin", {points_of({{1, 2}})}, {.single = true}));
    EXPECT_EQ(io::read_points(path("a.f32"), {.dimension = 2}, {}).at(0), points_of({{1, 2}}));
    put("lines.json", written("jsonl", {points}));
    EXPECT_EQ(io::read_points(path("lines.json"), {}, {}).at(0), points);
}

TEST_F(Files, ReadPointsNamesTheFile) {
    put("a.csv", "x\nword\n");
    EXPECT_EQ(error_of([&] { io::read_points(path("a.csv"), {}, {}); }),
              "input: " + path("a.csv") +
                  ":2:1: 'word' is not a number; expected one such as 0.5 or 1e-3");
    put("a.ply", "ply\n");
    EXPECT_EQ(error_of([&] { io::read_points(path("a.ply"), {}, {}); }),
              "usage: " + path("a.ply") +
                  ": ply can only be written; formats that can be read: bin, csv, json, jsonl, "
                  "npy, psa, tsv, txt, utk");
}

// The program ends without destructors if memory for a JSON value's destructor is missing.
TEST_F(Files, PartsCanBeRemovedWithoutDestructors) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit few{.rlim_cur = 80, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);  // files have names, as none is left to spare
    io::Outputs many;
    for (int i = 0; i < 30; ++i) many.add(path(std::to_string(i))).write("bytes");
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_GT(entries(), 0U);
    io::PartFiles::remove_all();
    EXPECT_EQ(entries(), 0U);
}

}  // namespace stipple::testing::files_test
