// Shared by the files of the objects: the userdata of an object, and the conversion of a C++ result to a Lua value.
#pragma once

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
#include "engine/tree/node.hpp"

namespace nezumi {

enum class ObjectKind : unsigned char {
    system,
    component,
    ports,
    port,
    config,
    truth,
    hosts,
    host,    ///< `component` is the name of the host
    remote,  ///< `component` is "host/name" of another host; `port` is "", or a path in it: "config", "current_vel"
};
inline constexpr std::size_t object_kinds = 9;

/// The begin of an object's userdata. The object refers to things by name, so it survives reloads and restarts. The
/// names follow this structure in the same block of memory.
struct ObjectRef {
    Objects* objects;
    RunningSystem* built;         // null: the system is made later, and is then at `place`
    RunningSystem* const* place;  // see `built`
    std::uint32_t component_length;
    std::uint32_t port_length;
    ObjectKind kind;

    RunningSystem* live() const { return built != nullptr ? built : *place; }
    std::string_view component() const { return {reinterpret_cast<const char*>(this + 1), component_length}; }
    std::string_view port() const { return {reinterpret_cast<const char*>(this + 1) + component_length, port_length}; }
};

/// An object to be pushed.
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

/// Everything that a member of an object can be: a value (plain data: several values), a part of a table, or an object
/// with its own members.
using Answer = std::variant<Value, PlainSnapshot, ObjectName, MethodName>;

/// Whether the tables of an answer belong to the caller, or are read-only copies.
enum class Tables : bool { own, locked };

/// Where the path of a number begins: the last node that stays the same as long as the system's layout does, and the
/// path from there. Conditions ask for the same few paths after each tick.
struct FoundNode {
    const RunningSystem* live;
    std::uint64_t layout;
    ObjectKind kind;
    std::string component, port, path;  ///< as asked
    TreeNode node;
    std::string below;
};

/// C++ values that live between finding an answer and pushing it. A Lua error may jump over the functions in between.
struct Objects::Core {
    LuaState* state = nullptr;
    std::function<RunningSystem&()> current;
    Actor who;
    Answer answer;
    std::vector<FoundNode> found;
};

/// Access to private members of `Objects`.
struct ObjectAccess {
    static Objects::Core& core(Objects& objects) { return *objects.core_; }
    static const Actor& who(const Objects& objects) { return objects.core_->who; }
    static bool hardware(const Objects& objects) { return objects.hardware_; }
    static Expected<void> prepare_change(const Objects& objects) {
        return objects.prepare_change_ ? objects.prepare_change_() : Expected<void>();
    }
    /// Runs `body()` in the ticking thread, where the system may be read and changed.
    template <class Body>
    static Expected<Answer> visit(const Objects& objects, Body&& body) {
        if (objects.prepare_) {
            if (auto ready = objects.prepare_(); !ready) return Unexpected(ready.error());
        }
        if (!objects.visit_) return body();
        Expected<Answer> got = failure("interrupted");
        objects.visit_([&] {
            got = body();
            return true;
        });
        return got;
    }
    /// Whether the system may be read now without `visit`.
    static bool is_ready(const Objects& objects) {
        return !objects.visit_ && (!objects.prepare_ || objects.prepare_());
    }
    /// Whether ticks go on while Lua code runs.
    static bool ticks_beside(const Objects& objects) { return static_cast<bool>(objects.visit_); }
    /// The largest copy that a visit may make; without limit if it delays no tick.
    static PlainLimit snapshot_limit(const Objects& objects) {
        constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
        return objects.visit_ ? PlainLimit{} : PlainLimit{all, all};
    }
    static void note_read(const Objects& objects, const PortAt& port) {
        if (objects.on_read_) objects.on_read_(port);
    }
};

/// The objects of the running metamethod or method.
inline Objects& objects_of(lua_State* L) { return *static_cast<Objects*>(lua_touserdata(L, lua_upvalueindex(1))); }

/// The object at `index`, or null for any other value. Raises no error.
ObjectRef* to_object(lua_State* L, int index);
ObjectRef* to_object(lua_State* L, int index, ObjectKind kind);

/// Pushes an object with these names. May raise a Lua error.
void push_object(lua_State* L, ObjectRef ref, std::string_view component, std::string_view port);
void push_object(lua_State* L, Objects& objects, ObjectKind kind, RunningSystem& live, std::string_view component,
                 std::string_view port);

/// Pushes a C function whose upvalues are the objects and a name. May raise a Lua error.
void push_method(lua_State* L, Objects& objects, lua_CFunction function, std::string_view name);

/// Pushes the answer that the core holds, and returns the number of values. May raise a Lua error. For read-only
/// tables, the object must be at index 1 and the key that was read at index 2: errors of the tables name them.
int push_answer(lua_State* L, Objects& objects, Tables tables);

/// The result of an act, as an answer without a value.
inline Expected<Answer> answer_of(const Expected<ActResult>& done) {
    if (!done) return Unexpected(done.error());
    return Answer{};
}

/// Runs `find()`, which reads from Lua without raising errors and returns an `Expected<Answer>`. Then pushes the answer
/// or raises the error, after all C++ objects are destroyed. `find` reads the system only within `visit`.
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

/// Like `answer_beside`, for a function that makes exactly one visit and reads only names and numbers from Lua.
template <class Body>
int answer(lua_State* L, Objects& objects, Body&& body) {
    return answer_beside(L, objects, [&] { return ObjectAccess::visit(objects, body); });
}

/// The two functions above for `__index`: their tables are read-only, because writing to them would have no effect.
template <class Find>
int look_beside(lua_State* L, Objects& objects, Find&& find) {
    return answer_beside(L, objects, find, Tables::locked);
}
template <class Body>
int look(lua_State* L, Objects& objects, Body&& body) {
    return look_beside(L, objects, [&] { return ObjectAccess::visit(objects, body); });
}

/// The text at `index`, which must be a string. Raises no error.
inline std::string_view text_at(lua_State* L, int index) {
    std::size_t length = 0;
    const char* text = lua_tolstring(L, index, &length);
    return {text, length};
}

/// The node in the tree of names that an object refers to at present.
Expected<TreeNode> node_of(const ObjectRef& ref);
/// The component or port that an object refers to at present.
Expected<ComponentAt> find_component(const ObjectRef& ref);
Expected<PortAt> find_port(const ObjectRef& ref);

/// The functions of each kind of object.
struct ObjectFunctions {
    lua_CFunction index;
    lua_CFunction newindex;
    lua_CFunction pairs;  ///< null: the object does not support it
    lua_CFunction tostring;
    const char* name;
};
ObjectFunctions node_functions(ObjectKind kind);
const ObjectFunctions& hosts_functions();
const ObjectFunctions& host_functions();
const ObjectFunctions& remote_functions();

/// The functions of `X:activate(...)`, `X:command(...)` and `X.port:write(...)`. Their second upvalue is the name.
int call_component_method(lua_State* L);
int call_component_command(lua_State* L);
int call_port_method(lua_State* L);

/// `pairs`: a table from each name to the value of the object's own __index, sorted like every table. May raise a Lua
/// error.
int pairs_of_names(lua_State* L, Expected<std::vector<std::string>> (*names)(const ObjectRef&));

}  // namespace nezumi
