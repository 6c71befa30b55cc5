// `nezumi calibrate`: guided runs that measure one robot and write the results beside its system file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/guided/person.hpp"
#include "bindings/cli/guided/setup.hpp"
#include "bindings/lua/files/calibration_file.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/world/frames.hpp"
#include "hw/calibrate/camera.hpp"
#include "hw/calibrate/odometry.hpp"
#include "hw/calibrate/ranges.hpp"

namespace nezumi::cli {
namespace {

struct CalibrateOptions {
    std::string file, robot, camera, dev_root, sys_root;
    std::string board = "9x6";
    double side = hw::OdometryCourse{}.side;
    double wall = 0.02;
    bool simulated = false;
    bool is_sure = false;
};

// Parses "9x6". `board_problem` checks the text.
BoardSize board_of(const std::string& text) {
    BoardSize board;
    std::istringstream words(text);
    char by = 0;
    words >> board.columns >> by >> board.rows;
    return board;
}

std::string board_problem(const std::string& text) {
    const BoardSize board = board_of(text);
    if (fmt::format("{}x{}", board.columns, board.rows) == text && std::min(board.columns, board.rows) >= 3 &&
        std::max(board.columns, board.rows) <= 50)
        return "";
    return "expected the numbers of inner corners as COLUMNSxROWS, each from 3 to 50, as in 9x6";
}

// One calibration: builds the robot, measures it, and writes the file.
class Session {
public:
    explicit Session(const CalibrateOptions& options)
        : options_(options), person_(signals_.received(), options.is_sure || options.simulated) {}

    Expected<int> odometry() {
        if (auto ready = begin(); !ready) return Unexpected(ready.error());
        person_.tell(
            fmt::format("The robot drives a line of {} m and two squares of {} m. Mark on the floor the position of "
                        "the middle of its axle and its direction. Measure from this mark: x ahead, y to the left.",
                        2 * options_.side, options_.side));
        auto fit = hw::calibrate_odometry(*robot_, {.side = options_.side},
                                          {.place = [&](const std::string& drive) { return place(drive); },
                                           .measure = [&](const std::string&) { return measure(); }});
        if (!fit) return Unexpected(fit.error());
        fmt::print(
            "track {:.5f} m, left radius {:.6f} m, right radius {:.6f} m; root mean square error of the ends {:.4f} m, "
            "before the calibration {:.4f} m\n",
            fit->wheels.track, fit->wheels.left_radius, fit->wheels.right_radius, fit->after, fit->before);
        return write(robot_entry(), [&](Calibration& calibration) { calibration.odometry = fit->wheels; });
    }

    Expected<int> ranges() {
        if (auto ready = begin(); !ready) return Unexpected(ready.error());
        double front = 0;
        for (const SensorSpec& sensor : robot_->robot().spec().sensors) {
            if (sensor.kind == SensorSpec::Kind::range) front = std::max(front, sensor.at.x);
        }
        const double wall = options_.simulated ? distance_to_wall() : front + options_.wall;
        auto asked =
            person_.confirm(fmt::format("Place the robot at a right angle to a white wall, its foremost sensors {} m "
                                        "from the wall, with 0.5 m of free space behind it. It backs away and turns.",
                                        options_.wall));
        if (!asked) return Unexpected(asked.error());
        auto ranges = hw::calibrate_ranges(*robot_, {.wall = wall});
        if (!ranges) return Unexpected(ranges.error());
        for (const RangeCalibration& range : *ranges) {
            fmt::print("{}:", range.sensor);
            for (const auto& point : range.points) fmt::print(" {:.3f} m {:.0f},", point.distance, point.value);
            fmt::print("\n");
        }
        return write(robot_entry(), [&](Calibration& calibration) { calibration.ranges = std::move(*ranges); });
    }

