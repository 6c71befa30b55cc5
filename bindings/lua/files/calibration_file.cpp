// The word `calibration`, and the description that it makes of a model.
#include "bindings/lua/files/calibration_file.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/read_record.hpp"
#include "bindings/lua/files/robot_fields.hpp"
#include "bindings/lua/files/write_record.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

void read_sensors(Fields sensors, Calibration& out) {
    for (const FileField& each : sensors.all()) {
        Fields sensor = sensors.inner(each.name);
        const FileValue* table = sensor.field("table");
        if (table == nullptr || table->table() == nullptr) {
            sensor.check().missing(sensor.path_of("table"), "{ { distance, value }, ... }");
        } else {
            out.ranges.push_back({each.name, read_points(sensor, *table->table())});
        }
        sensor.done();
    }
}

class Reader {
public:
    explicit Reader(DataFile& file) : file_(file) {}

    static int word(lua_State* lua) {
        auto& reader = *static_cast<Reader*>(lua_touserdata(lua, lua_upvalueindex(1)));
        bridge(lua, [&] { return reader.read(lua); });
        return 0;
    }

    std::optional<Calibration> calibration;

private:
    // Raises no Lua error.
    Expected<void> read(lua_State* lua) {
        const Place place = calling_place(lua);
        const auto value = read_file_value(lua, 1);
        if (!value) return Unexpected(file_.fail({"calibration: " + value.error().message, place}));
        FieldCheck check("calibration", "calibration", place, file_.source(place.file));
        Calibration out;
        Fields fields(check, *value);
        read_record(fields, out);
        if (fields.has("odometry")) {
            Fields odometry = fields.inner("odometry");
            for_each_setting<WheelCalibration>([&](const auto& field) {
                if (!odometry.has(field.name)) check.missing(odometry.path_of(field.name), "a positive number in m");
            });
        }
        if (fields.has("sensors")) read_sensors(fields.inner("sensors"), out);
        fields.done();
        if (auto ok = check.result(); !ok) return Unexpected(file_.fail(ok.error()));
        calibration = std::move(out);
        return {};
    }

    DataFile& file_;
};

}  // namespace

fs::path calibration_path(const fs::path& system, std::string_view robot) {
    return system.parent_path() / fmt::format("{}.calibration.lua", robot);
}

Expected<Calibration> read_calibration_text(std::string_view text, const std::string& shown, const Project& project) {
    auto file = DataFile::create(project, {});
    if (!file) return Unexpected(file.error());
    Reader reader(**file);
    if (auto ran = (*file)->run(text, shown, {{"calibration", Reader::word, &reader}}); !ran)
        return Unexpected(ran.error());
    if (!reader.calibration)
        return failure("a calibration file says `calibration { ... }`: make it anew by nezumi calibrate", {shown});
    return std::move(*reader.calibration);
}

std::string write_calibration(const Calibration& calibration) {
    std::string text = "--- Measured by nezumi calibrate: what this one robot is like.\ncalibration {\n";
    text += fmt::format("  robot = {},\n  model = {},\n", nezumi::quoted(calibration.robot),
                        nezumi::quoted(calibration.model));
    if (!calibration.serial.empty()) text += fmt::format("  serial = {},\n", nezumi::quoted(calibration.serial));
    if (calibration.odometry.is_there()) text += fmt::format("  odometry = {},\n", write_record(calibration.odometry));
    if (!calibration.ranges.empty()) text += "  sensors = {\n";
    for (const RangeCalibration& range : calibration.ranges) {
        text += fmt::format("    {} = {{ table = {{", lua_key(range.sensor));
        for (const auto& point : range.points)
            text += fmt::format(" {{ {}, {} }},", lua_number(point.distance), lua_number(point.value));
        text += " } },\n";
    }
    if (!calibration.ranges.empty()) text += "  },\n";
    return text + "}\n";
}

Expected<void> use_calibration(SystemSpec& spec, RobotEntry& robot, const Project& project, const CalibrationUse& use) {
    if (!robot.description.empty()) return {};
    const fs::path path = calibration_path(spec.file, robot.name);
    const std::string shown = project.shown(path);
    const auto text = project.read(path);
    if (!text) {
        std::error_code none;
        if (!use.is_needed && !fs::exists(path, none)) return {};
        if (fs::exists(path, none)) return Unexpected(text.error());
        return failure(fmt::format("robot '{}': calibrated = true, and there is no {}: make it by nezumi calibrate",
                                   robot.name, shown),
                       robot.place);
    }
    const auto calibration = read_calibration_text(*text, shown, project);
    if (!calibration) return Unexpected(calibration.error());
    const auto of_another = [&](std::string_view what, std::string_view its, std::string_view ours) {
        return failure(
            fmt::format("is the calibration of another robot: its {} is '{}', not '{}'. Calibrate this one, or "
                        "move the file away",
                        what, nezumi::shown(its), ours),
            {shown});
    };
    if (calibration->robot != robot.name) return of_another("name", calibration->robot, robot.name);
    if (calibration->model != robot.model) return of_another("model", calibration->model, robot.model);
    if (!use.serial.empty() && !calibration->serial.empty() && calibration->serial != use.serial)
        return of_another("computer's number", calibration->serial, use.serial);
    RobotSpec own = spec.models.at(robot.model);
    if (auto applied = apply(*calibration, own); !applied) return failure(applied.error().message, {shown});
    robot.description = fmt::format("{} of {}", robot.model, robot.name);
    spec.models.insert_or_assign(robot.description, std::move(own));
    spec.files.push_back(shown);
    return {};
}

}  // namespace nezumi
