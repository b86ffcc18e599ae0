// SPDX-License-Identifier: MIT
#pragma once

#include "math/functions/splitmix64.hpp"

namespace stipple {

using Mixer = SplitMix64;

}  // namespace stipple
