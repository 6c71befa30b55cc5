// Markers. Cameras read them from the world for each picture, so a marker may appear or vanish at any tick.
#include "sim/markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "engine/world/arena_fields.hpp"
#include "sim/ode_world.hpp"
#include "sim/picture.hpp"

namespace nezumi::sim {
namespace {

auto find_marker(std::vector<MarkerPose>& markers, std::string_view name) {
    return std::find_if(markers.begin(), markers.end(), [&](const MarkerPose& each) { return each.name == name; });
}

Unexpected no_marker(std::string_view name, const std::vector<MarkerPose>& markers) {
    return failure(
        fmt::format("there is no marker '{}'{}", shown(name), did_you_mean(name, markers, &MarkerPose::name)));
}

}  // namespace

Expected<void> check_marker(const MarkerSpec& marker) {
    if (marker.id < 0 || marker.id >= tag_count) {
        return failure(
            fmt::format("marker '{}': there is no tag {}: tags go from 0 to {}", marker.name, marker.id, tag_count - 1),
            marker.place);
    }
    return check_record(marker, marker.place);
}

MarkerPose pose_of(const MarkerSpec& marker) {
    return {.name = marker.name,
            .id = marker.id,
            .size = marker.size,
            .pose = {.position = marker.at, .orientation = {.y = marker.facing}}};
}

std::vector<MarkerPose> OdeWorld::markers() const { return markers_; }

std::vector<std::string> OdeWorld::marker_cells(int id) const {
    if (id < 0 || id >= tag_count) return {};
    constexpr int margin = (tag_cells - tag_border_cells) / 2;
    const Picture tag = paint_tag(id);
    std::vector<std::string> rows(tag_border_cells);
    for (int row = 0; row < tag_border_cells; ++row) {
        for (int column = 0; column < tag_border_cells; ++column) {
            const auto at = static_cast<std::size_t>((row + margin) * tag.width + column + margin);
            rows[static_cast<std::size_t>(row)] += (tag.pixels[at] & 0xff) < 0x80 ? '0' : '1';
        }
    }
    return rows;
}

Expected<void> OdeWorld::move_marker(std::string_view name, const Pose3D& pose) {
    if (const std::string problem = check_pose(pose); !problem.empty())
        return failure(fmt::format("marker '{}': its pose: {}", shown(name), problem));
    const auto marker = find_marker(markers_, name);
    if (marker == markers_.end()) return no_marker(name, markers_);
    marker->pose = pose;
    return {};
}

Expected<void> OdeWorld::add_marker(const MarkerSpec& marker) {
    if (find_marker(markers_, marker.name) != markers_.end())
        return failure(fmt::format("marker: another marker has the name '{}'", shown(marker.name)), marker.place);
    if (auto ok = check_marker(marker); !ok) return ok;
    markers_.push_back(pose_of(marker));
    return {};
}

Expected<void> OdeWorld::remove_marker(std::string_view name) {
    const auto marker = find_marker(markers_, name);
    if (marker == markers_.end()) return no_marker(name, markers_);
    markers_.erase(marker);
    return {};
}

}  // namespace nezumi::sim
