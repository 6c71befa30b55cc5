// Makes message types from the definitions in a recording. A message is defined after the messages that it contains.
#include "bindings/cli/files/ros_definition.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

#include "engine/base/trimmed.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/messages/msg_file.hpp"

namespace nezumi::cli {
namespace {

// "geometry_msgs/msg/Point" becomes "geometry_msgs/Point".
std::string short_ros_name(std::string_view name) {
    const std::size_t first = name.find('/'), last = name.rfind('/');
    if (first == last) return std::string(name);
    return fmt::format("{}/{}", name.substr(0, first), name.substr(last + 1));
}

class SchemaReader {
public:
    explicit SchemaReader(const record::Schema& schema) {
        std::string name = short_ros_name(schema.name);
        std::string_view rest = schema.text;
        for (;;) {
            const std::size_t line = rest.find("\n====");
            texts_.emplace(name, rest.substr(0, line));
            if (line == rest.npos) break;
            const std::size_t message = rest.find("MSG:", line);
            if (message == rest.npos) break;
            const std::size_t end = std::min(rest.find('\n', message), rest.size());
            name = short_ros_name(trimmed(rest.substr(message + 4, end - message - 4)));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }

    Expected<const MessageType*> define(const std::string& name, int depth = 0) {
        const auto text = texts_.find(name);
        if (text == texts_.end()) return failure(fmt::format("the recording does not define {}", shown(name)));
        if (depth > most_message_depth) return failure(fmt::format("{} contains itself", shown(name)));
        const std::size_t slash = name.find('/');
        const std::string package = slash == name.npos ? "" : name.substr(0, slash);
        const std::string file = name.substr(slash == name.npos ? 0 : slash + 1) + ".msg";
        const auto message = read_msg({file, file, std::string(text->second)}, package);
        if (!message) return Unexpected(message.error());
        return MessageCatalog::shared().define(*message, [&](const FieldDefinition& field) -> Expected<const Type*> {
            const auto inner = define(short_ros_name(field.kind), depth + 1);
            if (!inner) return Unexpected(inner.error());
            return (*inner)->payload;
        });
    }

private:
    std::map<std::string, std::string_view, std::less<>> texts_;
};

}  // namespace

Expected<const MessageType*> type_of_definition(const record::Schema& schema) {
    if (schema.encoding != "ros2msg") {
        return failure(schema.name.empty()
                           ? std::string("it has no definition")
                           : fmt::format("its definition is in {}, not ros2msg", shown(schema.encoding)));
    }
    auto type = SchemaReader(schema).define(short_ros_name(schema.name));
    return type ? type : failure(type.error().message);
}

}  // namespace nezumi::cli
