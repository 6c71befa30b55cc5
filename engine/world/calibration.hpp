// The measured parameters of one robot, which may differ from its model. `nezumi calibrate` writes them into a file.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/world/robot_fields.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

struct WheelCalibration {
    double track = 0;         ///< [m]
    double left_radius = 0;   ///< [m]
    double right_radius = 0;  ///< [m]

    bool is_there() const { return track > 0 && left_radius > 0 && right_radius > 0; }
    bool operator==(const WheelCalibration&) const = default;
};

/// Measured values of a range sensor.
struct RangeCalibration {
    std::string sensor;                        ///< its name in the robot file
    std::vector<ResponseTable::Point> points;  ///< in ascending order of distance
};

struct Calibration {
    std::string robot;          ///< name of the robot in the system
    std::string model;          ///< robot model that was used in the measurement
    std::string serial;         ///< serial number of the robot's computer; "": unknown
    WheelCalibration odometry;  ///< used only if `odometry.is_there()`
    std::vector<RangeCalibration> ranges;
    std::map<std::string, CameraIntrinsics, std::less<>> cameras;  ///< by the camera's name in the system
};

/// Replaces parameters of a robot model by the measured ones. If the odometry is calibrated, the limits on hardware
/// become those in simulation. An error if a measured wheel parameter is not plausible, if a sensor does not exist, or
/// if its points do not form a table. Cameras are not changed here: they are components, not part of the model.
Expected<void> apply(const Calibration& calibration, RobotSpec& spec);

template <>
struct Describe<WheelCalibration> {
    static constexpr std::string_view name = "odometry_calibration";
    static constexpr std::string_view doc = "The measured wheels of a robot.";
    static constexpr FieldList fields{
        Setting{"track",
                &WheelCalibration::track,
                "m",
                "between the wheels",
                {.required = true, .range = NumberRange::positive, .least = least_robot_length}},
        Setting{"left_radius",
                &WheelCalibration::left_radius,
                "m",
                "of the left wheel",
                {.required = true, .range = NumberRange::positive, .least = least_robot_length}},
        Setting{"right_radius",
                &WheelCalibration::right_radius,
                "m",
                "of the right wheel",
                {.required = true, .range = NumberRange::positive, .least = least_robot_length}},
    };
};

template <>
struct Describe<Calibration> {
    static constexpr std::string_view name = "calibration";
    static constexpr std::string_view doc = "The measured parameters of one robot, in `ROBOT.calibration.lua`.";
    static constexpr FieldList fields{
        Setting{"robot", &Calibration::robot, "", "its name in the system", {.required = true}},
        Setting{
            "model", &Calibration::model, "", "the robot model that was used in the measurement", {.required = true}},
        Setting{"serial", &Calibration::serial, "",
                "serial number of the robot's computer; another computer refuses the file"},
        Setting{"odometry", &Calibration::odometry, "", "its wheels, from `nezumi calibrate odometry`"},
        Extra{"sensors",
              "table<string, { table: number[][] }>",
              "",
              "values of its range sensors at distances [m], from `nezumi calibrate ir`: `right_front = { table = { { "
              "0.02, "
              "795 }, ... } }`",
              {.by_hand = true}},
        Extra{"cameras",
              "table<string, { width: integer, height: integer, fx: number, fy: number, cx: number, cy: number, k1: "
              "number, k2: number, p1: number, p2: number, k3: number }>",
              "",
              "the intrinsics of its cameras, from `nezumi calibrate camera`: by the camera's name, the fields of a "
              "CameraIntrinsics",
              {.by_hand = true}},
        Internal{&Calibration::ranges},
        Internal{&Calibration::cameras},
    };
};

}  // namespace nezumi
