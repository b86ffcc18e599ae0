// SPDX-License-Identifier: MIT
#include "core/bytes/file_rules.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/utf8.hpp"

namespace stipple {
namespace {

const FileRules* rules = nullptr;  // none: all that the user may

}  // namespace

FileRules::FileRules(std::map<std::string, std::string> readable, std::vector<std::string> writable)
    : readable_(std::move(readable)), writable_(std::move(writable)) {
    rules = this;
}

FileRules::~FileRules() { rules = nullptr; }

const std::string& FileRules::readable(const std::string& path) {
    if (rules == nullptr) return path;
    const auto it = rules->readable_.find(path);
    if (it == rules->readable_.end())
        fail_with_hint(ErrorKind::usage, "--input FILE names a file that may be read",
                       "it names the file {}, which is not read for that alone", shown(path));
    return it->second;
}

void FileRules::require_writable(const std::string& path) {
    if (rules == nullptr || std::ranges::find(rules->writable_, path) != rules->writable_.end())
        return;
    fail(ErrorKind::usage, "it names the file {}, which is not written: only --output is",
         shown(path));
}

}  // namespace stipple
