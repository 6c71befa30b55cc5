// Commands that add components and markers to the running system, as a system file does, and remove them.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

// A copy of the running system's data. Words of system files such as `robot` extend the copy, and may read files while
// ticks go on.
struct Present {
    Project project;
    SystemSpec spec;
};

Present present_of(const RunningSystem& live) { return {live.project(), live.spec()}; }

// An entry that was added in the console has the system's file as its place, without a line.
WordCall call_of(const std::string& word, const Present& present) { return {word, {present.spec.file}, nullptr}; }

// Removes what the console shows anyway: the place, if the error is in the input and not in a script or robot file, and
// the word.
Error as_typed(Error error, const Present& present) {
    if (error.place.file == present.spec.file) error.place = {};
    constexpr std::string_view marker = "marker: ";
    if (error.message.starts_with(marker)) error.message.erase(0, marker.size());
    return error;
}

bool is_taken(const System& system, const std::string& name) {
    const std::vector<std::string> markers = marker_names(system);
    return system.find(name) != nullptr || contains(markers, name);
}

Expected<CommandEnd> add_entry(Session::Parts& parts, const Arguments& arguments, const std::string& word) {
    const auto name = read_file_value(arguments.lua, arguments.index(1));
    if (!name) return Unexpected(name.error());
    if (arguments.count() < 1 || name->get_if<std::string>() == nullptr)
        return failure(fmt::format("expected a name, as in {} \"NAME\" {{ ... }}", word));
    if (arguments.count() < 2) return CommandEnd::table;
    const auto fields = read_file_value(arguments.lua, arguments.index(2));
    if (!fields) return Unexpected(fields.error());
    auto present = parts.at_system([&] {
        return std::make_optional(
            std::pair{present_of(parts.live), is_taken(parts.live.system(), *name->get_if<std::string>())});
    });
    if (!present) return failure("interrupted");
    auto& [at, has_owner] = *present;
    if (has_owner) {
        return failure(fmt::format("the name '{0}' is already used: remove \"{0}\" frees it, or choose another",
                                   shown(*name->get_if<std::string>())));
    }
    FileSnapshot files(at.project.files());
    const Project project = at.project.through(files);
    SystemWords words(project, parts.live.options().peer_words, at.spec);
    auto read = words.entry(call_of(word, at), *name->get_if<std::string>(), *fields);
    if (read) read = words.finish();
    if (!read) return Unexpected(as_typed(read.error(), at));
    const Entry entry = words.spec().entries.back();
    const auto added = parts.act_beside(Add{entry}, files.take());
    if (!added) return Unexpected(as_typed(added.error(), at));
    if (!std::visit([](const auto& each) { return each.active; }, entry)) return CommandEnd::done;
    const auto active = parts.at_system([&] { return std::make_optional(parts.act(Activate{name_of(entry)})); });
    return active ? done(*active) : failure("interrupted");
}

}  // namespace

Expected<CommandEnd> command_behavior(Session::Parts& parts, const Arguments& arguments) {
    return add_entry(parts, arguments, "behavior");
}

Expected<CommandEnd> command_component(Session::Parts& parts, const Arguments& arguments) {
    return add_entry(parts, arguments, "component");
}

Expected<CommandEnd> command_robot(Session::Parts& parts, const Arguments& arguments) {
    return add_entry(parts, arguments, "robot");
}

Expected<CommandEnd> command_marker(Session::Parts& parts, const Arguments& arguments) {
    const auto fields = read_file_value(arguments.lua, arguments.index(1));
    if (!fields) return Unexpected(fields.error());
    if (fields->get_if<FileTable>() == nullptr)
        return failure("expected a table, as in marker { name = \"target\", id = 7, size = 0.1, at = { 1, 0, 0.1 } }");
    auto present = parts.at_system([&] { return std::make_optional(present_of(parts.live)); });
    if (!present) return failure("interrupted");
    SystemWords words(present->project);
    const WordCall call = call_of("marker", *present);
    const auto thing = words.thing(call, *fields);
    if (!thing) return Unexpected(as_typed(thing.error(), *present));
    FileTable only;
    only.elements.push_back({*thing});
    if (auto placed = words.arena(call, {std::move(only)}); !placed)
        return Unexpected(as_typed(placed.error(), *present));
    const MarkerSpec marker = words.spec().arena.markers.back();
    const auto added = parts.at_system([&] { return std::make_optional(parts.act(AddMarker{marker})); });
    if (!added) return failure("interrupted");
    return *added ? Expected<CommandEnd>(CommandEnd::done) : Unexpected(as_typed(added->error(), *present));
}

Expected<CommandEnd> command_remove(Session::Parts& parts, const Arguments& arguments) {
    std::string name;
    if (const auto at = parts.objects->to_component(arguments.lua, 1); at && arguments.has(1)) {
        name = at->component->name();
    } else {
        const auto text = arguments.text(1, "a name, as in remove \"explorer\"");
        if (!text) return Unexpected(text.error());
        name = *text;
    }
    const auto markers =
        parts.live.system().world() != nullptr ? parts.live.system().world()->markers() : std::vector<MarkerPose>();
    const auto is_it = [&](const MarkerPose& marker) { return marker.name == name; };
    const bool is_marker = std::any_of(markers.begin(), markers.end(), is_it);
    if (is_marker && parts.live.system().find(name) == nullptr) return done(parts.act(RemoveMarker{name}));
    const auto removed = parts.act(Remove{name});
    if (!removed) return Unexpected(removed.error());
    if (!removed->notes.empty()) parts.show(fmt::format("{}", fmt::join(removed->notes, "\n")));
    return CommandEnd::done;
}

}  // namespace nezumi
