// The object `s` of a scenario in Lua.
#pragma once

#include <lua.hpp>

#include "bindings/scenario/scenario_run.hpp"

namespace nezumi {

/// The result of the C++ part of a method, for its Lua part.
enum Answered : int {
    raise_text = -1,  ///< raise the stored text as a Lua error
    end_run = -2,     ///< the run has ended: Lua code must not run any more
    // 0 and more: the number of results on the stack
};

struct ScenarioRun::Methods {
    /// Pushes the Lua object of `run`, which has these methods. May raise a Lua error.
    static void push_object(lua_State* lua, ScenarioRun& run);
    /// The names of all methods, sorted.
    static std::vector<std::string_view> names(const PeerWords& peer_words);

    using Function = int (*)(ScenarioRun& run, lua_State* lua);
    struct Method {
        const char* name;
        Function function;
        int most = 0;  ///< arguments at most
        std::string usage = "()";
    };
    /// Methods about time and expectations, and methods that act.
    static const std::vector<Method>& of_time();
    static const std::vector<Method>& of_acts();

    // Functions for both groups.
    static int raise(ScenarioRun& run, std::string text) {
        run.file_.state().kept_error = std::move(text);
        return raise_text;
    }
    /// The seconds at `index`, or `otherwise` if there is nothing.
    static Expected<double> seconds(lua_State* lua, int index, std::string_view what, const double* otherwise);
    static bool fails(ScenarioRun& run, lua_State* lua, std::string text);

private:
    static int call(lua_State* lua);
    static int index(lua_State* lua);
    static int newindex(lua_State* lua);
    static int find_member(ScenarioRun& run, lua_State* lua);
    static int carry_out(ScenarioRun& run, lua_State* lua, const Method& method);
    static void note_diagnostic(ScenarioRun& run, lua_State* lua);

    static int expect(ScenarioRun& run, lua_State* lua, Expectation::Kind kind);
    template <Expectation::Kind kind>
    static int expect_as(ScenarioRun& run, lua_State* lua) {
        return expect(run, lua, kind);
    }
    static int run_seconds(ScenarioRun& run, lua_State* lua);
    static std::optional<int> wrong_message(ScenarioRun& run, lua_State* lua, int index);
    static int check(ScenarioRun& run, lua_State* lua);
    static int near(ScenarioRun& run, lua_State* lua);
    static int equal(ScenarioRun& run, lua_State* lua);
    static int measure(ScenarioRun& run, lua_State* lua);
    static int now(ScenarioRun& run, lua_State* lua);

    static int any(ScenarioRun& run, lua_State* lua);
    static int golden(ScenarioRun& run, lua_State* lua);
    static int load(ScenarioRun& run, lua_State* lua);
    static int recorded(ScenarioRun& run, lua_State* lua);
    static int judge(ScenarioRun& run, lua_State* lua);
    static int reload(ScenarioRun& run, lua_State* lua);
    static int act_on_port(ScenarioRun& run, lua_State* lua, std::string_view word);
    static int release(ScenarioRun& run, lua_State* lua);
    static int port_fault(ScenarioRun& run, lua_State* lua, Override kind);
    static int disturb(ScenarioRun& run, lua_State* lua);
    static int press(ScenarioRun& run, lua_State* lua);
    static int teleport(ScenarioRun& run, lua_State* lua);
    static int restore(ScenarioRun& run, lua_State* lua);
    static int allow_error(ScenarioRun& run, lua_State* lua);
    static int act(ScenarioRun& run, const Act& act);
};

}  // namespace nezumi
