// The objects of a live system in a sandbox: `world`, `mouse`, `controller`, and the words that take a port.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "tests/unit/live_rig.hpp"
#include "tests/unit/lua/sandbox_support.hpp"

namespace nezumi {

struct Objective : LiveRig {
    Objective() : Objective(counter_system) {}
    explicit Objective(const std::string& system,
                       const std::map<std::string, std::string>& behaviors = {{"counter", counter_behavior}})
        : LiveRig(system, behaviors) {
        objects = std::move(
            Objects::open(*box.state, [this]() -> RunningSystem& { return *live; }, {Actor::Kind::console}).value());
        const auto opened = protect(box.lua(), Budget{1.0}, [this](lua_State* L) {
            lua_pushglobaltable(L);
            for (const char* word : {"inject", "hold", "release"}) {
                lua_pushlightuserdata(L, objects.get());
                lua_pushstring(L, word);
                lua_pushcclosure(L, act_on_port, 2);
                lua_setfield(L, -2, word);
            }
            objects->push_system(L, *live);
            lua_setfield(L, -2, "world");
            for (const char* name : {"mouse", "controller"}) {
                objects->push_component(L, *live, name);
                lua_setfield(L, -2, name);
            }
            return 0;
        });
        if (!opened) throw std::runtime_error(describe(opened.error()));
    }

    std::string run(const std::string& text) { return box.run(text); }

    // A word as consoles and scenarios have it.
    static int act_on_port(lua_State* L) {
        return bridge(L, [&] {
            const auto& all = *static_cast<const Objects*>(lua_touserdata(L, lua_upvalueindex(1)));
            return all.act_on_port(L, 1, lua_tostring(L, lua_upvalueindex(2)));
        });
    }

    Box box;
    std::unique_ptr<Objects> objects;
};

}  // namespace nezumi
