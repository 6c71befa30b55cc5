// Where the text of a script comes from: a file, or what an editor or a scenario gives in its place.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

struct SourceText {
    std::string path;   ///< of the file; what a watcher watches
    std::string shown;  ///< what messages call it, usually its path as a person would open it
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

/// Finds the text of a module by the name that `require` was given, for the script at `from`. It may be called from the
/// thread that prepares a reload.
using ModuleFinder = std::function<Expected<SourceText>(std::string_view name, std::string_view from)>;

/// The text of the file at `path`, shown by its name without folders.
Expected<SourceText> read_source(const std::string& path);

/// Of these files, those that `read` gives another text of now, or none: each once.
std::vector<std::string> changed_files(const std::vector<ScriptFile>& files,
                                       const std::function<Expected<SourceText>(const std::string& path)>& read);

/// "robot_controller.lua" is the type "RobotController".
std::string type_of_file(std::string_view path);

}  // namespace nezumi
