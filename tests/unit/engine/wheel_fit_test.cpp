// Wheels from drives whose ends were measured.
#include "engine/robot/wheel_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace nezumi;

namespace {

const WheelCalibration believed{.track = 0.0925, .left_radius = 0.024, .right_radius = 0.024};
const WheelCalibration truth{.track = 0.0955, .left_radius = 0.0243, .right_radius = 0.0238};

void add(MeasuredDrive& drive, Wheels step, int count) {
    for (int i = 0; i < count; ++i) drive.travel.push_back(step);
}

// A drive as an odometry with the believed wheels tells it, and its true end with the others.
MeasuredDrive measured(MeasuredDrive drive) {
    drive.end = end_of(drive, believed, truth);
    return drive;
}

MeasuredDrive line() {
    MeasuredDrive drive;
    add(drive, {0.001, 0.001}, 1000);
    return measured(drive);
}

MeasuredDrive square(double side) {
    MeasuredDrive drive;
    for (int corner = 0; corner < 4; ++corner) {
        add(drive, {0.001, 0.001}, 500);
        const double rim = believed.track / 2 * std::numbers::pi / 2 / 100;
        add(drive, {-side * rim, side * rim}, 100);
    }
    return measured(drive);
}

}  // namespace

TEST_CASE("both radii and the track are found from a line and two squares", "[engine][calibration]") {
    const auto fit = fit_wheels({line(), square(1), square(-1)}, believed);
    REQUIRE(fit);
    CHECK(fit->wheels.track == Approx(truth.track).epsilon(1e-6));
    CHECK(fit->wheels.left_radius == Approx(truth.left_radius).epsilon(1e-6));
    CHECK(fit->wheels.right_radius == Approx(truth.right_radius).epsilon(1e-6));
    CHECK(fit->before > 0.03);
    CHECK(fit->after < 1e-6);
}

TEST_CASE("a tape measure that is read to a millimetre is good enough", "[engine][calibration]") {
    std::vector<MeasuredDrive> drives{line(), square(1), square(-1)};
    for (MeasuredDrive& drive : drives)
        drive.end = {std::round(drive.end.x * 1000) / 1000, std::round(drive.end.y * 1000) / 1000};
    const auto fit = fit_wheels(drives, believed);
    REQUIRE(fit);
    CHECK(fit->wheels.track == Approx(truth.track).epsilon(0.002));
    CHECK(fit->wheels.right_radius == Approx(truth.right_radius).epsilon(0.001));
}

TEST_CASE("drives that do not tell the wheels are refused", "[engine][calibration]") {
    CHECK(fit_wheels({line()}, believed).error().message ==
          "these drives do not determine the wheel parameters: drive a straight line, and squares in both directions");
}

TEST_CASE("a final position that was measured wrongly is reported", "[engine][calibration]") {
    std::vector<MeasuredDrive> drives{line(), square(1), square(-1)};
    drives[0].end = {98, 0};  // in centimetres
    CHECK(fit_wheels(drives, believed)
              .error()
              .message.starts_with("the result differs from the model by more than a quarter"));
    drives = {line(), square(1), square(-1)};
    drives[1].end.x += 0.5;
    const auto fit = fit_wheels(drives, believed);
    REQUIRE_FALSE(fit);
    CHECK(fit.error().message.find("measured wrongly") != std::string::npos);
}
