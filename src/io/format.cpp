// SPDX-License-Identifier: MIT
#include "io/format.hpp"
