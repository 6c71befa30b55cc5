// One writer and one reader for all described types, and special code for the few others.
#include "bindings/journal/act_json.hpp"

#include <fmt/format.h>

#include <cassert>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bindings/journal/value_json.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

// Writes an entry as the text of a system file, and the path of its file, in whose folder names are searched.
Json write_entry(const Entry& entry, const ScriptHost& scripts) {
    SystemSpec spec;
    spec.entries.push_back(entry);
    return Json{{"lua", text_to_json(scripts.write_system_text(spec, "An entry."))},
                {"file", text_to_json(place_of(entry).file)}};
}

// The text of a system file with this marker.
Json write_marker(const MarkerSpec& marker, const ScriptHost& scripts) {
    SystemSpec spec;
    spec.arena.markers.push_back(marker);
    return Json{{"lua", text_to_json(scripts.write_system_text(spec, "A marker."))},
                {"file", text_to_json(marker.place.file)}};
}

// Reads what `write_entry` or `write_marker` has written; `part` returns the parts of this kind in a system.
template <class T, class Part>
std::string read_part(const Json& json, T& out, const PartReader& parts, std::string_view what, const Part& part) {
    if (!json.is_object() || !json.contains("lua") || !json.contains("file"))
        return expected_in_json(fmt::format("{}'s lua and file", what), json);
    const auto text = text_from_json(json["lua"]);
    if (!text) return text.error().message;
    const auto file = text_from_json(json["file"]);
    if (!file) return file.error().message;
    auto spec = parts.read(*text, *file);
    if (!spec) return describe(spec.error());
    auto& all = part(*spec);
    if (all.size() != 1) return fmt::format("expected {}, got {}", what, all.size());
    out = std::move(all.front());
    return "";
}

// Special forms for entries and markers, which have no `Describe`.
OtherForms forms_with(const ScriptHost& scripts) {
    return {.write = [&scripts](const ValueView& value) {
        if (value.type == &type_of<Entry>()) return write_entry(value.as<Entry>(), scripts);
        assert(value.type == &type_of<MarkerSpec>());
        return write_marker(value.as<MarkerSpec>(), scripts);
    }};
}

OtherForms forms_with(const PartReader& parts) {
    return {.read =
                [&parts](const Json& json, const ValuePlace& out) {
                    const auto entries = [](SystemSpec & spec) -> auto& { return spec.entries; };
                    const auto markers = [](SystemSpec & spec) -> auto& { return spec.arena.markers; };
                    if (out.type == &type_of<Entry>())
                        return read_part(json, out.as<Entry>(), parts, "an entry", entries);
                    assert(out.type == &type_of<MarkerSpec>());
                    return read_part(json, out.as<MarkerSpec>(), parts, "a marker", markers);
                },
            .message = [&parts](const std::string& name) { return parts.find_message(name); }};
}

// The act with this name and default values; nothing if there is no such act.
template <std::size_t index = 0>
std::optional<Act> empty_act(std::string_view name) {
    if constexpr (index == std::variant_size_v<Act>) {
        return std::nullopt;
    } else {
        using Kind = std::variant_alternative_t<index, Act>;
        return Describe<Kind>::name == name ? std::optional<Act>(Kind{}) : empty_act<index + 1>(name);
    }
}

}  // namespace

Json to_json(const Act& act, const ScriptHost& scripts) {
    return std::visit([&](const auto& each) { return value_to_json(each, forms_with(scripts)); }, act);
}

Expected<Act> act_from_json(std::string_view name, const Json& fields, const PartReader& parts) {
    std::optional<Act> act = empty_act(name);
    if (!act) return failure(fmt::format("there is no act (change of the running system) '{}'", shown(name)));
    const std::string wrong = std::visit([&](auto& each) { return read_value(fields, each, forms_with(parts)); }, *act);
    if (!wrong.empty()) return failure(fmt::format("{}: {}", name, wrong));
    return std::move(*act);
}

}  // namespace nezumi
