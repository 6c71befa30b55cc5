// Calibrations of cameras in ROS's own file.
#include <catch2/catch.hpp>
#include <string>

#include "engine/world/ros_calibration.hpp"

using namespace nezumi;

namespace {

// As camera_calibration writes it.
std::string ost(const std::string& model, const std::string& data) {
    return "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
           "  data: [612.5, 0.0, 318.25, 0.0, 611.75, 239.5, 0.0, 0.0, 1.0]\ndistortion_model: " +
           model + "\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: " + data +
           "\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
}

std::string error(const std::string& text) {
    const auto read = read_ros_calibration(text, "ost.yaml");
    return read ? "no error" : describe(read.error());
}

}  // namespace

TEST_CASE("a camera's calibration is read as ROS writes it", "[engine][camera]") {
    const auto plain = read_ros_calibration(ost("plumb_bob", "[0.1, -0.2, 0.001, 0.002, 0.0]"), "ost.yaml");
    REQUIRE(plain.has_value());
    CHECK(*plain == CameraIntrinsics{640, 480, 612.5, 611.75, 318.25, 239.5, 0.1, -0.2, 0.001, 0.002});
    const auto rational = read_ros_calibration(
        ost("rational_polynomial", "[0.1, -0.2, 0.001, 0.002, 0.3,\n    0.4, 0.5, 0.6]"), "ost.yaml");
    REQUIRE(rational.has_value());
    CHECK(rational->k3 == 0.3);
    CHECK(rational->k4 == 0.4);
    CHECK(rational->k6 == 0.6);
}

TEST_CASE("an error in the calibration of a camera has its line", "[engine][camera]") {
    CHECK(error("image_width: 640\n") == "ost.yaml: is not a camera calibration of ROS: it has no 'image_height:'");
    CHECK(error(ost("equidistant", "[0.1]")) ==
          "ost.yaml:8: 'distortion_model': expected plumb_bob or rational_polynomial, got 'equidistant'");
    CHECK(error(ost("plumb_bob", "[0, 0, 0, 0, 0, 1]")) ==
          "ost.yaml:12: 'distortion_coefficients.data': expected at most 5 numbers, got '[0, 0, 0, 0, 0, 1]'");
    CHECK(
        error("image_width: 640\nimage_height: 480\ncamera_matrix: {data: [0, 0, 0, 0, 0, 0, 0, 0, 0]}\n") ==
        "ost.yaml:3: 'camera_matrix.data': expected 9 numbers, fx and fy of them more than 0, got '[0, 0, 0, 0, 0, 0, "
        "0, 0, 0]'");
}
