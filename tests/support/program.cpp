// SPDX-License-Identifier: MIT
#include "support/program.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "places.hpp"

namespace stipple::testing {
namespace {

/// Runs a program in `directory`: input from a file, output to pipes.
Outcome execute(const std::vector<std::string>& words, const std::filesystem::path& directory,
                const std::string& input) {
    const auto stdin_file = directory / ".stdin";
    std::ofstream(stdin_file, std::ios::binary) << input;
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (pipe(out.data()) != 0 || pipe(err.data()) != 0) throw std::runtime_error("no pipes left");
    for (const int end : {out[0], out[1], err[0], err[1]}) fcntl(end, F_SETFD, FD_CLOEXEC);
    std::vector<char*> argv;
    for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);

    const int in = open(stdin_file.c_str(), O_RDONLY | O_CLOEXEC);
    std::filesystem::remove(stdin_file);
    const pid_t child = fork();
    if (child == 0) {
        dup2(in, STDIN_FILENO);
        dup2(out[1], STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
        if (chdir(directory.c_str()) != 0) _exit(126);
        execv(argv[0], argv.data());
        _exit(127);
    }
    close(in);
    close(out[1]);
    close(err[1]);

    Outcome outcome;
    std::array<pollfd, 2> open_ends = {{{out[0], POLLIN, 0}, {err[0], POLLIN, 0}}};
    std::array<std::string*, 2> texts = {&outcome.out, &outcome.err};
    std::array<char, 65536> buffer{};
    for (int left = 2; left > 0;) {
        poll(open_ends.data(), open_ends.size(), -1);
        for (std::size_t i = 0; i < 2; ++i) {
            if (open_ends[i].fd < 0 || open_ends[i].revents == 0) continue;
            const ssize_t got = read(open_ends[i].fd, buffer.data(), buffer.size());
            if (got > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(got));
                continue;
            }
            close(open_ends[i].fd);
            open_ends[i].fd = -1;
            --left;
        }
    }
    int status = 0;
    waitpid(child, &status, 0);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

}  // namespace

Sandbox::Sandbox() {
    std::string pattern = (std::filesystem::temp_directory_path() / "stipple_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = pattern;
}

Sandbox::~Sandbox() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

Outcome Sandbox::run(std::vector<std::string> arguments, const std::string& input) const {
    arguments.insert(arguments.begin(), program_path());
    return execute(arguments, path_, input);
}

Outcome Sandbox::shell(const std::string& line, const std::string& input) const {
    const auto directory = std::filesystem::path(program_path()).parent_path().string();
    return execute({"/bin/bash", "-c", "set -o pipefail; PATH=" + directory + ":$PATH; " + line},
                   path_, input);
}

void Sandbox::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
}

std::string Sandbox::read(const std::string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool Sandbox::exists(const std::string& name) const {
    return std::filesystem::exists(path_ / name);
}

std::vector<std::string> Sandbox::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

std::string good(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
}

void expect_refusal(const Outcome& outcome, int code, const std::string& words,
                    const std::string& program) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with(program + ": ")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::HasSubstr(words));
}

}  // namespace stipple::testing