    Expected<int> camera() {
        if (auto there = person_.is_there(); !there) return Unexpected(there.error());
        const Hardware hardware = roots();
        const hw::BoardCourse course{.board = board_of(options_.board)};
        auto camera = guided_camera(
            {.file = options_.file, .name = options_.camera, .simulated = options_.simulated, .hardware = hardware},
            signals_.received());
        if (!camera) return Unexpected(camera.error());
        auto asked = person_.confirm(
            fmt::format("Hold a chessboard of {} x {} inner corners with a white margin in front of the camera. The "
                        "board must be flat, stiff and completely in the picture. Hold it still {} times, each time in "
                        "another place: near and far, in the corners of the picture, tilted to all sides.",
                        course.board.columns, course.board.rows, course.views));
        if (!asked) return Unexpected(asked.error());
        const auto fit = hw::calibrate_camera(
            course, [&] { return (*camera)->next(); }, [&](const std::string& text) { person_.tell(text); });
        if (!fit) return Unexpected(fit.error());
        const CameraIntrinsics& intrinsics = fit->intrinsics;
        fmt::print(
            "fx {:.2f}, fy {:.2f}, cx {:.2f}, cy {:.2f} px, k1 {:.4f}, k2 {:.4f}, p1 {:.5f}, p2 {:.5f}, k3 {:.4f}; "
            "root mean square error of the corners {:.3f} px\n",
            intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy, intrinsics.k1, intrinsics.k2, intrinsics.p1,
            intrinsics.p2, intrinsics.k3, fit->error);
        return write((*camera)->robot(),
                     [&](Calibration& calibration) { calibration.cameras[(*camera)->name()] = intrinsics; });
    }

private:
    Expected<void> begin() {
        if (auto there = person_.is_there(); !there) return there;
        const GuidedSetup setup{
            .file = options_.file, .name = options_.robot, .simulated = options_.simulated, .hardware = roots()};
        auto robot = guided_by_file(setup, signals_.received());
        if (!robot) return Unexpected(robot.error());
        robot_ = std::move(*robot);
        return {};
    }

    Hardware roots() {
        Hardware hardware;
        if (!options_.dev_root.empty()) hardware.dev_root = options_.dev_root;
        if (!options_.sys_root.empty()) hardware.sys_root = options_.sys_root;
        serial_ = serial_number(hardware.sys_root);
        return hardware;
    }
    const RobotEntry& robot_entry() const { return *find_entry<RobotEntry>(robot_->spec(), robot_->robot().name()); }

    Expected<void> place(const std::string& drive) {
        if (options_.simulated) start_ = truth();
        return person_.confirm(fmt::format("Put the robot on its mark for {}.", drive));
    }
    Expected<Point2D> measure() {
        if (options_.simulated) return seen_from(start_, truth()).position;
        const auto end = person_.numbers("Where is the robot now: x y [m]", 2);
        if (!end) return Unexpected(end.error());
        return Point2D{(*end)[0], (*end)[1]};
    }
    Pose2D truth() { return robot_->system().world()->truth(robot_->robot().id()).pose; }
    // [m] From the robot's origin, along the nearest of the rays that point ahead, within 45 degrees.
    double distance_to_wall() {
        const Pose2D now = truth();
        double nearest = 1e6;
        for (const Ray& ray : robot_->system().world()->rays(robot_->robot().id())) {
            const Point2D from = seen_from(now, {{ray.from.x, ray.from.y}, 0}).position;
            const Point2D to = seen_from(now, {{ray.to.x, ray.to.y}, 0}).position;
            if (ray.hit && to.x - from.x > std::abs(to.y - from.y)) nearest = std::min(nearest, to.x);
        }
        return nearest;
    }

