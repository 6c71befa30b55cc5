// Reads robot files as tests want them: from a text, as a file of the shipped robots.
#pragma once

#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/files/robot_file.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::robot_files {

constexpr double infinity = std::numeric_limits<double>::infinity();

inline Expected<RobotSpec> read(std::string_view text) {
    const Project project = Project::of(root / "engine/robots/r.lua", {root});
    return read_robot_text(text, "engine/robots/r.lua", project);
}

inline RobotSpec robot_of(std::string_view text) {
    auto spec = read(text);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

// The error without the folders of the file.
inline std::string robot_error(std::string_view text) {
    const auto spec = read(text);
    if (!spec && spec.error().place.file == "engine/robots/r.lua") return describe(spec.error()).substr(14);
    return spec ? "no error" : describe(spec.error());
}

// A robot that is right but for `more`, which begins in line 2.
inline std::string with(std::string_view more) {
    return "return robot_model { mass = 1, body = { size = { 0.1, 0.1, 0.1 } }, drive = { radius = 0.02, track = 0.1 "
           "},\n" +
           std::string(more) + " }";
}

inline const SensorSpec& sensor_of(const RobotSpec& spec, std::string_view name) {
    for (const SensorSpec& sensor : spec.sensors) {
        if (sensor.name == name) return sensor;
    }
    FAIL("no sensor " << name);
    return spec.sensors.front();
}

inline const PortSpec& port_of(const RobotSpec& spec, std::string_view name) {
    for (const PortSpec& port : spec.ports) {
        if (port.name == name) return port;
    }
    FAIL("no port " << name);
    return spec.ports.front();
}

inline RobotSpec shipped(const std::string& name) {
    const auto path = root / "engine/robots" / name;
    auto spec = read_robot_file(path, Project::of(path, {root}));
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

}  // namespace nezumi::robot_files
