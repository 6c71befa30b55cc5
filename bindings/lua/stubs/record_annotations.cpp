// Writes a class for every described structure, and the functions that take them.
#include "bindings/lua/stubs/record_annotations.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/script/declaration_fields.hpp"
#include "engine/components/parameter_fields.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/system/system_fields.hpp"
#include "engine/world/calibration.hpp"

namespace nezumi {
namespace {

// What a word's function takes and gives.
enum class Form { thing, entry, plain };

std::string word(const RecordShape& record, Form form, bool methods) {
    const std::string table = class_of(record.name);
    const std::string receiver = methods ? "self: Scenario, " : "";
    const std::string name = (methods ? "s:" : "") + record.name;
    std::string text = fmt::format("---{}\n", record.doc);
    if (form == Form::entry) text += "---@param name string\n";
    text += fmt::format("---@param fields {}\n", table);
    if (form == Form::entry) {
        const char* given = methods ? ": Component" : "";
        text += fmt::format("---@overload fun({}name: string): fun(fields: {}){}\n", receiver, table, given);
        if (methods) text += "---@return Component\n";
    }
    if (form == Form::thing) text += "---@return Thing\n";
    return text + fmt::format("function {}({}fields) end\n\n", name, form == Form::entry ? "name, " : "");
}

// Of a robot file: what one leaves out, another may have that it builds on.
RecordShape of_robot(RecordShape shape) {
    for (FieldRow& row : shape.rows) {
        if (std::exchange(row.required, false)) row.fallback = "required";
    }
    return shape;
}

// A robot of a system has the fields of a robot file as well.
RecordShape robot_of_system() {
    RecordShape shape = shape_of_record<RobotEntry>();
    RecordShape model = shape_of_record<RobotSpec>();
    for (FieldRow& row : model.rows) {
        if (row.name == "base") continue;
        row.required = false;
        row.fallback = "as of the model";
        shape.rows.push_back(std::move(row));
    }
    return shape;
}

// A word that takes no table.
struct Word {
    std::string_view name, doc, parameters, arguments;
};
constexpr Word words[] = {
    {"connect", "Connects an out-port to an in-port of the same type.",
     "---@param from string|Port \"name.port\", \"rtm:NAME.port\", or in a scenario the port itself\n---@param to "
     "string|Port\n",
     "from, to"},
    {"csv", "Fixed boxes from a file with rows x,y,z,lx,ly,lz,yaw.", "---@param file string\n---@return Thing\n",
     "file"},
    {"map", "Fixed boxes from a map of ROS: what is occupied in the picture that the YAML file names.",
     "---@param file string\n---@return Thing\n", "file"},
    {"rate", "Ticks a second, 100 unless it says otherwise.", "---@param hz number\n", "hz"},
    {"seed", "Of everything random in the run.", "---@param n integer\n", "n"},
};

}  // namespace

const std::vector<RecordShape>& file_records() {
    static const std::vector<RecordShape> records{
        shape_of_record<ParameterSpec>(),
        shape_of_record<PortDeclaration>(),
        shape_of_record<ScriptAbout>(),
        shape_of_record<TaskOptions>(),
        shape_of_record<WaitOptions>(),
        shape_of_record<BoxSpec>(),
        shape_of_record<WallSpec>(),
        shape_of_record<CylinderSpec>(),
        shape_of_record<MarkerSpec>(),
        shape_of_record<MazeSpec>(),
        shape_of_record<MazePlan>(),
        shape_of_record<FloorSpec>(),
        shape_of_record<LineSpec>(),
        shape_of_record<BorderSpec>(),
        shape_of_record<ArenaSpec>(),
        shape_of_record<LimitChanges>(),
        robot_of_system(),
        shape_of_record<BehaviorEntry>(),
        shape_of_record<ComponentEntry>(),
        shape_of_record<PhysicsFields>(),
        shape_of_record<NetworkSpec>(),
        shape_of_record<RosSpec>(),
        shape_of_record<RosTopic>(),
        shape_of_record<RtmSpec>(),
        of_robot(shape_of_record<BodySpec>()),
        of_robot(shape_of_record<DriveSpec>()),
        of_robot(shape_of_record<SensorSpec>()),
        of_robot(shape_of_record<ActuatorSpec>()),
        of_robot(shape_of_record<PortSpec>()),
        of_robot(shape_of_record<HardwareSpec>()),
        of_robot(shape_of_record<RobotSpec>()),
        shape_of_record<RobotPlace>(),
        shape_of_record<MarkerPlace>(),
        shape_of_record<Push>(),
        shape_of_record<HoldOptions>(),
        shape_of_record<Calibration>(),
        shape_of_record<WheelCalibration>(),
    };
    return records;
}

std::string annotation(const RecordShape& record) { return annotation(record, class_of(record.name), ""); }

std::string annotation(const RecordShape& record, const std::string& name, std::string_view kind) {
    std::string text = fmt::format("---@class (exact) {}\n", name);
    for (const FieldRow& row : record.rows) {
        if (!kind.empty() && !row.kinds.empty() && row.kinds != kind) continue;
        text += fmt::format("---@field {}{} {}", row.name, row.required ? "" : "?", row.type);
        if (!row.unit.empty()) text += fmt::format(" [{}]", row.unit);
        if (!row.doc.empty()) text += " " + row.doc;
        if (kind.empty() && !row.kinds.empty()) text += fmt::format(" (of {})", row.kinds);
        text += "\n";
    }
    if (record.name == Describe<ArenaSpec>::name) text += "---@field [integer] Thing|Thing[]\n";
    return text + "\n";
}

std::string system_word_annotations(bool methods) {
    std::string text;
    for (const RecordShape& record : file_records()) {
        const bool is_entry = record.name == "robot" || record.name == "behavior" || record.name == "component";
        const bool is_thing = record.name == "box" || record.name == "wall" || record.name == "cylinder" ||
                              record.name == "marker" || record.name == "maze" || record.name == "floor" ||
                              record.name == "line";
        if (is_entry || is_thing || record.name == "arena" || record.name == "physics" || record.name == "network" ||
            record.name == "ros" || record.name == "rtm")
            text += word(record, is_entry ? Form::entry : is_thing ? Form::thing : Form::plain, methods);
    }
    for (const Word& each : words) {
        if (methods && each.name == "seed") continue;  // a run's is that of nezumi test
        text += fmt::format("---{}\n{}function {}{}({}) end\n\n", each.doc, each.parameters, methods ? "s:" : "",
                            each.name, each.arguments);
    }
    return text;
}

}  // namespace nezumi
