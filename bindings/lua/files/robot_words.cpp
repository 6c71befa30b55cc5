// The robots of a system file: their models and their changes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "engine/records/read_record.hpp"
#include "engine/system/system_fields.hpp"

namespace nezumi {
namespace {

// Returns the fields of robot files that a robot's table in a system file has, and marks them as known.
Value take_changes(Fields& fields) {
    FileTable changes;
    for (const Type::Field& field : record_of<RobotSpec>().fields) {
        const Value* value = field.name != "base" ? fields.field(field.name) : nullptr;
        if (value != nullptr) changes.fields.push_back({field.name, *value});
    }
    std::sort(changes.fields.begin(), changes.fields.end(),
              [](const FileField& a, const FileField& b) { return a.name < b.name; });
    if (changes.fields.empty()) return {};
    return {std::move(changes)};
}

// The hint for an unknown field `config`: the parameters of a robot are fields of its description.
std::string hint_for_robot(std::string_view name) {
    if (name != "config") return "";
    return ": write fields of its description, as in actuators = { medium_motor = { speed = 2 } }";
}

}  // namespace

Expected<RobotEntry> SystemWords::read_robot(const WordCall& call, const std::string& name, const Value& value) {
    FieldCheck check = check_of(call, value, name);
    Fields fields(check, value);
    RobotEntry entry;
    entry.name = name;
    entry.place = call.place;
    read_record(fields, entry);
    const Value changes = take_changes(fields);
    fields.done(hint_for_robot);
    if (check.ok()) {
        auto loaded = load_model(call, entry.model);
        if (loaded && !changes.is_nothing()) loaded = describe_changed(check, call, entry, changes);
        if (!loaded) {
            Error error = loaded.error();
            if (error.place.file.empty())
                return failure(fmt::format("robot '{}': {}", name, error.message), check.place_of({"model"}));
            return Unexpected(std::move(error));
        }
    }
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    note_degrees(check, call, fmt::format("robot '{}'", name), "pose.heading", entry.pose.heading);
    return entry;
}

// Adds a note about an angle that is probably in degrees: from 30 to 360, and a multiple of 15.
void SystemWords::note_degrees(const FieldCheck& check, const WordCall& call, std::string_view what,
                               std::string_view field, double radians) {
    const double size = std::abs(radians);
    if (size < 30 || size > 360 || std::fmod(size, 15) != 0) return;
    FieldPath path;
    for (std::string_view rest = field; !rest.empty();) {
        const std::size_t dot = std::min(rest.find('.'), rest.size());
        path.emplace_back(rest.substr(0, dot));
        rest.remove_prefix(std::min(dot + 1, rest.size()));
    }
    Place place = check.place_of(path);
    if (place.file.empty()) place = call.place;
    notes_.push_back(
        describe(Error{fmt::format("{}: field '{}' is {:g} rad, more than a turn: were degrees meant? Write "
                                   "math.rad({:g})",
                                   what, field, radians, radians),
                       std::move(place)}));
}

Expected<void> SystemWords::load_model(const WordCall& call, const std::string& model) {
    const auto file = find_file(call, FileKind::model, model);
    if (!file) return Unexpected(file.error());
    const auto known = spec_.models.find(model);
    if (known != spec_.models.end()) {
        if (known->second.place.file == file->shown) return {};
        return failure(fmt::format("model '{}' is {} here, and {} for an earlier robot: rename one of these files",
                                   model, file->shown, known->second.place.file));
    }
    const auto robot = robot_file(call, model);
    if (!robot) return Unexpected(robot.error());
    spec_.models.emplace(model, (*robot)->spec());
    return {};
}

Expected<RobotFile*> SystemWords::robot_file(const WordCall& call, const std::string& model) {
    const auto file = find_file(call, FileKind::model, model);
    if (!file) return Unexpected(file.error());
    std::unique_ptr<RobotFile>& kept = robot_files_[file->shown];
    if (kept == nullptr) {
        auto robot = RobotFile::read(file->path, project_);
        if (!robot) return Unexpected(robot.error());
        kept = std::move(*robot);
        for (const std::string& read : kept->files()) note_file(read);
    }
    return kept.get();
}

// Gives a robot a description with its changes. Robots with the same model and changes share a description.
Expected<void> SystemWords::describe_changed(FieldCheck& check, const WordCall& call, RobotEntry& entry,
                                             const Value& changes) {
    const auto file = robot_file(call, entry.model);
    if (!file) return Unexpected(file.error());
    RobotSpec robot = (*file)->changed(check, changes, call.place.file);
    if (!check.ok()) return {};
    for (const std::string& read : (*file)->files()) note_file(read);
    entry.changes = to_lua(changes);
    entry.description = entry.model + " " + entry.changes;
    spec_.models.insert_or_assign(entry.description, std::move(robot));
    return {};
}

}  // namespace nezumi
