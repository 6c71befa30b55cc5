// Checks each declaration of a file: its name, and that it is declared once.
#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/script/script_ports.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

constexpr std::size_t longest_name = 100;
constexpr std::size_t most_of_a_kind = 1000;

Expected<void> check_count(std::size_t count, std::string_view kind, std::string_view name, std::string_view kinds) {
    if (count < most_of_a_kind) return {};
    return failure(fmt::format("{} '{}': a component can have at most {} {}", kind, name, most_of_a_kind, kinds));
}

// " (first in line 3)" for the place of an earlier declaration; "" if its line is unknown.
std::string first_in(const Place& place) {
    return place.line > 0 ? fmt::format(" (first in line {})", place.line) : "";
}

}  // namespace

Expected<void> Script::check_loading(std::string_view function) const {
    if (phase_ == Phase::loading) return {};
    return failure(fmt::format("{} can only be called while the file loads", function));
}

Expected<void> Script::check_name(std::string_view kind, std::string_view name, bool keyword_allowed) const {
    if (!is_identifier(name) && !(keyword_allowed && is_keyword(name))) {
        const std::string_view keyword =
            is_keyword(name) ? ": it is a keyword of Lua" : ": use letters, digits and _, no digit first";
        return failure(fmt::format("{} '{}': the name is not an identifier{}", kind, shown(name), keyword));
    }
    if (name.size() > longest_name) return failure(fmt::format("{} '{}': the name is too long", kind, shown(name)));
    if (contains(script_globals(), name) || contains(names_taken_by_components(), name)) {
        return failure(fmt::format(
            "{0} '{1}': the name is already used in every component: choose another, as 'my_{1}'", kind, name));
    }
    if (contains(sandbox_names(), name))
        return failure(fmt::format("{} '{}': the name is already used by Lua's library", kind, name));
    return {};
}

Expected<PortSlot*> Script::declare_port(PortDeclaration declaration) {
    const std::string_view function = declaration.direction == Direction::in ? "input" : "output";
    if (auto ok = check_loading(function); !ok) return Unexpected(ok.error());
    if (auto ok = check_name(function, declaration.name, true); !ok) return Unexpected(ok.error());
    if (auto ok = check_count(ports_.size(), function, declaration.name, "ports"); !ok) return Unexpected(ok.error());
    for (const PortDeclaration& other : ports_) {
        if (other.name != declaration.name) continue;
        if (other.direction == declaration.direction) {
            return failure(fmt::format("{} is declared twice{}", port_title(declaration), first_in(other.place)));
        }
        return failure(fmt::format("{}: the name is already used by {}{}", port_title(declaration), port_title(other),
                                   first_in(other.place)));
    }
    for (const CommandDeclaration& other : commands_) {
        if (other.name == declaration.name) {
            return failure(fmt::format("{}: the name is already used by command '{}'{}", port_title(declaration),
                                       other.name, first_in(other.place)));
        }
    }
    ports_.push_back(std::move(declaration));
    slots_.push_back({.script = this,
                      .declaration = &ports_.back(),
                      .is_read_in_place = contains(code_->in_place, ports_.back().name)});
    return &slots_.back();
}

Expected<void> Script::declare_parameter(ParameterSpec spec) {
    if (auto ok = check_loading("param"); !ok) return ok;
    if (auto ok = check_name("parameter", spec.name, false); !ok) return ok;
    if (auto ok = check_count(parameters_.all().size(), "parameter", spec.name, "parameters"); !ok) return ok;
    if (const auto* other = parameters_.find(spec.name)) {
        return failure(fmt::format("parameter '{}' is declared twice{}", spec.name, first_in(other->spec.place)));
    }
    const std::string name = spec.name;
    if (auto ok = parameters_.declare(std::move(spec)); !ok) return failure(ok.error().message);
    // A value that does not fit is not an error of the script; the system file or the reload reports it.
    if (inheritance_.parameters != nullptr) {
        parameters_.adopt(*inheritance_.parameters, name);
    } else if (const auto given = context_.configured.find(name); given != context_.configured.end()) {
        static_cast<void>(parameters_.set(name, given->second));
    }
    return {};
}

Expected<void> Script::declare_command(CommandDeclaration declaration, int function) {
    if (auto ok = check_loading("command"); !ok) return ok;
    if (auto ok = check_name("command", declaration.name, false); !ok) return ok;
    if (auto ok = check_count(commands_.size(), "command", declaration.name, "commands"); !ok) return ok;
    // Unlike a port, a command must not have the name of a member of any kind of component.
    if (find_member(component_members(), declaration.name) != nullptr)
        return failure(fmt::format("command '{0}': components have a member '{0}' already: choose another name",
                                   declaration.name));
    for (const CommandDeclaration& other : commands_) {
        if (other.name == declaration.name) {
            return failure(fmt::format("command '{}' is declared twice{}", declaration.name, first_in(other.place)));
        }
    }
    for (const PortDeclaration& port : ports_) {
        if (port.name == declaration.name) {
            return failure(fmt::format("command '{}': the name is already used by {}{}", declaration.name,
                                       port_title(port), first_in(port.place)));
        }
    }
    commands_.push_back(std::move(declaration));
    command_functions_.push_back(function);
    return {};
}

Expected<void> Script::declare_about(ScriptAbout about) {
    if (auto ok = check_loading("about"); !ok) return ok;
    if (about_.given) return failure("about: a file can have only one");
    about_ = std::move(about);
    return {};
}

Expected<void> Script::declare_task(Task task) {
    if (auto ok = check_loading("task"); !ok) return ok;
    if (auto ok = check_name("task", task.name, false); !ok) return ok;
    if (auto ok = check_count(tasks_.all().size(), "task", task.name, "tasks"); !ok) return ok;
    return tasks_.declare(std::move(task));
}

Expected<void> Script::check_tasks_run(std::string_view function) const {
    if (phase_ == Phase::loading) return failure(fmt::format("{} can't be called while the file loads", function));
    if (owner_->state() == LifeState::active) return {};
    return failure(fmt::format("{}: tasks run only while the component is ACTIVE, and it is {}", function,
                               to_text(owner_->state())));
}

Expected<std::size_t> Script::check_hook(std::string_view name, std::string_view type) const {
    const auto& names = hook_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        if (name.starts_with("on_"))
            return failure(fmt::format("unknown callback '{}'{}", name, did_you_mean(name, names)));
        return failure(fmt::format("global '{}' is assigned: is a `local` missing?", name));
    }
    if (phase_ != Phase::loading) return failure(fmt::format("{} can only be defined while the file loads", name));
    if (!loading_modules_.empty())
        return failure(fmt::format("{} can't be defined in a module: it belongs in the component's file", name));
    const auto hook = static_cast<std::size_t>(Hook::on_activated) + static_cast<std::size_t>(found - names.begin());
    if (hooks_[hook] != LUA_NOREF)
        return failure(fmt::format("{} is defined twice (first in line {})", name, hook_lines_[hook]));
    if (type != "function") return failure(fmt::format("{} expected a function, got {}", name, type));
    return hook;
}

void Script::set_hook(std::size_t hook, int function, int line) {
    hooks_[hook] = function;
    hook_lines_[hook] = line;
}

int Script::hook_function(std::string_view name) const {
    const auto& names = hook_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return LUA_NOREF;
    const int function =
        hooks_[static_cast<std::size_t>(Hook::on_activated) + static_cast<std::size_t>(found - names.begin())];
    return function == LUA_NOREF ? LUA_REFNIL : function;
}

}  // namespace nezumi
