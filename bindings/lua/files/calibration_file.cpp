// The word `calibration`, and the description that results from a model and a calibration.
#include "bindings/lua/files/calibration_file.hpp"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/files/robot_fields.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/records/read_record.hpp"
#include "engine/records/write_record.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

void read_sensors(Fields sensors, Calibration& out) {
    for (const FileField& each : sensors.all()) {
        Fields sensor = sensors.inner(each.name);
        const Value* table = sensor.field("table");
        if (table == nullptr || table->get_if<FileTable>() == nullptr) {
            sensor.check().missing(sensor.path_of("table"), "{ { distance, value }, ... }");
        } else {
            out.ranges.push_back({each.name, read_points(sensor, *table->get_if<FileTable>())});
        }
        sensor.done();
    }
}

// All fields are required, because an incomplete file must be detected.
void read_cameras(Fields cameras, Calibration& out) {
    for (const FileField& each : cameras.all()) {
        Fields camera = cameras.inner(each.name);
        for_each_field(out.cameras[each.name], [&](const auto& field, auto& value) {
            const bool is_focal = field.name == "fx" || field.name == "fy";
            if constexpr (std::is_integral_v<std::remove_reference_t<decltype(value)>>) {
                camera.require(field.name, "a whole number of pixels");
                std::int64_t pixels = 0;
                if (camera.whole(field.name, pixels, least_picture, largest_picture))
                    value = static_cast<std::uint16_t>(pixels);
            } else {
                // k4 to k6 are optional: only the rational model of distortion has them.
                if (field.name < "k4" || field.name > "k6") camera.require(field.name, "a number");
                camera.number(field.name, value, {.range = is_focal ? NumberRange::positive : NumberRange::any});
            }
        });
        camera.done();
    }
}

class CalibrationReader {
public:
    explicit CalibrationReader(DataFile& file) : file_(file) {}

    static int word(lua_State* lua) {
        auto& reader = *static_cast<CalibrationReader*>(lua_touserdata(lua, lua_upvalueindex(1)));
        bridge(lua, [&] { return reader.read(lua); });
        return 0;
    }

    std::optional<Calibration> calibration;

private:
    // Raises no Lua error.
    Expected<void> read(lua_State* lua) {
        const Place place = calling_place(lua);
        if (calibration)
            return Unexpected(file_.fail({"calibration: is called twice: a file can have only one", place}));
        const auto value = read_file_value(lua, 1);
        if (!value) return Unexpected(file_.fail({"calibration: " + value.error().message, place}));
        FieldCheck check("calibration", "calibration", place, file_.source(place.file));
        Calibration out;
        Fields fields(check, *value);
        read_record(fields, out);
        if (fields.has("odometry")) {
            Fields odometry = fields.inner("odometry");
            for (const Type::Field& field : record_of<WheelCalibration>().fields) {
                if (!odometry.has(field.name)) check.missing(odometry.path_of(field.name), "a positive number in m");
            }
        }
        if (fields.has("sensors")) read_sensors(fields.inner("sensors"), out);
        if (fields.has("cameras")) read_cameras(fields.inner("cameras"), out);
        fields.done();
        if (auto ok = check.result(); !ok) return Unexpected(file_.fail(ok.error()));
        calibration = std::move(out);
        return {};
    }

    DataFile& file_;
};

// The measured intrinsics of the cameras on a robot become their parameters.
Expected<void> use_cameras(SystemSpec& spec, const RobotEntry& robot, const Calibration& calibration) {
    for (ComponentEntry* camera : entries_of<ComponentEntry>(spec)) {
        if (camera->on != robot.name || camera->type != "Camera") continue;
        const auto found = calibration.cameras.find(camera->name);
        if (found == calibration.cameras.end()) continue;
        const CameraIntrinsics& intrinsics = found->second;
        const auto pixels = [&](const char* name, std::int64_t otherwise) {
            const auto given = camera->config.find(name);
            const auto* number = given == camera->config.end() ? nullptr : given->second.get_if<std::int64_t>();
            return number == nullptr ? otherwise : *number;
        };
        const std::int64_t width = pixels("width", CameraSettings{}.width);
        const std::int64_t height = pixels("height", CameraSettings{}.height);
        if (width != intrinsics.width || height != intrinsics.height)
            return failure(
                fmt::format("camera '{}' was calibrated with {} x {} pixels, and here it has {} x {}: set its "
                            "width and height to that size, or calibrate it again with nezumi calibrate camera",
                            camera->name, intrinsics.width, intrinsics.height, width, height),
                camera->place);
        for_each_field(intrinsics, [&](const auto& field, const auto& value) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>)
                camera->config[std::string(field.name)] = value;
        });
    }
    return {};
}

}  // namespace

