// The contents of files as JSON. The text of a file is a plain string, to save space: most of a journal is the text of
// files.
#include "bindings/journal/files_json.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "bindings/journal/value_json.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const PathSeen& found) {
    if (found.what.empty()) return nullptr;
    if (found.text) return text_to_json(*found.text);
    Json json{{"is", found.what}};
    if (!found.unreadable.empty()) json["error"] = text_to_json(found.unreadable);
    if (found.names) json["names"] = Json::array();
    for (const std::string& name : found.names.value_or(std::vector<std::string>()))
        json["names"].push_back(text_to_json(name));
    return json;
}

// Reads a text. Returns whether `json` is one.
bool read(const Json& json, std::string& out) {
    auto text = text_from_json(json);
    if (text) out = std::move(*text);
    return text.has_value();
}

std::optional<PathSeen> path_from_json(const Json& json) {
    PathSeen found;
    if (json.is_null()) return found;
    if (!json.is_object() || !json.contains("is")) {
        found.what = "a file";
        return read(json, found.text.emplace()) ? std::optional(std::move(found)) : std::nullopt;
    }
    if (!read(json["is"], found.what)) return std::nullopt;
    if (json.contains("error") && !read(json["error"], found.unreadable)) return std::nullopt;
    if (!json.contains("names")) return found;
    if (!json["names"].is_array()) return std::nullopt;
    found.names.emplace();
    for (const Json& name : json["names"]) {
        if (!read(name, found.names->emplace_back())) return std::nullopt;
    }
    return found;
}

}  // namespace

Json files_to_json(const FilesSeen& seen) {
    Json json = Json::object();
    for (const auto& [path, found] : seen) json[text_to_key(path.string())] = to_json(found);
    return json;
}

std::optional<FilesSeen> files_from_json(const Json& json) {
    if (!json.is_object()) return std::nullopt;
    FilesSeen seen;
    for (const auto& [path, found] : json.items()) {
        auto read = path_from_json(found);
        auto name = text_from_key(path);
        if (!read || !name) return std::nullopt;
        seen.emplace(std::move(*name), std::move(*read));
    }
    return seen;
}

}  // namespace nezumi
