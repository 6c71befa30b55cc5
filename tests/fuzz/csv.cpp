// Reads anything as a map and as a response table: what comes out is sound, or an error that names its place.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "engine/world/csv_map.hpp"
#include "engine/world/robot_spec.hpp"

using namespace nezumi;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const Error& error) {
    require(error.place.file == "any.csv" && error.place.line >= 0);
    require(!error.message.empty() && error.message.size() < 2000);
    // A message is one line that a terminal can show, whatever bytes the file had.
    for (const char c : error.message) require(static_cast<unsigned char>(c) >= 0x20);
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

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
