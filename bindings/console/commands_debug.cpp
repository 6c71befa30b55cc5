// Commands that look into executions: breakpoints, changes, costs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/profile_text.hpp"
#include "bindings/lua/sandbox/bytecode.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/live/explain.hpp"
#include "engine/tree/node.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// Reads a place such as "keeper.lua:12".
Expected<LineTrace::Watched> read_place(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    LineTrace::Watched place{.file = text.substr(0, colon)};
    if (colon != text.npos) place.line = number_in<int>(text.substr(colon + 1)).value_or(0);
    if (place.file.empty() || place.line < 1)
        return failure(
            fmt::format("expected a file and a line, as in break_at \"keeper.lua:12\", got '{}'", shown(text)));
    return place;
}

std::vector<const ScriptComponent*> scripts_of(const System& system) {
    std::vector<const ScriptComponent*> scripts;
    for (const auto& component : system.components()) {
        if (const auto* script = dynamic_cast<const ScriptComponent*>(component)) scripts.push_back(script);
    }
    return scripts;
}

// The file of this name among the files of a script, as messages show it; "" if the script has none of this name.
std::string file_in(const ScriptComponent& script, const std::string& name) {
    if (is_file(script.script_file()->shown, name)) return script.script_file()->shown;
    for (const ScriptFile& module : script.script().modules()) {
        if (is_file(module.shown, name)) return module.shown;
    }
    return "";
}

// The text of a line of a file; an error if no execution of a behaviour can run it.
Expected<std::string> line_of(const System& system, const LineTrace::Watched& place) {
    std::string files;
    for (const ScriptComponent* script : scripts_of(system)) {
        const std::string file = file_in(*script, place.file);
        if (file.empty()) {
            files += (files.empty() ? "" : ", ") + script->script_file()->shown;
            continue;
        }
        const std::string whole = script->script().text_of(file);
        std::string_view rest = whole;
        for (int line = 1; line < place.line && !rest.empty(); ++line)
            rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
        const std::string line(trimmed(rest.substr(0, rest.find('\n'))));
        const auto chunk = compile(whole, file);
        const std::set<int> lines = chunk ? lines_of_functions(chunk->bytecode) : std::set<int>();
        if (lines.contains(place.line)) return line;
        const auto next = lines.upper_bound(place.line);
        return failure(
            fmt::format("no function runs line {} of {}{}", place.line, file,
                        next == lines.end() ? "" : fmt::format("; the next line that a function runs is {}", *next)));
    }
    return failure(fmt::format("no behaviour runs a file '{}'; there {} {}", shown(place.file),
                               files.find(',') == files.npos ? "is" : "are", files.empty() ? "none" : files));
}

std::string text_of(const LineTrace::Watched& place) { return fmt::format("{}:{}", place.file, place.line); }

}  // namespace

Expected<CommandEnd> command_break_at(Session::Parts& parts, const Arguments& arguments) {
    const auto text = arguments.text(1, "a file and a line");
    if (!text) return Unexpected(text.error());
    const auto place = read_place(*text);
    if (!place) return Unexpected(place.error());
    std::unique_ptr<BreakCondition> condition;
    if (arguments.has(2)) {
        auto read = BreakCondition::of_function(arguments.lua, arguments.index(2));
        if (!read) return Unexpected(read.error());
        condition = std::move(*read);
    }
    const auto line = parts.at_system([&] { return std::optional(line_of(parts.live.system(), *place)); });
    if (!line) return failure("interrupted");
    if (!*line) return Unexpected((*line).error());
    // This line must come before the first execution, which a real robot may make immediately.
    parts.show(fmt::format("{} {}: {}   (unwatch() ends it)",
                           parts.is_hardware ? "traces" : "stops after a tick that runs", text_of(*place), **line));
    parts.at_system([&] {
        std::erase_if(parts.breaks, [&](const LineBreak& each) { return text_of(each.place) == text_of(*place); });
        parts.breaks.push_back({.place = *place, .condition = std::move(condition)});
        watch_lines(parts);
        return true;
    });
    return CommandEnd::done;
}

void watch_lines(Session::Parts& parts) {
    parts.breaks_of = parts.live.generation();
    for (const Component* component : std::as_const(parts.live).system().components()) {
        if (dynamic_cast<const ScriptComponent*>(component) != nullptr) continue;
        component->measure_ticks(parts.profile ? &parts.profile->natives[component->name()] : nullptr);
    }
    for (const ScriptComponent* script : scripts_of(parts.live.system())) {
        std::vector<LineTrace::Watched> lines;
        for (const LineBreak& each : parts.breaks) {
            if (!file_in(*script, each.place.file).empty()) lines.push_back(each.place);
        }
        script->watch_lines(&parts, std::move(lines));
        script->measure_with(nullptr);
        if (!parts.profile) continue;
        const auto measured = parts.profile->components.find(script->name());
        if (measured != parts.profile->components.end()) script->measure_with(&measured->second);
    }
}

