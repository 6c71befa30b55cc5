// Reads anything as a calibration: what comes out fits a robot or says why not, and is read again as it was written.
#include <cstdint>
#include <string_view>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

constexpr const char* file = "engine/robots/any.calibration.lua";

void check(const Calibration& calibration, const Project& project) {
    static const auto mouse = read_robot_file("engine/robots/raspimouse.lua", project);
    require(mouse.has_value());
    RobotSpec robot = *mouse;
    if (const auto ok = apply(calibration, robot); !ok) return require_line(ok.error().message);
    require(is_positive(robot.drive.track));
    const std::string text = write_calibration(calibration);
    const auto again = read_calibration_text(text, file, project);
    require(again.has_value() && again->odometry == calibration.odometry && write_calibration(*again) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Project project = Project::of(file, {"."});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto calibration = read_calibration_text(text, file, project);
    calibration ? check(*calibration, project) : check(calibration.error());
    return 0;
}
