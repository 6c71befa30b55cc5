// Files of other programs in a system file: `csv`, `map`, and calibrations of cameras.
#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "engine/world/arena_fields.hpp"
#include "engine/world/csv_map.hpp"
#include "engine/world/occupancy_map.hpp"
#include "engine/world/ros_calibration.hpp"

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

// Reads a map of ROS. The picture is searched beside the YAML file that names it.
Expected<std::vector<BoxSpec>> SystemWords::read_ros_map(const WordCall& call, const Value& value) {
    double height = occupancy_height;
    const Value* name = &value;
    if (const FileTable* table = value.get_if<FileTable>(); table != nullptr && !table->elements.empty()) {
        FieldCheck check(call.word, call.word, call.place, call.source);
        Fields fields(check, value);
        name = &fields.elements().front();
        fields.number("height", height, {.range = NumberRange::positive, .least = least_length}, "m");
        fields.done();
        if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    }
    const auto file = read_file(call, *name);
    if (!file) return Unexpected(file.error());
    const auto facts = read_occupancy_facts(file->text, file->shown);
    if (!facts) return Unexpected(facts.error());
    if (!decodes_pictures()) {
        notes_.push_back(
            fmt::format("{}: not read: this build of nezumi has no simulation and needs no boxes", file->shown));
        return std::vector<BoxSpec>{};
    }
    const auto picture = read_file({"image", facts->image_place, nullptr}, facts->image, file->path);
    if (!picture) return Unexpected(picture.error());
    auto map = read_occupancy(*facts, picture->text, picture->shown, height, call.place);
    if (!map) return Unexpected(map.error());
    notes_.push_back(describe(*map, file->shown));
    return std::move(map->boxes);
}

// Sets the parameters of a camera from a calibration file of ROS. Values of the system file override it, but width and
// height must be equal.
Expected<void> SystemWords::use_ros_calibration(const WordCall& call, const FieldCheck& check, ComponentEntry& entry) {
    const Place place = check.place_of({"calibration"});
    const auto refuse = [&](std::string_view why) {
        return failure(fmt::format("component '{}': calibration: {}", entry.name, why), place);
    };
    if (entry.type != "Camera") return refuse(fmt::format("is for a Camera, not for a {}", entry.type));
    const auto file = read_file({"calibration", place, call.source}, std::exchange(entry.calibration, ""));
    if (!file) return Unexpected(file.error());
    const auto intrinsics = read_ros_calibration(file->text, file->shown);
    if (!intrinsics) return Unexpected(intrinsics.error());
    std::string other;
    for_each_field(*intrinsics, [&](const auto& field, const auto& value) {
        const std::string parameter(field.name);
        if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(value)>>) {
            const auto [given, is_new] = entry.config.try_emplace(parameter, std::int64_t{value});
            if (!is_new && given->second != Value(std::int64_t{value}))
                other =
                    fmt::format("{} was calibrated with {} = {}: set it to this value, or calibrate the camera again",
                                file->shown, parameter, value);
        } else {
            entry.config.try_emplace(parameter, value);
        }
    });
    if (!other.empty()) return refuse(other);
    return {};
}

}  // namespace nezumi