void stop_at_breaks(Session::Parts& parts) {
    if (parts.breaks.empty()) return;
    const double now = parts.live.system().now().seconds;
    for (const ScriptComponent* script : scripts_of(parts.live.system())) {
        std::int64_t& seen = parts.break_traces[script->name()];
        const bool is_new = script->traces() != seen;
        seen = script->traces();
        if (!is_new) continue;
        for (const LineTrace::Hit& hit : script->hits()) {
            const auto of = std::find_if(parts.breaks.begin(), parts.breaks.end(), [&](const LineBreak& each) {
                return each.place.line == hit.line && is_file(hit.file, each.place.file);
            });
            if (of == parts.breaks.end()) continue;
            if (of->condition != nullptr) {
                const auto is_true = of->condition->holds(hit.variables);
                if (!is_true) {
                    parts.show(fmt::format("break_at \"{}\" has ended: its condition failed: {}", text_of(of->place),
                                           is_true.error().message));
                    parts.breaks.erase(of);
                    return watch_lines(parts);
                }
                if (!*is_true) continue;
            }
            // Real robots do not stop, so hits are shown at most once a second: more can't be read.
            if (parts.is_hardware && now < of->shown_at + 1) continue;
            of->shown_at = now;
            if (!parts.is_hardware) {
                parts.clock.pause();
                parts.moves = parts.clock.moves();  // a step or run that waits ends now, without an error
            }
            parts.show(fmt::format("{}:{} ran at {:g} s{}", hit.file, hit.line, script->now().seconds,
                                   parts.is_hardware ? "" : ": time is paused"));
            parts.show(to_text(explain(parts.live.system(), *script)));
            break;
        }
    }
}

Expected<CommandEnd> command_watch_changes(Session::Parts& parts, const Arguments& arguments) {
    const auto name = name_of_value(parts, arguments, 1);
    if (!name) return Unexpected(name.error());
    const auto node = parts.live.tree().find(*name);
    if (!node) return Unexpected(node.error());
    if (auto value = node->value(); !value) return Unexpected(value.error());
    const auto same = [&](const ChangeWatch& each) { return each.name == *name; };
    if (std::none_of(parts.changes.begin(), parts.changes.end(), same)) parts.changes.push_back({.name = *name});
    show_change(parts, *std::find_if(parts.changes.begin(), parts.changes.end(), same));
    return CommandEnd::done;
}

bool show_change(Session::Parts& parts, ChangeWatch& watch) {
    const auto node = parts.live.tree().find(watch.name);
    if (!node) return false;
    const auto value = node->value();
    if (!value) return true;
    const auto* plain = std::get_if<Value>(&*value);
    std::string text = plain != nullptr ? short_text(*plain, watch_width) : "";
    if (watch.last == text) return true;
    const double now = parts.live.system().now().seconds;
    parts.show(watch.last ? fmt::format("[{:.3f}] {}: {} -> {}", now, watch.name, *watch.last, text)
                          : fmt::format("[{:.3f}] {} = {}", now, watch.name, text));
    watch.last = std::move(text);
    return true;
}

Expected<CommandEnd> command_profile(Session::Parts& parts, const Arguments& arguments) {
    double seconds = 5;
    if (arguments.has(1)) {
        const auto given = arguments.number(1, "seconds");
        if (!given) return Unexpected(given.error());
        if (!(*given > 0 && *given <= 3600))
            return failure(fmt::format("expected seconds, more than 0 and at most 3600, got {:g}", *given));
        seconds = *given;
    }
    std::string only;
    if (arguments.has(2)) {
        const auto at = parts.objects->to_component(arguments.lua, arguments.index(2));
        if (!at) return Unexpected(at.error());
        only = at->component->name();
        if (dynamic_cast<const ScriptComponent*>(at->component) == nullptr)
            return failure(fmt::format("{} is not a behaviour: it has no lines", only));
    }
    const double now = parts.live.system().now().seconds;
    parts.profile = std::make_unique<ConsoleProfile>();
    parts.profile->by_line = only;
    parts.profile->until = now + seconds;
    for (const ScriptComponent* script : scripts_of(parts.live.system()))
        parts.profile->components[script->name()].by_line = script->name() == only;
    watch_lines(parts);
    if (parts.profile->components.empty() && parts.profile->natives.empty()) {
        parts.profile.reset();
        return failure("there is no component");
    }
    if (parts.clock.is_paused()) parts.show("time is paused: run() lets it go on");
    return CommandEnd::done;
}

void show_profile(Session::Parts& parts) {
    if (!parts.profile || parts.live.system().now().seconds < parts.profile->until - 1e-9) return;
    const auto profile = std::exchange(parts.profile, nullptr);
    watch_lines(parts);
    const double rate = parts.live.system().settings().rate;
    parts.show(cost_table(profile->components, profile->natives, rate));
    const auto only = profile->components.find(profile->by_line);
    if (only == profile->components.end()) return;
    if (only->second.lines.nodes().size() <= 1 && !only->second.times.empty())
        return parts.show(
            fmt::format("the lines were not measured, because a break_at watched them: unwatch() ends break_at"));
    parts.show(
        fmt::format("measuring each line takes time itself: without it {} is faster than shown", profile->by_line));
    for (const ScriptComponent* script : scripts_of(parts.live.system())) {
        if (script->name() != profile->by_line) continue;
        parts.show(
            line_table(only->second.lines, [&](const std::string& file) { return script->script().text_of(file); }));
    }
}

}  // namespace nezumi
