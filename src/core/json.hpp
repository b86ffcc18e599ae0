// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their keys. Declared only: who looks into one includes
// <nlohmann/json.hpp>.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace stipple {

using Json = nlohmann::ordered_json;

}  // namespace stipple
