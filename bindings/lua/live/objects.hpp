// The objects of console and scenarios: components, ports and parameters of a running system in Lua.
//
// `X` is a component, found by its name: it stays valid over reloads and restarts. If the component is gone, use is an
// error.
//   X.ports.NAME, X.NAME   a port; X.NAME is a member (see below) if a member has the same name
//   X.status, X:reset()    and all members in engine/tree/member.hpp, also of ports
//   X:command(...)         runs in the component's Lua state; arguments and results are copies of plain data
// Every failure raises an error with its message, in the console and in scenarios.
#pragma once

#include <functional>
#include <lua.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

struct FoundNode;
struct ObjectRef;

/// A component and its system.
struct ComponentAt {
    RunningSystem* live;
    const Component* component;
};

/// A port, its component and its system.
struct PortAt {
    RunningSystem* live;
    const Component* component;
    const Port* port;

    std::string path() const { return component->name() + "." + port->name(); }
};

class Objects {
public:
    /// Opens the objects in a state that has the sandbox's library. `current` is the system for texts such as
    /// "name.port". `who` is the actor of all acts. The objects must be used only while the state exists, and every
    /// system must outlive the state.
    static Expected<std::unique_ptr<Objects>> open(LuaState& state, std::function<RunningSystem&()> current, Actor who);
    ~Objects();
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    /// Sets that the robots are real: teleport, press and disturb are refused.
    void set_hardware(bool hardware) { hardware_ = hardware; }
    /// Sets how reads and acts reach the system: `visit(work)` lets the ticking thread run `work`, which returns true.
    /// `visit` returns false if `work` did not run. Empty: reads and acts run directly.
    void set_visit(std::function<bool(const std::function<bool()>&)> visit) { visit_ = std::move(visit); }
    /// Called before each read and act; its error replaces the result.
    void set_prepare(std::function<Expected<void>()> prepare) { prepare_ = std::move(prepare); }
    /// Called before each change of a parameter; its error replaces the result.
    void set_prepare_change(std::function<Expected<void>()> prepare) { prepare_change_ = std::move(prepare); }
    /// Called with every port that a script reads. Must not throw.
    void on_read(std::function<void(const PortAt&)> read) { on_read_ = std::move(read); }

    // These functions push one object, and may raise a Lua error (memory). Call them without objects that need their
    // destructors, or within a protected call. Names are not checked yet.

    /// The object of a whole system: `world.controller`.
    void push_system(lua_State* L, RunningSystem& live);
    void push_component(lua_State* L, RunningSystem& live, std::string_view name);
    /// Pushes a component of a system that may not be made yet: `place` is null until then, and its address must not
    /// change.
    void push_component(lua_State* L, RunningSystem* const& place, std::string_view name);
    void push_port(lua_State* L, RunningSystem& live, std::string_view component, std::string_view port);

    // These functions read a Lua value and raise no error.

    /// A port object, or a text "name.port" in the current system. The error names the nearest port.
    Expected<PortAt> to_port(lua_State* L, int index) const;
    /// A component object, or its name as a text.
    Expected<ComponentAt> to_component(lua_State* L, int index) const;
    /// The number or boolean that the object at `index` has at a path: "truth.pose.position.x". Nothing for anything
    /// else, also an error.
    std::optional<Value> scalar_at(lua_State* L, int index, std::string_view path) const;
    /// The component of a component object; nothing for anything else, also if there is none now.
    std::optional<ComponentAt> component_of(lua_State* L, int index) const;
    /// A system object; null for anything else.
    static RunningSystem* to_system(lua_State* L, int index);
    /// Applies a method of ports ("inject", "hold", "release") to the port at `index`, with the arguments after it, in
    /// its own visits. Raises no error.
    Expected<void> act_on_port(lua_State* L, int index, std::string_view method) const;

    struct Core;

private:
    Objects();

    /// The node where the value at a path begins, found once for each layout of the system. Null if there is none.
    const FoundNode* find_node(const ObjectRef& ref, std::string_view path) const;

    bool hardware_ = false;
    std::function<void(const PortAt&)> on_read_;
    std::function<bool(const std::function<bool()>&)> visit_;
    std::function<Expected<void>()> prepare_;
    std::function<Expected<void>()> prepare_change_;
    std::unique_ptr<Core> core_;
    friend struct ObjectAccess;
};

}  // namespace nezumi
