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

/// A message type, and the files that say what it is: none for one that is compiled in.
struct FoundMessage {
    const MessageType* type = nullptr;
    std::vector<SourceText> files{};
};

/// Finds a message type by the name that the file at `from` gives it. The files that were read are in `read`, also when
/// it fails. It may be called from the thread that prepares a reload.
using MessageFinder =
    std::function<Expected<FoundMessage>(std::string_view name, std::string_view from, std::vector<SourceText>* read)>;

/// Reads a Lua file that defines a message.
using LuaMessageReader = std::function<Expected<MessageDefinition>(const SourceText& source, const Project& project)>;

/// Message types are looked for beside the file that names them, in the project's `behaviors/messages/`, then among
/// the installed ones. `Obstacle` is defined by `obstacle.lua`, or by `Obstacle.msg`; `sensor_msgs/Imu` by
/// `sensor_msgs/Imu.msg`, and just `Imu` means it too where only one package has it; a file of IDL defines as many as
/// it has structures.
class MessageFiles {
public:
    MessageFiles(Project project, LuaMessageReader read_lua);

    /// The error says the nearest name. It has a place where a file is wrong, and none where there is no such type.
    Expected<FoundMessage> find(std::string_view name, const std::filesystem::path& from,
                                std::vector<SourceText>* read = nullptr) const;
    /// The names of all types that files define, sorted, as `from` may give them.
    std::vector<std::string> names(const std::filesystem::path& from) const;
    /// All types that files define, by name, as `from` may give them, but those whose files have mistakes. Each file is
    /// read once.
    std::vector<const MessageType*> all(const std::filesystem::path& from) const;
    /// What the file at `path` defines.
    Expected<std::vector<const MessageType*>> types_in(const SourceText& source) const;

private:
    class Search;

    Project project_;
    LuaMessageReader read_lua_;
};

}  // namespace nezumi
