// The text of a script, from a file, an editor or a scenario.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

struct SourceText {
    std::string path;   ///< of the file, for the watcher
    std::string shown;  ///< name in messages, usually its path as a person would type it
    std::string text;
};

/// A file without its text.
struct ScriptFile {
    explicit ScriptFile(const SourceText& source);

    std::string path;
    std::string shown;
    std::uint64_t hash;  ///< of its text

    bool operator==(const ScriptFile&) const = default;
};

/// Finds the text of a module by the name in `require`, for the script at `from`. May be called from the thread that
/// prepares a reload.
using ModuleFinder = std::function<Expected<SourceText>(std::string_view name, std::string_view from)>;

/// The text of the file at `path`, shown by its name without folders.
Expected<SourceText> read_source(const std::string& path);

/// The paths of the files whose text has changed or can't be read any more, according to `read`; each path once.
std::vector<std::string> changed_files(const std::vector<ScriptFile>& files,
                                       const std::function<Expected<SourceText>(const std::string& path)>& read);

/// The type "RobotController" for "robot_controller.lua".
std::string type_of_file(std::string_view path);

}  // namespace nezumi
