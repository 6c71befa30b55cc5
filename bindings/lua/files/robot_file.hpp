// Reads robot files: `return robot_model { ... }` as a robot's description.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/file_value.hpp"
#include "engine/project/project.hpp"
#include "engine/records/fields.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// A robot file that was read, with the files that it builds on. It is kept for robots with changes: its
/// functions are called again if the changes affect their inputs.
class RobotFile {
public:
    /// `project` must outlive this object. Errors have file and line.
    static Expected<std::unique_ptr<RobotFile>> read(const std::filesystem::path& path, const Project& project);
    ~RobotFile();
    RobotFile(const RobotFile&) = delete;
    RobotFile& operator=(const RobotFile&) = delete;

    const RobotSpec& spec() const;
    /// Every file that was read, as the project shows them.
    std::vector<std::string> files() const;
    /// This robot with other values of some fields, merged by `merge_values`. Mistakes go to `check`; then the result
    /// must not be used. Tables are searched beside `named_in`.
    RobotSpec changed(FieldCheck& check, const Value& changes, const std::string& named_in);

private:
    class Layer;
    explicit RobotFile(std::unique_ptr<Layer> layer);
    friend Expected<RobotSpec> read_robot_text(std::string_view, const std::string&, const Project&,
                                               std::vector<std::string>*);
    friend std::vector<Error> check_robot_text(std::string_view, const std::string&, const Project&,
                                               const std::vector<std::string>&);

    std::unique_ptr<Layer> layer_;
};

/// Reads a robot file. Tables (`table = "x.csv"`) are searched beside it. Errors have file and line. `files`, if given,
/// gets every file that was read, as the project shows them.
Expected<RobotSpec> read_robot_file(const std::filesystem::path& path, const Project& project,
                                    std::vector<std::string>* files = nullptr);

/// Reads a robot file from a text; `shown` is the file's name in errors, and tables are searched in its folder.
Expected<RobotSpec> read_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    std::vector<std::string>* files = nullptr);

/// Reads the robot of a system: `changes` is the text of a table with the fields that differ from its model, or
/// "".
Expected<RobotSpec> read_changed_robot(const std::filesystem::path& model, const std::string& changes,
                                       const Project& project, std::vector<std::string>* files = nullptr);

/// Reads the text of such a table of changes. `shown` is the name of the text in errors.
Expected<Value> read_changes(const std::string& changes, const std::string& shown, const Project& project);

/// All mistakes of a robot file; empty if it can be read. For editors: one error for each unknown global, otherwise the
/// first error. `drivers` are the names of all drivers of real robots; empty: unknown.
std::vector<Error> check_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    const std::vector<std::string>& drivers = {});

}  // namespace nezumi
