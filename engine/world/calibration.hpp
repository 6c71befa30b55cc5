// The measured properties of one robot, which differ from its model: from `nezumi calibrate`, stored in a file.
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
    std::string robot;          ///< its name in the system
    std::string model;          ///< that it was measured with
    std::string serial;         ///< of its computer; "": not known
    WheelCalibration odometry;  ///< as long as it is there
    std::vector<RangeCalibration> ranges;
    std::map<std::string, CameraIntrinsics, std::less<>> cameras;  ///< its cameras, by name in the system
};

/// Changes the description of a model to that of the robot. With a calibrated odometry, the limits of the hardware are
/// those of the model. An error if a sensor does not exist, or if its points make no table. Cameras are components, so
/// they are not part of the model.
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
        Setting{"model", &Calibration::model, "", "that it was measured with", {.required = true}},
        Setting{"serial", &Calibration::serial, "", "number of its computer: on another one the file is refused"},
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
