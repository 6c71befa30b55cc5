// The same for both threads, but for where files are read through, and that a behaviour is loaded only beside the
// ticks.
#include "engine/live/prepared_add.hpp"

#include <utility>
#include <variant>

namespace nezumi {

Expected<PreparedAdd> AddPreparer::read(const Entry& entry, SystemSpec& part, const Project& through) const {
    PreparedAdd prepared{.given = entry, .entry = entry, .start = start};
    auto* robot = std::get_if<RobotEntry>(&prepared.entry);
    if (robot == nullptr) return prepared;
    const std::string described = robot->described_by();
    if (auto ok = scripts->read_robot(*robot, part, through); !ok) return Unexpected(ok.error());
    for (const std::string& name : {described, robot->described_by()})
        prepared.models.insert_or_assign(name, part.models.at(name));
    prepared.files = std::move(part.files);
    return prepared;
}

Expected<PreparedAdd> AddPreparer::beside(const Entry& entry, SystemSpec part, NotedFiles& files) const {
    const Project with_notes = project.through(files);
    auto prepared = read(entry, part, with_notes);
    if (!prepared) return prepared;
    if (const auto* behavior = std::get_if<BehaviorEntry>(&entry)) {
        auto loaded = load(*behavior, context, with_notes);
        if (!loaded) {
            const Error& error = loaded.error();
            return failure(error.message, error.place.file.empty() ? behavior->place : error.place);
        }
        prepared->behavior = std::move(*loaded);
    }
    prepared->seen = files.take();
    return prepared;
}

}  // namespace nezumi