    // Writes the calibration file with the new values. Other values of the file are kept.
    template <class Change>
    Expected<int> write(const RobotEntry& robot, Change change) {
        if (options_.simulated) {
            fmt::print("nothing is written, because this was a simulation\n");
            return exit_done;
        }
        const std::filesystem::path path = calibration_path(options_.file, robot.name);
        Calibration calibration;
        if (std::error_code none; std::filesystem::exists(path, none)) {
            const auto text = read_whole(path, path.string());
            if (!text) return Unexpected(text.error());
            auto read = read_calibration_text(*text, path.string(), Project::of(path));
            if (!read) return Unexpected(read.error());
            calibration = std::move(*read);
        }
        calibration.robot = robot.name;
        calibration.model = robot.model;
        calibration.serial = serial_;
        change(calibration);
        if (auto written = write_whole(path, write_calibration(calibration)); !written)
            return Unexpected(written.error());
        fmt::print("wrote {}: nezumi run --hw uses this file from now on\n", path.string());
        return exit_done;
    }

    const CalibrateOptions& options_;
    StopSignals signals_;
    Person person_;
    std::string serial_;
    std::unique_ptr<hw::GuidedRobot> robot_;
    Pose2D start_;
};

int run(CalibrateOptions options, Expected<int> (Session::*calibrate)()) {
    if (auto ok = need_simulation(
            {{"calibrate --sim", options.simulated}, {"calibrate camera", calibrate == &Session::camera}});
        !ok)
        return refuse(ok.error());
    const auto file = find_system_file(options.file);
    if (!file) return refuse(file.error());
    options.file = file->string();
    Session session(options);
    const auto status = (session.*calibrate)();
    return status ? *status : refuse(status.error());
}

}  // namespace

SubCommand calibrate_command() {
    auto options = std::make_shared<CalibrateOptions>();
    const auto with = [&](std::vector<Option> own) {
        own.insert(own.begin(), {"FILE", &options->file, "the system file that the robot belongs to"});
        const std::vector<Option> common{
            {"--sim", &options->simulated, "practise in simulation: the true pose is measured, and nothing is written"},
            {"--yes", &options->is_sure, "do not ask for confirmation; read measurements from standard input"},
            {"--dev-root", &options->dev_root, "the folder of the device files (default /dev)", "DIR"},
            {"--sys-root", &options->sys_root, "the folder of the kernel's devices (default /sys)", "DIR"}};
        own.insert(own.end(), common.begin(), common.end());
        return own;
    };
    const Option robot{"--robot", &options->robot, "its name in the file; may be omitted if there is only one", "NAME"};
    const std::string footer =
        "Writes ROBOT.calibration.lua beside FILE, which nezumi run --hw uses from then on.\nExit status: 0 written, 2 "
        "it "
        "could not be done.";
    const SubCommand odometry{
        .name = "odometry",
        .help = "Measure the wheels' radii and track by driving a line and two squares",
        .options = with(
            {{"--side", &options->side, "of the squares [m]; the line is twice as long", "M", number_from(0.1, 10)},
             robot}),
        .run = [options] { return run(*options, &Session::odometry); },
        .footer = footer};
    const SubCommand ranges{
        .name = "ir",
        .help = "Measure the values of the distance sensors at known distances from a wall",
        .options = with({{"--wall", &options->wall, "from the foremost sensors to the wall, where the robot starts [m]",
                          "M", number_from(0.015, 1)},
                         robot}),
        .run = [options] { return run(*options, &Session::ranges); },
        .footer = footer};
    const SubCommand camera{
        .name = "camera",
        .help = "Measure the intrinsics of a robot's camera from views of a chessboard",
        .options =
            with({{"--camera", &options->camera, "its name in the file; may be omitted if there is only one", "NAME"},
                  {"--board", &options->board, "the chessboard's inner corners (default 9x6)", "COLUMNSxROWS",
                   board_problem}}),
        .run = [options] { return run(*options, &Session::camera); },
        .footer = footer};
    return {.name = "calibrate",
            .help = "Measure the parameters of a real robot in guided runs",
            .commands = {odometry, ranges, camera}};
}

}  // namespace nezumi::cli
