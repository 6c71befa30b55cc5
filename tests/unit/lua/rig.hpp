// A scripted component with nothing around it: messages go in, ticks pass, messages come out.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/script/script_component.hpp"

namespace nezumi {

inline SourceText source(std::string text, const std::string& file = "robot_controller.lua") {
    return {"behaviors/" + file, file, std::move(text)};
}

// What loading this text says: "" when it loads.
inline std::string refusal(std::string text, ScriptContext context = {}) {
    auto component = ScriptComponent::load("controller", source(std::move(text)), std::move(context));
    return component ? "" : describe(component.error());
}

struct ScriptRig {
    explicit ScriptRig(std::string text, ScriptContext context = {}, const std::string& file = "robot_controller.lua") {
        auto loaded = ScriptComponent::load("controller", source(std::move(text), file), std::move(context));
        if (!loaded) FAIL(describe(loaded.error()));
        component = std::move(*loaded);
        component->set_log(
            [this](const LogLine& line) { log.push_back(std::string(to_text(line.level)) + ": " + line.text); });
    }

    ScriptRig& activate() {
        if (auto ok = component->activate(now); !ok) WARN(describe(ok.error()));
        return *this;
    }

    void tick(int count = 1) {
        for (; count > 0; --count) {
            component->latch_inputs(now);
            component->execute(now);
            component->latch_outputs(now);
            ++now.tick;
            now.seconds = static_cast<double>(now.tick) / 100;
        }
    }

    template <class T>
    void feed(std::string_view port, T value) {
        REQUIRE(component->find_in_port(port) != nullptr);
        component->find_in_port(port)->inject(Value(std::move(value)));
    }

    template <class T>
    OutPort<T>& out(std::string_view port) {
        REQUIRE(component->find_out_port(port) != nullptr);
        return dynamic_cast<OutPort<T>&>(*component->find_out_port(port));
    }

    // What went wrong last, as a person reads it.
    std::string error() const { return describe(component->last_error()); }
    std::string status() const { return std::string(to_text(component->state())); }

    Time now;
    std::vector<std::string> log;
    std::unique_ptr<ScriptComponent> component;
};

// What one execution of this body says when it fails; "" when it does not. Ports `a` (in), `b` (out) and so on as in
// `head`.
inline std::string failure_of(const std::string& head, const std::string& body) {
    ScriptRig rig(head + "\nfunction on_execute()\n" + body + "\nend\n");
    rig.activate().tick();
    return rig.status() == "ERROR" ? rig.error() : "";
}

}  // namespace nezumi
