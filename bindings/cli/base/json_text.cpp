// Characters are escaped by nlohmann-json.
#include "bindings/cli/base/json_text.hpp"

#include <nlohmann/json.hpp>

#include "engine/base/json_text.hpp"

namespace nezumi::cli {

std::string json_text(std::string_view text) { return nezumi::json_text(nlohmann::json(text)); }

}  // namespace nezumi::cli
