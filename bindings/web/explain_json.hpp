// An explained execution as JSON for the page.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/live/explain.hpp"

namespace nezumi::web {

nlohmann::ordered_json explanation_to_json(const Explanation& explanation);

}  // namespace nezumi::web
