// The methods of each port carry the slot of the port, so a tick needs no search and no comparison of strings.
#include "bindings/lua/script/script_ports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"
#include "bindings/lua/values/plain_data.hpp"

namespace nezumi {
namespace {

PortSlot& slot_of(lua_State* L) { return *static_cast<PortSlot*>(lua_touserdata(L, lua_upvalueindex(1))); }

std::string title(const PortSlot& slot) { return port_title(*slot.declaration); }

int refuse_self(lua_State* L, const PortSlot& slot, const char* method) {
    keep_error(L, fmt::format("{}: write `:{}(...)` with a colon, not `.{}(...)`", title(slot), method, method));
    return raise_kept(L);
}

int refuse_while_loading(lua_State* L, const PortSlot& slot, const char* verb) {
    keep_error(L, fmt::format("{}: ports can't be {} while the file loads", title(slot), verb));
    return raise_kept(L);
}

int refuse_surplus(lua_State* L, const PortSlot& slot, const char* method, int most, const char* usage) {
    return bridge(L, [&] { return Arguments{L, 2}.at_most(title(slot) + ":" + method, most, usage); });
}

// The reason that the port can't be written now; empty if it can. Only an ACTIVE component can write. In the callbacks
// of a component in ERROR, all types except velocities can still be written.
std::string refuse_write(const PortSlot& slot) {
    if (!slot.live) return fmt::format("{}: on_reload can't write; the next execution can", title(slot));
    const Component& owner = *slot.script->owner();
    const bool is_velocity = slot.declaration->type == message_of<Velocity2D>();
    switch (owner.state()) {
        case LifeState::active: return "";
        case LifeState::inactive:
            return fmt::format("{}: {} is INACTIVE and can't write: activate it first", title(slot), owner.name());
        case LifeState::error: break;
    }
    const Hook hook = owner.hook();
    if (is_velocity && (hook == Hook::on_aborting || hook == Hook::on_error)) {
        return fmt::format("{} ({}): velocities can't be written in {}: the robot is being stopped", title(slot),
                           slot.declaration->type->name, to_text(hook));
    }
    if (is_velocity || hook == Hook::command) {
        return fmt::format("{}: {} is in ERROR and can't write: reset and activate it first", title(slot),
                           owner.name());
    }
    return "";
}

// Grows the stack only if it must: the garbage collector shrinks it again, so each growth would be repeated.
template <Held T>
void reserve_stack(lua_State* L) {
    constexpr int most_arguments = 2;
    if constexpr (codec_stack_of<T> + most_arguments > LUA_MINSTACK) luaL_checkstack(L, codec_stack_of<T>, nullptr);
}

// Pushes a message in the table that the port gave before, of which nothing is used any more, or in a new one. A
// coroutine may wait while it uses a message, so it always gets a new one.
template <class T>
void push_table(lua_State* L, const PortSlot& slot, const InPort<T>& port, const T& value) {
    constexpr int metatable_index = lua_upvalueindex(2), table_index = lua_upvalueindex(3);
    bool in_place = slot.is_read_in_place && L == current_call->base && port.queue() == 0;
    if constexpr (std::is_same_v<T, Value>) in_place = in_place && value.type().kind == Type::Kind::structure;
    if (in_place && lua_type(L, table_index) == LUA_TTABLE) {
        lua_pushvalue(L, table_index);
        const std::size_t before = lua_rawlen(L, -1);
        fill_table(L, value);
        if constexpr (Sequence<T>) {
            for (std::size_t i = value.size(); i < before; ++i) {
                lua_pushnil(L);
                lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
            }
        }
        return;
    }
    if constexpr (std::is_same_v<T, Value>) {
        push_payload(L, value);
    } else {
        push_value(L, value);
    }
    if constexpr (Sequence<T>) {
        lua_pushvalue(L, metatable_index);
        lua_setmetatable(L, -2);
    }
    if (!in_place) return;
    lua_pushvalue(L, -1);
    lua_replace(L, table_index);
}

template <Held T>
int port_read(lua_State* L) {
    PortSlot& slot = slot_of(L);
    if (lua_touserdata(L, 1) != slot.object) return refuse_self(L, slot, "read");
    if (lua_gettop(L) > 1) return refuse_surplus(L, slot, "read", 0, "()");
    if (slot.port == nullptr) return refuse_while_loading(L, slot, "read");
    reserve_stack<T>(L);
    auto& port = *static_cast<InPort<T>*>(slot.port);
    // In on_reload the message stays unread, because the version before may still need it.
    const T& value = slot.live ? port.read() : port.latest().data;
    if constexpr (std::is_same_v<T, Value> || Sequence<T> || Described<T>) {
        push_table(L, slot, port, value);
    } else {
        push_value(L, value);
    }
    return 1;
}

// __index of a received sequence: returns nil as for any table, and remembers the element, so that an error in the same
// line can name it. If a C function reads the element, there is no line, and nothing is remembered.
int missing_element(lua_State* L) {
    const PortSlot& slot = slot_of(L);
    lua_Debug activation;
    if (lua_isinteger(L, 2) != 0 && lua_getstack(L, 1, &activation) != 0 && lua_getinfo(L, "Sl", &activation) != 0 &&
        activation.currentline > 0) {
        Script::MissingElement element{.place = {},
                                       .index = lua_tointeger(L, 2),
                                       .count = static_cast<std::size_t>(lua_rawlen(L, 1)),
                                       .port = slot.declaration};
        element.place.set(activation);
        slot.script->note_missing(element);
    }
    lua_pushnil(L);
    return 1;
}

void explain_write(lua_State* L, const PortSlot& slot) {
    const auto value = read_payload(L, 2, slot.declaration->type);
    if (!value)
        keep_error(L, fmt::format("{} ({}): {}", title(slot), slot.declaration->type->name, value.error().message));
}

// Writes what `read(T&)` reads from the arguments. If it returns false, the wrong value is at index 2.
template <Held T, class Read>
int write_message(lua_State* L, const PortSlot& slot, const Read& read) {
    if (slot.port == nullptr) return refuse_while_loading(L, slot, "written");
    if (!slot.live || slot.script->owner()->state() != LifeState::active) {
        keep_error(L, refuse_write(slot));
        if (!LuaState::of(L).kept_error.empty()) return raise_kept(L);
    }
    reserve_stack<T>(L);
    auto& port = *static_cast<OutPort<T>*>(slot.port);
    const std::size_t before = port.pending();
    T& value = port.next_pending();
    const bool fits = read(value);
    std::size_t bytes = sizeof(Message<T>);
    if constexpr (std::is_same_v<T, Value>) bytes += value.type().size;
    if constexpr (!std::is_trivially_copyable_v<T>) bytes += heap_bytes(value);
    if (fits && slot.script->may_write(bytes)) return 0;
    port.discard_after(before);
    if (fits) {
        keep_error(L, fmt::format("{} ({}): is there an endless loop? It has written more than {} MB in one execution",
                                  title(slot), slot.declaration->type->name, Script::most_written_bytes >> 20));
    } else {
        explain_write(L, slot);
    }
    return raise_kept(L);
}

template <Held T>
int port_write(lua_State* L) {
    const PortSlot& slot = slot_of(L);
    if (lua_touserdata(L, 1) != slot.object) return refuse_self(L, slot, "write");
    if (lua_gettop(L) > 2) return refuse_surplus(L, slot, "write", 1, "(value)");
    lua_settop(L, 2);
    return write_message<T>(L, slot, [L](T& value) {
        if constexpr (std::is_same_v<T, Value>) {
            return read_described(L, 2, value);
        } else {
            return read_value(L, 2, value);
        }
    });
}

// Replaces the arguments of a method that writes fields by the table that the text has.
void collect_fields(lua_State* L, const FieldWrite& write) {
    const auto count = static_cast<int>(write.fields.size());
    luaL_checkstack(L, 3, nullptr);
    lua_settop(L, 1 + count);
    lua_createtable(L, 0, count);
    for (int i = 0; i < count; ++i) {
        const std::string& name = write.fields[static_cast<std::size_t>(i)];
        lua_pushlstring(L, name.data(), name.size());
        lua_pushvalue(L, 2 + i);
        lua_rawset(L, -3);
    }
    lua_replace(L, 2);
    lua_settop(L, 2);
}

template <Held T>
int port_write_fields(lua_State* L) {
    const auto& writer = *static_cast<const FieldWriter*>(lua_touserdata(L, lua_upvalueindex(2)));
    const PortSlot& slot = slot_of(L);
    if (writer.fields.empty()) {
        collect_fields(L, *writer.write);
        return port_write<T>(L);
    }
    if (lua_touserdata(L, 1) != slot.object) return refuse_self(L, slot, "write");
    return write_message<T>(L, slot, [&](T& value) {
        const bool fits = read_fields(L, 2, writer.fields, value);
        if (!fits) collect_fields(L, *writer.write);
        return fits;
    });
}

// The fields of a type with these names; none if one of them is missing.
std::vector<const Type::Field*> fields_of(const Type& type, const std::vector<std::string>& names) {
    std::vector<const Type::Field*> fields;
    for (const std::string& name : names) {
        const auto found = std::find_if(type.fields.begin(), type.fields.end(),
                                        [&](const Type::Field& field) { return field.name == name; });
        if (found == type.fields.end()) return {};
        fields.push_back(&*found);
    }
    return fields;
}

// The time stamp of the value that `read` returns. With a queue, the stamp of the message that was read last; if none
// was read, that of the latest message.
template <Held T>
double stamp(const InPortBase& port) {
    const double taken = static_cast<const InPort<T>&>(port).current().tm;
    return port.queue() > 0 && taken == 0 ? port.tm() : taken;
}

struct PortFunctions {
    lua_CFunction read;
    lua_CFunction write;
    lua_CFunction write_fields;
    double (*stamp)(const InPortBase&);
    bool sequence;
};

const PortFunctions& functions_of(const MessageType& type) {
    return *with_payload_type(type, []<class T>() {
        static constexpr PortFunctions functions{port_read<T>, port_write<T>, port_write_fields<T>, stamp<T>,
                                                 Sequence<T>};
        return &functions;
    });
}

enum class Property { is_new, tm, age, connected, stale };
constexpr std::array<std::string_view, 5> property_names{"is_new", "tm", "age", "connected", "stale"};

void push_property(lua_State* L, const PortSlot& slot, Property property) {
    const auto& port = static_cast<const InPortBase&>(*slot.port);
    const Component& owner = *slot.script->owner();
    const bool arrived = port.arrival_tick() >= 0;
    const double tm = arrived ? functions_of(*port.type()).stamp(port) : 0;
    switch (property) {
        case Property::is_new: return lua_pushboolean(L, port.is_new() ? 1 : 0);
        case Property::tm: return lua_pushnumber(L, tm);
        case Property::age:
            return lua_pushnumber(L, arrived ? owner.now().seconds - tm : std::numeric_limits<double>::infinity());
        case Property::connected: return lua_pushboolean(L, port.connected() ? 1 : 0);
        case Property::stale: return lua_pushboolean(L, port.is_stale(owner.now().seconds) ? 1 : 0);
    }
}

void explain_property(lua_State* L, const PortSlot& slot) {
    const bool in = slot.declaration->direction == Direction::in;
    if (lua_type(L, 2) != LUA_TSTRING) {
        return keep_error(
            L, in ? fmt::format("{} is the port, not its value: read it first, with `:read()`", title(slot))
                  : fmt::format("{} is the port, not its value: write it with `:write(value)`", title(slot)));
    }
    const std::string_view key = string_at(L, 2);
    std::vector<std::string_view> names;
    if (in) {
        names.emplace_back("read");
        names.insert(names.end(), property_names.begin(), property_names.end());
    } else {
        names.emplace_back("write");
    }
    const std::string near = did_you_mean(key, names);
    keep_error(L, fmt::format("{} has no '{}'{}", title(slot), shown(key),
                              near.empty() ? fmt::format(" (it has {})", fmt::join(names, ", ")) : near));
}

// __index of the table of methods: other names are properties. Stack: methods, key.
int port_index(lua_State* L) {
    PortSlot& slot = slot_of(L);
    if (slot.declaration->direction == Direction::in && lua_type(L, 2) == LUA_TSTRING) {
        const std::string_view key = string_at(L, 2);
        for (std::size_t i = 0; i < property_names.size(); ++i) {
            if (property_names[i] != key) continue;
            if (slot.port == nullptr) return refuse_while_loading(L, slot, "read");
            push_property(L, slot, static_cast<Property>(i));
            return 1;
        }
    }
    explain_property(L, slot);
    return raise_kept(L);
}

int port_newindex(lua_State* L) {
    PortSlot& slot = slot_of(L);
    keep_error(L, slot.declaration->direction == Direction::in
                      ? fmt::format("{}: its members can't be set", title(slot))
                      : fmt::format("{}: its members can't be set; write a value with `:write(value)`", title(slot)));
    return raise_kept(L);
}

int port_tostring(lua_State* L) {
    const PortDeclaration& declaration = *slot_of(L).declaration;
    lua_pushfstring(L, "%s '%s' (%s)", declaration.direction == Direction::in ? "input" : "output",
                    declaration.name.c_str(), declaration.type->name.c_str());
    return 1;
}

void set_closure(lua_State* L, PortSlot& slot, const char* name, lua_CFunction function) {
    lua_pushlightuserdata(L, &slot);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

// Sets the methods that write certain fields, for the calls in the file.
void set_field_writers(lua_State* L, PortSlot& slot) {
    const std::vector<FieldWrite>& writes = slot.script->code().writes;
    const PortFunctions& functions = functions_of(*slot.declaration->type);
    for (const FieldWrite& write : writes) {
        if (write.port == slot.declaration->name)
            slot.writers.push_back({&write, fields_of(*slot.declaration->type->payload, write.fields)});
    }
    for (FieldWriter& writer : slot.writers) {
        lua_pushlightuserdata(L, &slot);
        lua_pushlightuserdata(L, &writer);
        lua_pushcclosure(L, functions.write_fields, 2);
        lua_setfield(L, -2, method_of_field_write(static_cast<std::size_t>(writer.write - writes.data()) + 1).c_str());
    }
}

}  // namespace

std::string port_title(const PortDeclaration& declaration) {
    return fmt::format("{} '{}'", declaration.direction == Direction::in ? "input" : "output", declaration.name);
}

void push_port_object(lua_State* L, PortSlot& slot) {
    luaL_checkstack(L, 8, nullptr);
    const bool in = slot.declaration->direction == Direction::in;
    const PortFunctions& functions = functions_of(*slot.declaration->type);
    slot.object = lua_newuserdatauv(L, 0, 0);

    lua_createtable(L, 0, 6);  // the metatable
    lua_createtable(L, 0, 1);  // the methods
    if (in) {
        lua_pushlightuserdata(L, &slot);
        lua_pushnil(L);
        if (functions.sequence) {
            lua_createtable(L, 0, 2);  // the metatable of received sequences
            set_closure(L, slot, "__index", missing_element);
            hide_metatable(L);
            lua_replace(L, -2);
        }
        lua_pushnil(L);  // the table of messages that are read in place
        lua_pushcclosure(L, functions.read, 3);
        lua_setfield(L, -2, "read");
    } else {
        set_closure(L, slot, "write", functions.write);
        set_field_writers(L, slot);
    }
    lua_createtable(L, 0, 1);
    set_closure(L, slot, "__index", port_index);
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, "__index");
    set_closure(L, slot, "__newindex", port_newindex);
    set_closure(L, slot, "__tostring", port_tostring);
    lua_pushliteral(L, "port");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

}  // namespace nezumi
