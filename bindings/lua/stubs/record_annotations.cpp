// Writes a class for every described structure, and the functions that take it.
#include "bindings/lua/stubs/record_annotations.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/script/declaration_fields.hpp"
#include "engine/components/parameter_fields.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/system_fields.hpp"
#include "engine/world/calibration.hpp"

namespace nezumi {
namespace {

using Form = SystemWord::Form;

// A word with a described table.
std::string word_of_table(const RecordShape& record, const SystemWord& word, bool methods) {
    const Form form = word.form;
    const std::string table = word.help.parameters.empty() ? class_of(record.name) : word.help.parameters.front().type;
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
    if (form == Form::thing) text += record.name == "maze" ? "---@return Maze\n" : "---@return Thing\n";
    return text + fmt::format("function {}({}fields) end\n\n", name, form == Form::entry ? "name, " : "");
}

// In a robot file every field is optional, because the file may build on another one.
RecordShape of_robot(RecordShape shape) {
    for (FieldRow& row : shape.rows) {
        if (std::exchange(row.required, false)) row.fallback = "required";
    }
    return shape;
}

// A robot of a system may also have the fields of a robot file.
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

// A word without a table.
std::string plain_word(const SystemWord& word, bool methods) {
    std::string text = fmt::format("---{}\n", word.help.doc), arguments;
    for (const SystemWord::Help::Parameter& each : word.help.parameters) {
        text += fmt::format("---@param {} {}\n", each.name, each.type);
        arguments += fmt::format("{}{}", arguments.empty() ? "" : ", ", each.name);
    }
    if (word.form == Form::thing) text += "---@return Thing\n";
    if (word.name == "argument") text += "---@return any\n";
    return text + fmt::format("function {}{}({}) end\n\n", methods ? "s:" : "", word.name, arguments);
}

}  // namespace

std::vector<RecordShape> file_records(const PeerWords& peers) {
    std::vector<RecordShape> records{
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
    };
    for (const PeerWord* peer : peers) {
        for (RecordShape& record : peer->records()) records.push_back(std::move(record));
    }
    for (RecordShape& record : std::vector<RecordShape>{
             of_robot(shape_of_record<BodySpec>()),
             of_robot(shape_of_record<Limits>()),
             of_robot(shape_of_record<DriveSpec>()),
             of_robot(shape_of_record<SensorSpec>()),
             of_robot(shape_of_record<ActuatorSpec>()),
             of_robot(shape_of_record<PortSpec>()),
             of_robot(shape_of_record<HardwareSpec>()),
             of_robot(shape_of_record<RobotSpec>()),
             shape_of_record<RobotPlace>(),
             shape_of_record<MarkerPlace>(),
             shape_of_record<VelocityConstraint>(),
             shape_of_record<HoldOptions>(),
             shape_of_record<Calibration>(),
             shape_of_record<WheelCalibration>(),
         })
        records.push_back(std::move(record));
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

std::string system_word_annotations(const PeerWords& peers, bool methods) {
    const std::vector<SystemWord> words = system_words(peers);
    std::string text;
    for (const RecordShape& record : file_records(peers)) {
        for (const SystemWord& word : words) {
            if (word.name == record.name) text += word_of_table(record, word, methods);
        }
    }
    for (const SystemWord& word : words) {
        if (word.help.doc.empty()) continue;
        // In scenarios, the seed comes from nezumi test, and the values from the sweep.
        if (methods && (word.name == "seed" || word.name == "argument")) continue;
        text += plain_word(word, methods);
    }
    return text;
}

}  // namespace nezumi
