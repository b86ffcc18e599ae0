// SPDX-License-Identifier: MIT
//
// Tests for features that only some systems have: /dev/full, which is always full, and /proc are
// Linux's.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

/// Skips a test if the file does not exist.
#define SKIP_WITHOUT(file) \
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "this system has no " << (file)
