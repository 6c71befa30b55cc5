// Commands that show components, ports, help and errors.
#include <fmt/format.h>

#include <cctype>

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/inspect.hpp"
#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/help_text.hpp"
#include "engine/live/live_text.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

constexpr std::size_t most_listed = 40;  // components in a list

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

// Finds named objects whose line contains a text.
class Finder {
public:
    explicit Finder(std::string_view text) : text_(lower(text)) {}

    void offer(const std::string& name, const std::string& doc, const std::string& line) {
        if (lower(name).find(text_) == std::string::npos && lower(doc).find(text_) == std::string::npos) return;
        result_ += (result_.empty() ? "" : "\n") + line;
        if (!doc.empty()) result_ += "  " + doc.substr(0, doc.find('\n'));
    }
    const std::string& result() const { return result_; }

private:
    std::string text_;
    std::string result_;
};

void find_in(Finder& finder, const Component& component) {
    const std::string& name = component.name();
    finder.offer(name + " " + component.type(), "", fmt::format("{}  {}", name, component_title(component)));
    for (const Port* port : ports_of(component))
        finder.offer(name + "." + port->name() + " " + std::string(port->type_name()), port->doc(),
                     fmt::format("{}.{}  {} {}", name, port->name(), port->direction() == Direction::in ? "in" : "out",
                                 port->type_name()));
    for (const auto& parameter : component.parameters().all()) {
        finder.offer(parameter.spec.name, parameter.spec.doc,
                     fmt::format("{}.config.{} = {}", name, parameter.spec.name, lua_text(parameter.value)));
    }
    for (const CommandDeclaration& command : component.commands())
        finder.offer(command.name, command.doc, fmt::format("{}:{}(...)", name, command.name));
}

std::string help_line(const ConsoleCommand& command) { return fmt::format("  {:40} {}", command.usage, command.help); }

// The command that the argument means: its function, or its name. Null for anything else.
const ConsoleCommand* command_asked(const Arguments& arguments) {
    if (const ConsoleCommand* command = command_at(arguments.lua, 1)) return command;
    if (lua_type(arguments.lua, 1) != LUA_TSTRING) return nullptr;
    return find_console_command(text_at(arguments.lua, 1));
}

// The help text for the argument. Returns an error if the argument has none.
Expected<std::string> help_asked(Session::Parts& parts, const Arguments& arguments) {
    const auto help_of = [&](const auto& find) {
        return parts.at_system([&]() -> Expected<std::string> {
            const Expected<TreeNode> node = find();
            return node ? Expected<std::string>(help_text(*node)) : Unexpected(node.error());
        });
    };
    if (const ObjectRef* ref = to_object(arguments.lua, 1)) {
        if (ref->kind == ObjectKind::system) return failure("help() lists the commands, ls() shows the system");
        if (ref->kind == ObjectKind::remote) return text_of_host(*parts.objects, *ref, Question::What::help);
        if (ref->kind >= ObjectKind::hosts)
            return failure("there is no help for hosts: the input `hosts` shows the other hosts and their components");
        return help_of([&] { return node_of(*ref); });
    }
    const auto name = arguments.text(1, "a command, a component, a port or a name, as in help \"mouse.status\"");
    if (!name) return Unexpected(name.error());
    const std::vector<std::string> components = component_names(parts);
    if (name->find_first_of(".:") != std::string::npos || contains(components, *name))
        return help_of([&] { return parts.live.tree().find(*name); });
    std::vector<std::string_view> names(components.begin(), components.end());
    for (const ConsoleCommand& command : console_commands()) names.emplace_back(command.name);
    return failure(fmt::format("there is no command or component '{}'{}", shown(*name), did_you_mean(*name, names)));
}

