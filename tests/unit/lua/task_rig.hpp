// A script with tasks, which writes down what it does and when.
#pragma once

#include "tests/unit/leaf_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"
#include "tests/unit/lua/rig.hpp"

namespace nezumi {

// `note(text)` writes down when, `out` shows all of it.
inline const Text notes = R"(
local out = output("out", "TimedString")
local near = input("near", "TimedLong")
state.text = state.text or ""
local function note(text) state.text = state.text .. ("%s@%.2f "):format(text, now()) out:write(state.text) end
command("begin", function(name) start(name) end)
command("give_up", function(name) return cancel(name) end)
)";

struct TaskRig : ScriptRig {
    explicit TaskRig(const Text& text) : ScriptRig(notes + text) { activate(); }
    Text noted() { return out<Text>("out").read(); }
    // What a call of a command says: "" when it is well.
    Text call(const Text& command, const Text& name) {
        PlainData arguments;
        arguments.values.emplace_back(name);
        auto results = component->call_command(command, arguments, now);
        if (!results) return describe(results.error());
        return results->values.empty() ? "" : results->values.front().get<bool>() ? "true" : "false";
    }
    // A field of a task as seen from outside; "nil" when it is not there.
    Text seen(const Text& task, const Text& field) {
        Text text = "nil";
        component->visit_member("tasks", [&](const LeafPath& path, const ValueView& leaf) {
            if (path.text() != task + "." + field) return;
            text = text_of(leaf);
        });
        return text;
    }
};

}  // namespace nezumi