fs::path calibration_path(const fs::path& system, std::string_view robot) {
    return system.parent_path() / fmt::format("{}.calibration.lua", robot);
}

Expected<Calibration> read_calibration_text(std::string_view text, const std::string& shown, const Project& project) {
    auto file = DataFile::create(project, {});
    if (!file) return Unexpected(file.error());
    CalibrationReader reader(**file);
    if (auto ran = (*file)->run(text, shown, {{"calibration", CalibrationReader::word, &reader}}); !ran)
        return Unexpected(ran.error());
    if (!reader.calibration)
        return failure("the file has no `calibration { ... }`: make it again with nezumi calibrate", {shown});
    return std::move(*reader.calibration);
}

std::string write_calibration(const Calibration& calibration) {
    std::string text = "--- Measured by nezumi calibrate, for this one robot.\ncalibration {\n";
    text += fmt::format("  robot = {},\n  model = {},\n", lua_quoted(calibration.robot), lua_quoted(calibration.model));
    if (!calibration.serial.empty()) text += fmt::format("  serial = {},\n", lua_quoted(calibration.serial));
    if (calibration.odometry.is_there()) text += fmt::format("  odometry = {},\n", write_record(calibration.odometry));
    if (!calibration.ranges.empty()) text += "  sensors = {\n";
    for (const RangeCalibration& range : calibration.ranges) {
        text += fmt::format("    {} = {{ table = {{", lua_key(range.sensor));
        for (const auto& point : range.points)
            text += fmt::format(" {{ {}, {} }},", lua_number(point.distance), lua_number(point.value));
        text += " } },\n";
    }
    if (!calibration.ranges.empty()) text += "  },\n";
    if (!calibration.cameras.empty()) text += "  cameras = {\n";
    for (const auto& [camera, intrinsics] : calibration.cameras) {
        text += fmt::format("    {} = {{", lua_key(camera));
        for_each_field(intrinsics, [&](const auto& field, const auto& value) {
            if (value == 0 && field.name >= "k4" && field.name <= "k6") return;
            const bool is_whole = std::is_integral_v<std::remove_cvref_t<decltype(value)>>;
            text += fmt::format(" {} = {},", field.name, is_whole ? fmt::to_string(value) : lua_number(value));
        });
        text += " },\n";
    }
    if (!calibration.cameras.empty()) text += "  },\n";
    return text + "}\n";
}

Expected<void> use_calibration(SystemSpec& spec, RobotEntry& robot, const Project& project, const CalibrationUse& use) {
    const std::string own_name = fmt::format("{} of {}", robot.model, robot.name);
    if (robot.description == own_name || !robot.twin_of.empty()) return {};
    const fs::path path = calibration_path(spec.file, robot.name);
    const std::string shown = project.shown(path);
    const auto text = project.read(path);
    if (!text) {
        if (!project.files().what_is(path).empty()) return Unexpected(text.error());
        if (!use.is_needed) return {};
        return failure(fmt::format("robot '{}': calibrated = true, and there is no {}: make it by nezumi calibrate",
                                   robot.name, shown),
                       robot.place);
    }
    const auto calibration = read_calibration_text(*text, shown, project);
    if (!calibration) return Unexpected(calibration.error());
    const auto of_another = [&](std::string_view what, std::string_view its, std::string_view ours) {
        return failure(
            fmt::format("is the calibration of another robot: its {} is '{}', not '{}'. Calibrate this robot, or "
                        "move the file away",
                        what, nezumi::shown(its), ours),
            {shown});
    };
    if (calibration->robot != robot.name) return of_another("name", calibration->robot, robot.name);
    if (calibration->model != robot.model) return of_another("model", calibration->model, robot.model);
    if (use.serial && !calibration->serial.empty() && calibration->serial != *use.serial)
        return of_another("computer's number", calibration->serial, *use.serial);
    if (auto used = use_cameras(spec, robot, *calibration); !used) return used;
    RobotSpec own = spec.models.at(robot.described_by());
    if (auto applied = apply(*calibration, own); !applied) return failure(applied.error().message, {shown});
    robot.description = own_name;
    spec.models.insert_or_assign(robot.description, std::move(own));
    spec.files.push_back(shown);
    return {};
}

Expected<void> use_asked_calibrations(SystemSpec& spec, const Project& project) {
    for (RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        if (!robot->calibrated) continue;
        if (auto used = use_calibration(spec, *robot, project, {.is_needed = true, .serial = {}}); !used) return used;
    }
    return {};
}

}  // namespace nezumi
