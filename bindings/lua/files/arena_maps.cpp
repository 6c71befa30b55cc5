// The maps of a system file: `csv` and `map`.
#include <fmt/format.h>

#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "engine/world/csv_map.hpp"
#include "engine/world/occupancy_map.hpp"

namespace nezumi {

Expected<SystemWords::ReadFile> SystemWords::read_file(const WordCall& call, const Value& name) {
    const std::string* file = name.get_if<std::string>();
    if (file == nullptr)
        return failure(fmt::format("{}: expected a file's name, got {}", call.word, kind_of(name)), call.place);
    return read_file(call, *file, call.place.file);
}

Expected<SystemWords::ReadFile> SystemWords::read_file(const WordCall& call, const std::string& name,
                                                       const std::filesystem::path& named_in) {
    const auto path = project_.find(FileKind::data, name, named_in);
    if (!path) return failure(fmt::format("{}: {}", call.word, path.error().message), call.place);
    auto text = project_.read(*path);
    if (!text) return Unexpected(text.error());
    ReadFile read{*path, project_.shown(*path), std::move(*text)};
    note_file(read.shown);
    return read;
}

Expected<std::vector<BoxSpec>> SystemWords::read_map(const WordCall& call, const Value& name) {
    const auto file = read_file(call, name);
    if (!file) return Unexpected(file.error());
    auto map = nezumi::read_map(file->text, file->shown);
    if (!map) return Unexpected(map.error());
    notes_.push_back(describe(*map, file->shown));
    return std::move(map->boxes);
}

// The picture lies beside the file that names it.
Expected<std::vector<BoxSpec>> SystemWords::read_ros_map(const WordCall& call, const Value& name) {
    const auto file = read_file(call, name);
    if (!file) return Unexpected(file.error());
    const auto facts = read_occupancy_facts(file->text, file->shown);
    if (!facts) return Unexpected(facts.error());
    const auto picture = read_file(call, facts->image, file->path);
    if (!picture) return Unexpected(picture.error());
    auto map = read_occupancy(*facts, picture->text, picture->shown, call.place);
    if (!map) return Unexpected(map.error());
    notes_.push_back(describe(*map, file->shown));
    return std::move(map->boxes);
}

}  // namespace nezumi
