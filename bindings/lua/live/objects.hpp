// A component as seen from outside: the one object model of console and scenarios, opened in a Lua state.
//
// `X` is a component by its name: it stays valid over reloads and restarts, and says so when the component is gone.
//   X.ports.NAME, X.NAME   a port; X.NAME gives way to the members below, X.ports.NAME never
//   X.status, X:reset()    and all that engine/tree/member.hpp lists, of ports too
//   X:command(...)         runs in the component's own state; arguments and results are copies of plain data
// Whatever fails raises an error with its message, in the console as in scenarios.
#pragma once

#include <functional>
#include <lua.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// A component, and the system it is in.
struct ComponentAt {
    RunningSystem* live;
    const Component* component;
};

/// A port, whose it is, and the system it is in.
struct PortAt {
    RunningSystem* live;
    const Component* component;
    const Port* port;

    std::string path() const { return component->name() + "." + port->name(); }
};

class Objects {
public:
    /// Opens the objects in a state that has the sandbox's library. `current` is the system in which texts as
    /// "name.port" are looked up; what is done to a system is an act of `who`. The objects must outlive the state's
    /// use, and every system given to them must outlive the state.
    static Expected<std::unique_ptr<Objects>> open(LuaState& state, std::function<RunningSystem&()> current, Actor who);
    ~Objects();
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    /// Real robots: they can't be teleported, pressed or pushed from here.
    void set_hardware(bool hardware) { hardware_ = hardware; }
    /// How a member's look or act comes to the system: `visit` has it done, by the thread that ticks, and returns false
    /// when it was not. Empty: it is done where it is.
    void set_visit(std::function<bool(const std::function<void()>&)> visit) { visit_ = std::move(visit); }
    /// Is called before each look and act, whose error its own is.
    void set_prepare(std::function<Expected<void>()> prepare) { prepare_ = std::move(prepare); }
    /// Is called before each change of a parameter, whose error its own is.
    void set_prepare_change(std::function<Expected<void>()> prepare) { prepare_change_ = std::move(prepare); }
    /// Is called with every port that a script looks at. Must not throw.
    void on_read(std::function<void(const PortAt&)> read) { on_read_ = std::move(read); }

    // These push one object, and may raise a Lua error (memory): with nothing alive that needs its destructor, or
    // within a protected call. The names are not looked up yet.

    /// All of a system by name: `world.controller`.
    void push_system(lua_State* L, RunningSystem& live);
    void push_component(lua_State* L, RunningSystem& live, std::string_view name);
    /// The same of a system that is perhaps not made yet: `place` is null until then, and stays where it is.
    void push_component(lua_State* L, RunningSystem* const& place, std::string_view name);
    void push_port(lua_State* L, RunningSystem& live, std::string_view component, std::string_view port);

    // These read a value of Lua and raise nothing.

    /// A port object, or the text "name.port" in the current system. The error names the nearest.
    Expected<PortAt> to_port(lua_State* L, int index) const;
    /// A component object, or its name as a text.
    Expected<ComponentAt> to_component(lua_State* L, int index) const;
    /// A system object; null for anything else.
    static RunningSystem* to_system(lua_State* L, int index);
    /// Does what a method of ports is called ("inject", "hold", "release") to the port at `index`, with the arguments
    /// that follow it, in visits of its own. Raises nothing.
    Expected<void> act_on_port(lua_State* L, int index, std::string_view method) const;

    struct Core;

private:
    Objects();

    bool hardware_ = false;
    std::function<void(const PortAt&)> on_read_;
    std::function<bool(const std::function<void()>&)> visit_;
    std::function<Expected<void>()> prepare_;
    std::function<Expected<void>()> prepare_change_;
    std::unique_ptr<Core> core_;
    friend struct ObjectAccess;
};

}  // namespace nezumi
