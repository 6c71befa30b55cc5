// Reads anything as a map and as a response table: what comes out is sound, or an error that names its place.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "engine/world/csv_map.hpp"
#include "engine/world/robot_spec.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

void check(const BoxSpec& box) {
    require(std::isfinite(box.at.x) && std::isfinite(box.at.y) && std::isfinite(box.at.z) && std::isfinite(box.yaw));
    require(is_positive(box.size.x) && is_positive(box.size.y) && is_positive(box.size.z));
    require(box.mass == 0 && box.place.line > 1);
}

void check(const ResponseTable& table) {
    for (const double distance : {0.0, 1e-9, 0.01, 0.3, 0.6, 1e9, std::numeric_limits<double>::infinity()}) {
        const double value = table(distance);
        require(value >= 0 && value <= 4095);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (const auto map = read_map(text, "any.csv")) {
        for (const BoxSpec& box : map->boxes) check(box);
    } else {
        check(map.error());
    }
    if (const auto points = read_csv_response(text, "any.csv")) {
        if (const auto table = ResponseTable::from_points(*points, 0.6, 0, 0, 4095)) check(*table);
    } else {
        check(points.error());
    }
    return 0;
}
