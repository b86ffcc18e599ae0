// SPDX-License-Identifier: MIT
//
// Files written by tests. Their names contain the process and the object, because tests run in
// parallel.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace stipple::testing {

/// A file that is removed with the object.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string_view bytes, const std::string& extension = "") {
        static std::atomic<int> made{0};
        path_ =
            (std::filesystem::temp_directory_path() /
             ("stipple-" + std::to_string(::getpid()) + "-" + std::to_string(made++) + extension))
                .string();
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path_); }

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string bytes() const {
        std::ostringstream all;
        all << std::ifstream(path_, std::ios::binary).rdbuf();
        return all.str();
    }

  private:
    std::string path_;
};

}  // namespace stipple::testing
