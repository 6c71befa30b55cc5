// Reads anything as a map of ROS, its YAML file and its picture: what comes out is sound, or an error that names its
// place.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "engine/world/occupancy_map.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // The picture follows the YAML file, from where it says what it is.
    const std::size_t begin = std::min(text.find("P5"), text.size());
    const auto facts = read_occupancy_facts(text.substr(0, begin), "map.yaml");
    if (!facts) {
        check(facts.error());
        return 0;
    }
    require(facts->resolution > 0 && !facts->image.empty() && std::isfinite(facts->origin.heading));
    const auto map = read_occupancy(*facts, text.substr(begin), "map.pgm", occupancy_height, {"any.lua", 1});
    if (!map) {
        check(map.error());
        return 0;
    }
    double area = 0;
    for (const BoxSpec& box : map->boxes) {
        require(is_finite(box.at) && is_positive(box.size.x) && is_positive(box.size.y) && is_positive(box.size.z));
        area += std::round(box.size.x / facts->resolution) * std::round(box.size.y / facts->resolution);
    }
    require(area == static_cast<double>(map->occupied));
    return 0;
}
