// Acts as JSON, written and read by their descriptions.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/base/error.hpp"
#include "engine/live/script_host.hpp"
#include "engine/system/act.hpp"

namespace nezumi {

/// The fields of an act as JSON. Entries and markers are texts, as in a system file.
nlohmann::ordered_json to_json(const Act& act, const ScriptHost& scripts);
/// The act with this name. The error says which field is wrong. `parts` reads entries and markers.
Expected<Act> act_from_json(std::string_view name, const nlohmann::ordered_json& fields, const PartReader& parts);

}  // namespace nezumi
