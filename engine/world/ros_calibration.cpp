// Reads only the size, the camera matrix and the distortion.
#include "engine/world/ros_calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/base/yaml.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {

Expected<CameraIntrinsics> read_ros_calibration(std::string_view text, const std::string& file) {
    const auto yaml = read_yaml(text, file);
    if (!yaml) return Unexpected(yaml.error());
    const auto refuse = [&](const std::string& key, const YAML::Node& value, std::string_view expected) {
        if (!value.IsDefined())
            return failure(fmt::format("is not a camera calibration of ROS: it has no '{}:'", key), {file});
        return failure(fmt::format("'{}': expected {}, got '{}'", key, expected, shown(yaml_text(value))),
                       yaml_place(value, file));
    };
    CameraIntrinsics out;
    for (const auto& [key, into] : {std::pair{"image_width", &out.width}, {"image_height", &out.height}}) {
        const YAML::Node value = yaml_field(*yaml, key);
        const auto pixels = yaml_number(value);
        if (!pixels || *pixels < least_picture || *pixels > largest_picture || *pixels != std::floor(*pixels))
            return refuse(key, value,
                          fmt::format("a whole number of pixels from {} to {}", least_picture, largest_picture));
        *into = static_cast<std::uint16_t>(*pixels);
    }
    const YAML::Node matrix = yaml_field(yaml_field(*yaml, "camera_matrix"), "data");
    const auto numbers = yaml_numbers(matrix);
    constexpr std::size_t elements = 9;
    if (!numbers || numbers->size() != elements || !((*numbers)[0] > 0) || !((*numbers)[4] > 0))
        return refuse("camera_matrix.data", matrix, "9 numbers, fx and fy of them more than 0");
    out.fx = (*numbers)[0];
    out.cx = (*numbers)[2];
    out.fy = (*numbers)[4];
    out.cy = (*numbers)[5];
    const YAML::Node model = yaml_field(*yaml, "distortion_model");
    const bool is_rational = yaml_text(model) == "rational_polynomial";
    if (model.IsDefined() && !is_rational && yaml_text(model) != "plumb_bob")
        return refuse("distortion_model", model, "plumb_bob or rational_polynomial");
    const YAML::Node distortion = yaml_field(yaml_field(*yaml, "distortion_coefficients"), "data");
    std::vector<double> d;
    if (distortion.IsDefined()) {
        const auto read = yaml_numbers(distortion);
        const std::size_t most = is_rational ? 8 : 5;
        if (!read || read->size() > most)
            return refuse("distortion_coefficients.data", distortion, fmt::format("at most {} numbers", most));
        d = *read;
    }
    d.resize(8);
    out.k1 = d[0];
    out.k2 = d[1];
    out.p1 = d[2];
    out.p2 = d[3];
    out.k3 = d[4];
    out.k4 = d[5];
    out.k5 = d[6];
    out.k6 = d[7];
    return out;
}

}  // namespace nezumi
