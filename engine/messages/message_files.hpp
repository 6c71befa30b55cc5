// Finds the message types that files of a project define.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/messages/definition.hpp"
#include "engine/ports/payload.hpp"
#include "engine/project/project.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// A message type, and the files that define it; a compiled type has no files.
struct FoundMessage {
    const MessageType* type = nullptr;
    std::vector<SourceText> files{};
};

/// Finds a message type by name, as used in the file `from`. `read` gets the files that were read, also after a
/// failure. May be called from the thread that prepares a reload.
using MessageFinder =
    std::function<Expected<FoundMessage>(std::string_view name, std::string_view from, std::vector<SourceText>* read)>;

/// Reads a Lua file that defines a message.
using LuaMessageReader = std::function<Expected<MessageDefinition>(const SourceText& source, const Project& project)>;

/// Searches message types beside the file that names them, then in `behaviors/messages/` of the project, then among the
/// installed ones. `Obstacle` is defined by `obstacle.lua` or `Obstacle.msg`, and `sensor_msgs/Imu` by
/// `sensor_msgs/Imu.msg`. `Imu` alone is enough if only one package has it. An IDL file defines one type for each
/// structure.
class MessageFiles {
public:
    MessageFiles(Project project, LuaMessageReader read_lua);

    /// Finds a type by name, as used in the file `from`. The error has a location if a file is wrong. If the type does
    /// not exist, the error has the nearest name and no location.
    Expected<FoundMessage> find(std::string_view name, const std::filesystem::path& from,
                                std::vector<SourceText>* read = nullptr) const;
    /// The names of all types defined by files, sorted, as the file `from` can use them.
    std::vector<std::string> names(const std::filesystem::path& from) const;
    /// All types defined by files, by the names that `from` can use, except files with errors. Each file is read once.
    std::vector<const MessageType*> all(const std::filesystem::path& from) const;
    /// The types that the file `source` defines.
    Expected<std::vector<const MessageType*>> types_in(const SourceText& source) const;

private:
    class Search;

    Project project_;
    LuaMessageReader read_lua_;
};

}  // namespace nezumi
