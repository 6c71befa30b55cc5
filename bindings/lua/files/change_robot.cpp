// Reads the robot file again, and applies the changes of the system file and the new ones.
#include "bindings/lua/files/change_robot.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/merge_value.hpp"
#include "bindings/lua/files/robot_file.hpp"

namespace nezumi {

Expected<Value> changes_with(const RobotEntry& robot, const Value& changes, const Project& project) {
    if (robot.changes.empty()) return changes;
    const auto before = read_changes(robot.changes, robot.place.file, project);
    if (!before) return Unexpected(before.error());
    return combine_changes(*before, changes);
}

Expected<void> change_robot(SystemSpec& spec, const std::string& robot, const Value& changes, FieldCheck& check,
                            const Project& project) {
    auto* entry = find_entry<RobotEntry>(spec, robot);
    if (entry == nullptr) {
        return failure(fmt::format("there is no robot '{}'{}", shown(robot),
                                   did_you_mean(robot, entries_of<RobotEntry>(spec), &RobotEntry::name)));
    }
    if (const FileTable* table = changes.get_if<FileTable>(); table != nullptr && table->find("base") != nullptr)
        check.unknown({"base"}, ": it is for robot files");
    const auto path = project.find(FileKind::model, entry->model, entry->place.file);
    if (!path) return Unexpected(path.error());
    const auto file = RobotFile::read(*path, project);
    if (!file) return Unexpected(file.error());
    const auto all = changes_with(*entry, changes, project);
    if (!all) return Unexpected(all.error());
    RobotSpec changed = (*file)->changed(check, *all, entry->place.file);
    if (!check.ok()) return {};
    entry->changes = to_lua(*all);
    entry->description = entry->model + " " + entry->changes;
    spec.models.insert_or_assign(entry->description, std::move(changed));
    if (!entry->calibrated) return {};
    return use_calibration(spec, *entry, project, {.is_needed = true, .serial = ""});
}

}  // namespace nezumi
