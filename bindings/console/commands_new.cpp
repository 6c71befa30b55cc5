// The command that writes a new behaviour into the project, as `nezumi new behavior` does.
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/file_to_write.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 5> fields{"inputs", "outputs", "params", "callbacks", "doc"};

Expected<std::vector<std::string>> read_texts(const FileTable& table, std::string_view field) {
    std::vector<std::string> texts;
    const Value* const value = table.find(field);
    if (value == nullptr) return texts;
    const auto refused =
        failure(fmt::format("{}: expected a list of strings, as in {{ \"distance:TimedShortSeq\" }}", field));
    if (value->get_if<FileTable>() == nullptr || !value->get_if<FileTable>()->fields.empty()) return refused;
    for (const Value& element : value->get_if<FileTable>()->elements) {
        if (element.get_if<std::string>() == nullptr) return refused;
        texts.push_back(*element.get_if<std::string>());
    }
    return texts;
}

Expected<BehaviorRequest> read_behavior_request(const std::string& name, const FileTable& table) {
    BehaviorRequest request{.name = name};
    for (const FileField& field : table.fields) {
        if (contains(fields, field.name)) continue;
        return failure(fmt::format("there is no field '{}'{}; known are {}", shown(field.name),
                                   did_you_mean(field.name, {fields.begin(), fields.end()}), fmt::join(fields, ", ")));
    }
    if (const Value* doc = table.find("doc"); doc != nullptr) {
        if (doc->get_if<std::string>() == nullptr) return failure("doc: expected a string");
        request.doc = *doc->get_if<std::string>();
    }
    for (const auto& [field, texts] :
         {std::pair{"inputs", &request.inputs}, std::pair{"outputs", &request.outputs},
          std::pair{"params", &request.parameters}, std::pair{"callbacks", &request.callbacks}}) {
        auto read = read_texts(table, field);
        if (!read) return Unexpected(read.error());
        *texts = std::move(*read);
    }
    return request;
}

}  // namespace

Expected<CommandEnd> command_new(Session::Parts& parts, const Arguments& arguments) {
    if (!parts.options.author) return failure("this program can't write files: use `nezumi run`");
    const auto name = read_file_value(arguments.lua, arguments.index(1));
    if (!name) return Unexpected(name.error());
    if (arguments.count() < 1 || name->get_if<std::string>() == nullptr)
        return failure("expected a name, as in new \"line_follower\" { inputs = { \"light:TimedShortSeq\" } }");
    if (arguments.count() < 2) return CommandEnd::table;
    const auto table = read_file_value(arguments.lua, arguments.index(2));
    if (!table) return Unexpected(table.error());
    if (table->get_if<FileTable>() == nullptr)
        return failure("expected a table of " + fmt::format("{}", fmt::join(fields, ", ")));
    const auto request = read_behavior_request(*name->get_if<std::string>(), *table->get_if<FileTable>());
    if (!request) return Unexpected(request.error());
    const auto home = parts.at_system([&] { return writable_folder(parts.live.project(), parts.live.spec().file); });
    if (home.empty()) return failure("interrupted");
    const auto written = parts.options.author(home, *request);
    if (!written) return Unexpected(written.error());
    parts.show(fmt::format("wrote {}", fmt::join(*written, ", ")));
    return CommandEnd::done;
}

}  // namespace nezumi