// A line for each function that was running: "  keeper.lua:9 turn: angle = 0.5, near = true".
std::string frames_text(const ErrorFrames& frames) {
    std::vector<std::string> lines;
    for (const ErrorFrames::Frame& frame : frames.all) {
        std::string locals;
        for (const auto& each : frame.locals)
            locals += fmt::format("{}{} = {}", locals.empty() ? ": " : ", ", each.name, each.text);
        lines.push_back(visible(
            fmt::format("  {}:{}{}{}{}", frame.file, frame.line, frame.name.empty() ? "" : " ", frame.name, locals)));
    }
    return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

Expected<CommandEnd> command_ls(Session::Parts& parts, const Arguments& arguments) {
    if (auto peer = peer_named(arguments, 1)) return ask_peers(parts, {.name = std::move(*peer)});
    if (arguments.has(1)) {
        const auto text = parts.at_system([&]() -> Expected<std::string> {
            const auto at = parts.objects->to_component(arguments.lua, 1);
            if (!at) return Unexpected(at.error());
            return component_text(parts.live.system(), *at->component);
        });
        if (!text) return Unexpected(text.error());
        parts.show(*text);
        return CommandEnd::done;
    }
    std::string text;
    std::size_t listed = 0;
    const std::vector<std::string> names = component_names(parts);
    for (const std::string& name : names) {
        if (listed++ == most_listed) {
            text += fmt::format("\nand {} more: ls \"name\" shows one", names.size() - most_listed);
            break;
        }
        text += (text.empty() ? "" : "\n") + parts.at_system([&]() -> std::string {
            const Component* component = parts.live.system().find(name);
            return component != nullptr ? component_text(parts.live.system(), *component) : "";
        });
    }
    parts.show(text.empty() ? "the system is empty" : text);
    return CommandEnd::done;
}

Expected<CommandEnd> command_find(Session::Parts& parts, const Arguments& arguments) {
    const auto text = arguments.text(1, "a part of a name, as in find \"vel\"");
    if (!text) return Unexpected(text.error());
    Finder finder(*text);
    for (const std::string& name : component_names(parts)) {
        parts.at_system([&] {
            const Component* component = parts.live.system().find(name);
            if (component != nullptr) find_in(finder, *component);
            return component != nullptr;
        });
    }
    for (const ConsoleCommand& command : console_commands()) finder.offer(command.name, "", help_line(command));
    parts.show(finder.result().empty() ? fmt::format("nothing has '{}' in its name", shown(*text)) : finder.result());
    return CommandEnd::done;
}

Expected<CommandEnd> command_errors(Session::Parts& parts, const Arguments&) {
    std::string text;
    const auto add = [&text](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
    const ActTime now = parts.live.when();
    const double seconds = parts.live.system().now().seconds;
    for (const LogLine& line : parts.clock.problems()) {
        // After a seek into the past, lines from after this moment are left out.
        const bool is_later = line.start > now.start || (line.start == now.start && line.seconds > seconds);
        if (parts.live.is_past() && is_later) continue;
        const std::string start = line.start == parts.live.starts() ? "" : fmt::format("start {}, ", line.start);
        add(fmt::format("[{}{:.3f}] {}{}{}: {}", start, line.seconds, to_text(line.level),
                        line.component.empty() ? "" : " ", line.component, visible_message(line.text)));
    }
    for (const auto& component : parts.live.system().components()) {
        if (component->state() != LifeState::error) continue;
        const Error& error = component->last_error();
        add(fmt::format("{} is in ERROR: {}", component->name(), visible_message(describe(error))));
        // A single function without variables is left out: the error's location already shows it.
        if (error.frames && (error.frames->all.size() > 1 || !error.frames->all.front().locals.empty()))
            add(frames_text(*error.frames));
    }
    parts.show(text.empty() ? "no errors" : text);
    return CommandEnd::done;
}

Expected<CommandEnd> command_help(Session::Parts& parts, const Arguments& arguments) {
    if (arguments.has(1)) {
        if (const ConsoleCommand* command = command_asked(arguments)) {
            parts.show(fmt::format("{}: {}", command->usage, command->help));
            return CommandEnd::done;
        }
        const auto text = help_asked(parts, arguments);
        if (!text) return Unexpected(text.error());
        parts.show(*text);
        return CommandEnd::done;
    }
    std::string text =
        "Lua, with the system's components by name: mouse, mouse.ir_sensor_out, controller.config.NAME = "
        "value,\ncontroller:activate(). A port is shown with its value, type, age and peers.";
    for (const ConsoleCommand& command : console_commands()) text += "\n" + help_line(command);
    parts.show(text);
    return CommandEnd::done;
}

Expected<CommandEnd> command_print(Session::Parts& parts, const Arguments& arguments) {
    std::string line;
    InspectWork work;
    for (int i = 1; i <= arguments.count(); ++i) {
        if (i > 1) line += '\t';
        line += inspect(arguments.lua, i, {.quote = false, .work = &work});
    }
    parts.show(line);
    return CommandEnd::done;
}

}  // namespace nezumi
