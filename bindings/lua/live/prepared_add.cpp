// The same for both threads: but for where files are read through and code is kept.
#include "bindings/lua/live/prepared_add.hpp"

#include <utility>
#include <variant>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/robot_file.hpp"

namespace nezumi {
namespace {

Expected<void> prepare_robot(RobotEntry& robot, SystemSpec& part, const Project& project, PreparedAdd& prepared) {
    const std::string described = robot.described_by();
    if (!part.models.contains(described)) {
        const auto path = project.find(FileKind::model, robot.model, robot.place.file);
        if (!path) return Unexpected(path.error());
        auto model = read_changed_robot(*path, robot.changes, project, &part.files);
        if (!model) return Unexpected(model.error());
        part.models.emplace(described, std::move(*model));
    }
    prepared.models.emplace(described, part.models.at(described));
    if (robot.calibrated) {
        if (auto used = use_calibration(part, robot, project, {.is_needed = true, .serial = ""}); !used) return used;
        prepared.models.insert_or_assign(robot.described_by(), part.models.at(robot.described_by()));
    }
    prepared.files = std::move(part.files);
    return {};
}

}  // namespace

Expected<PreparedAdd> AddPreparer::here(const Entry& entry, SystemSpec part) const {
    PreparedAdd prepared{.given = entry, .entry = entry, .start = start};
    if (auto* robot = std::get_if<RobotEntry>(&prepared.entry)) {
        if (auto ok = prepare_robot(*robot, part, settings.project, prepared); !ok) return Unexpected(ok.error());
    }
    if (const auto* behavior = std::get_if<BehaviorEntry>(&prepared.entry)) {
        auto made = make_behavior(*behavior, context, settings);
        if (!made) {
            const Error& error = made.error();
            return failure(error.message, error.place.file.empty() ? behavior->place : error.place);
        }
        prepared.behavior = std::move(*made);
    }
    return prepared;
}

Expected<PreparedAdd> AddPreparer::beside(const Entry& entry, SystemSpec part, NotedFiles& files) const {
    auto chunks = std::make_unique<ChunkCache>();
    AddPreparer with_notes = *this;
    with_notes.settings.project = settings.project.through(files);
    with_notes.settings.chunks = chunks.get();
    auto prepared = with_notes.here(entry, std::move(part));
    if (!prepared) return prepared;
    // The notes end with this thread's work.
    if (auto* script = dynamic_cast<ScriptComponent*>(prepared->behavior.get()))
        script->script().settle(modules_of(settings.project), settings.chunks);
    prepared->chunks = std::move(chunks);
    prepared->seen = files.take();
    return prepared;
}

}  // namespace nezumi
