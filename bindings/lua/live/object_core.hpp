// What the objects' files share: the userdata behind an object, and the way from an answer in C++ to a value in Lua.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/plain_data.hpp"

namespace nezumi {

enum class ObjectKind : unsigned char {
    system,
    component,
    ports,
    port,
    config,
    truth,
    hosts,
    host,    ///< its component's name is the host's
    remote,  ///< of another host: a component, "host/name", or what its "port" leads to: "config", "current_vel"
};
inline constexpr std::size_t object_kinds = 9;

/// The start of an object's userdata: it refers by name, so that it outlives reloads and restarts. The names follow it
/// in the same block.
struct ObjectRef {
    Objects* objects;
    RunningSystem* built;         // null: the system is made later, and stands then in
    RunningSystem* const* place;  // this place
    std::uint32_t component_length;
    std::uint32_t port_length;
    ObjectKind kind;

    RunningSystem* live() const { return built != nullptr ? built : *place; }
    std::string_view component() const { return {reinterpret_cast<const char*>(this + 1), component_length}; }
    std::string_view port() const { return {reinterpret_cast<const char*>(this + 1) + component_length, port_length}; }
};

/// An object that is to be pushed.
struct ObjectName {
    ObjectKind kind;
    RunningSystem* live;
    std::string component;
    std::string port;
};

/// A method of an object, or a command of a component.
struct MethodName {
    lua_CFunction function;
    std::string name;
};

/// All that a member of an object can be: a value (plain data: each of its values), a part of a table, or what has
/// members itself.
using Answer = std::variant<Value, PlainSnapshot, ObjectName, MethodName>;

/// Whose the tables of an answer are: the caller's, or a copy that can't be written.
enum class Tables : bool { own, locked };

/// What lives in C++ between the moment an answer is found and the moment it is pushed: a Lua error may jump over that
/// without harm.
struct Objects::Core {
    LuaState* state = nullptr;
    std::function<RunningSystem&()> current;
    Actor who;
    Answer answer;
};

/// The door to what is private in `Objects`.
struct ObjectAccess {
    static Objects::Core& core(Objects& objects) { return *objects.core_; }
    static const Actor& who(const Objects& objects) { return objects.core_->who; }
    static bool hardware(const Objects& objects) { return objects.hardware_; }
    static Expected<void> prepare_change(const Objects& objects) {
        return objects.prepare_change_ ? objects.prepare_change_() : Expected<void>();
    }
    /// Runs `body()` where the system may be looked at and acted on.
    template <class Body>
    static Expected<Answer> visit(const Objects& objects, Body&& body) {
        if (objects.prepare_) {
            if (auto ready = objects.prepare_(); !ready) return Unexpected(ready.error());
        }
        if (!objects.visit_) return body();
        Expected<Answer> got = failure("interrupted");
        objects.visit_([&] { got = body(); });
        return got;
    }
    /// Whether there are ticks beside.
    static bool ticks_beside(const Objects& objects) { return static_cast<bool>(objects.visit_); }
    /// Where there are no ticks beside, all may be copied.
    static PlainLimit snapshot_limit(const Objects& objects) {
        constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
        return objects.visit_ ? PlainLimit{} : PlainLimit{all, all};
    }
    static void note_read(const Objects& objects, const PortAt& port) {
        if (objects.on_read_) objects.on_read_(port);
    }
};

/// The objects that a metamethod or method belongs to.
inline Objects& objects_of(lua_State* L) { return *static_cast<Objects*>(lua_touserdata(L, lua_upvalueindex(1))); }

/// The object at `index`, or null when it is none of ours. Raises nothing.
ObjectRef* to_object(lua_State* L, int index);
ObjectRef* to_object(lua_State* L, int index, ObjectKind kind);

/// Pushes an object, which has these names. May raise a Lua error.
void push_object(lua_State* L, ObjectRef ref, std::string_view component, std::string_view port);
void push_object(lua_State* L, Objects& objects, ObjectKind kind, RunningSystem& live, std::string_view component,
                 std::string_view port);

/// Pushes a closure whose first upvalue are the objects and whose second is a name. May raise a Lua error.
void push_method(lua_State* L, Objects& objects, lua_CFunction function, std::string_view name);

/// Pushes the answer that is kept in the core, and returns how many values that are. May raise a Lua error. Locked
/// tables are what the object at index 1 has under the key at index 2.
int push_answer(lua_State* L, Objects& objects, Tables tables);

/// What an act has come to as an answer without a value.
inline Expected<Answer> answer_of(const Expected<ActResult>& done) {
    if (!done) return Unexpected(done.error());
    return Answer{};
}

/// Runs `find()`, which reads from Lua without raising and returns an `Expected<Answer>`; then pushes the answer or
/// raises the error, when nothing is left that needs a destructor. It looks at the system within `visit` alone.
template <class Find>
int answer_beside(lua_State* L, Objects& objects, Find&& find, Tables tables = Tables::own) {
    bool failed = false;
    {
        Expected<Answer> got = find();
        failed = !got;
        if (failed) {
            keep_error(L, describe(got.error()));
        } else {
            ObjectAccess::core(objects).answer = std::move(*got);
        }
    }
    return failed ? raise_kept(L) : push_answer(L, objects, tables);
}

/// The same for what is one visit, and reads nothing from Lua but names and numbers.
template <class Body>
int answer(lua_State* L, Objects& objects, Body&& body) {
    return answer_beside(L, objects, [&] { return ObjectAccess::visit(objects, body); });
}

/// Both for `__index`: nothing would come of writing to the tables that it gives, so that is an error.
template <class Find>
int look_beside(lua_State* L, Objects& objects, Find&& find) {
    return answer_beside(L, objects, find, Tables::locked);
}
template <class Body>
int look(lua_State* L, Objects& objects, Body&& body) {
    return look_beside(L, objects, [&] { return ObjectAccess::visit(objects, body); });
}

/// The text at `index`, which must be a string. Raises nothing.
inline std::string_view text_at(lua_State* L, int index) {
    std::size_t length = 0;
    const char* text = lua_tolstring(L, index, &length);
    return {text, length};
}

/// What an object of the tree means, now.
Expected<TreeNode> node_of(const ObjectRef& ref);
/// The component or port that an object means, now.
Expected<ComponentAt> find_component(const ObjectRef& ref);
Expected<PortAt> find_port(const ObjectRef& ref);

/// The functions of each kind of object.
struct ObjectFunctions {
    lua_CFunction index;
    lua_CFunction newindex;
    lua_CFunction pairs;  ///< null: the object has none
    lua_CFunction tostring;
    const char* name;
};
ObjectFunctions node_functions(ObjectKind kind);
const ObjectFunctions& hosts_functions();
const ObjectFunctions& host_functions();
const ObjectFunctions& remote_functions();

/// What `X:activate(...)`, `X:command(...)` and `X.port:write(...)` call. Their second upvalue is the name.
int call_component_method(lua_State* L);
int call_component_command(lua_State* L);
int call_port_method(lua_State* L);

/// `pairs`: a table from each name to what the object's own __index gives, sorted as every table. May raise a Lua
/// error.
int pairs_of_names(lua_State* L, Expected<std::vector<std::string>> (*names)(const ObjectRef&));

}  // namespace nezumi
