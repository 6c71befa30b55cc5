// What could stand before the cursor, from the system that runs.
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include "bindings/console/command_offers.hpp"
#include "bindings/console/console_commands.hpp"
#include "bindings/console/cursor_text.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "engine/base/names.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;

// What a chain of names leads to, if it is there.
struct CursorPlace {
    // `remote`: a host, or a component of one, "ev3/vehicle".
    enum class Kind { nothing, system, component, ports, port, config, truth, value, data, table, hosts, remote };
    Kind kind = Kind::nothing;
    std::string component;
    std::string port;  // also of `value`; the member, as "state", of `data`
    Names fields{};    // below `value`, `truth` and `data`
};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

Names port_names(const Component& component) {
    Names names;
    for (const auto& port : component.in_ports()) names.push_back(port->name());
    for (const auto& port : component.out_ports()) names.push_back(port->name());
    return names;
}

Names without(Names all, const Names& some) {
    std::erase_if(all,
                  [&](const std::string& name) { return std::find(some.begin(), some.end(), name) != some.end(); });
    return all;
}

// The fields of what lies at this path in a value of a message type.
Names value_fields(std::size_t type, std::span<const std::string> path) {
    const Type* value = message_infos()[type].payload;
    for (const std::string& name : path) {
        const auto& fields = value->fields;
        const auto found =
            std::find_if(fields.begin(), fields.end(), [&](const auto& each) { return each.name == name; });
        if (found == fields.end()) return {};
        value = found->type;
    }
    Names names;
    for (const Type::Field& field : value->fields) names.push_back(field.name);
    return names;
}

// What lies at this path in the plain data of a member: "state", "tasks" or "probes".
Names data_fields(const Component& component, std::string_view member, std::span<const std::string> path) {
    if (member == "probes" && !path.empty()) return path.size() == 1 ? Names{"age", "tm", "value"} : Names{};
    std::string prefix;
    for (const std::string& name : path) prefix += name + ".";
    Names names;
    component.visit_member(member, [&](const LeafPath& leaf, const ValueView&) {
        const std::string text = leaf.text();
        if (!text.starts_with(prefix)) return;
        const std::string rest = text.substr(prefix.size());
        const std::string name = rest.substr(0, rest.find_first_of(".["));
        if (is_identifier(name)) names.push_back(name);
    });
    return names;
}

Names truth_fields(std::span<const std::string> path) {
    if (path.empty()) return Objects::truth_members();
    if (path.front() == "pose") return value_fields(type_index<Pose2D>(), path.subspan(1));
    if (path.front() == "velocity") return value_fields(type_index<Velocity2D>(), path.subspan(1));
    return {};
}

Names table_keys(lua_State* L, int table) {
    Names names;
    if (push_behind_lock(L, table)) table = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        const std::string_view key = text_at(L, -2);
        if (is_identifier(key)) names.emplace_back(key);
    }
    return names;
}

// Follows names through what was defined at the prompt and the system, and runs nothing of Lua. The value that it has
// come to is on top of the stack, where that is a table.
class Walk {
public:
    // What is plotted are a port's fields: `plot(controller.out.vx)`.
    explicit Walk(Session::Parts& parts, bool plotted = false)
        : parts_(parts), lua_(parts.state->lua()), top_(lua_gettop(lua_)), plotted_(plotted) {}
    ~Walk() { lua_settop(lua_, top_); }
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;

    CursorPlace follow(const Names& chain) {
        if (chain.empty() || lua_checkstack(lua_, 20) == 0) return {};
        CursorPlace place = begin(chain.front());
        for (std::size_t i = 1; i < chain.size(); ++i) place = member(place, chain[i]);
        return place;
    }

    Names names(const CursorPlace& place, char separator) {
        if (place.kind == CursorPlace::Kind::table) return table_keys(lua_, lua_gettop(lua_));
        return parts_.at_system([&] { return names_in(parts_.live.system(), place, separator == ':'); });
    }

private:
    Names names_in(const System& system, const CursorPlace& place, bool called) const {
        using Kind = CursorPlace::Kind;
        if (place.kind == Kind::system) return called ? Names{} : names_of(system);
        if (place.kind == Kind::hosts) return called ? Names{} : host_names(system);
        if (place.kind == Kind::remote) return host_members(system, place.component, called);
        const Component* component = system.find(place.component);
        if (component == nullptr) return {};
        const Port* port = component->find_port(place.port);
        switch (place.kind) {
            case Kind::component:
                return called ? Objects::methods(*component)
                              : without(Objects::members(*component), Objects::methods(*component));
            case Kind::port:
                if (port == nullptr) return {};
                if (plotted_) return value_fields(port->type(), {});
                return called ? Objects::port_methods() : without(Objects::port_members(), Objects::port_methods());
            case Kind::value: return called || port == nullptr ? Names{} : value_fields(port->type(), place.fields);
            case Kind::ports: return called ? Names{} : port_names(*component);
            case Kind::config: return called ? Names{} : parameter_names(*component);
            case Kind::truth: return called ? Names{} : truth_fields(place.fields);
            case Kind::data: return called ? Names{} : data_fields(*component, place.port, place.fields);
            default: return {};
        }
    }

    static Names parameter_names(const Component& component) {
        Names names;
        for (const auto& parameter : component.parameters().all()) names.push_back(parameter.spec.name);
        return names;
    }

    // What the value on top of the stack is.
    CursorPlace value() const {
        if (lua_type(lua_, -1) == LUA_TTABLE) return {CursorPlace::Kind::table};
        const ObjectRef* ref = to_object(lua_, -1);
        if (ref == nullptr) return {};
        if (ref->kind == ObjectKind::system) return {CursorPlace::Kind::system};
        const std::string owner(ref->component());
        switch (ref->kind) {
            case ObjectKind::ports: return {CursorPlace::Kind::ports, owner};
            case ObjectKind::config: return {CursorPlace::Kind::config, owner};
            case ObjectKind::truth: return {CursorPlace::Kind::truth, owner};
            case ObjectKind::port: return {CursorPlace::Kind::port, owner, std::string(ref->port())};
            case ObjectKind::hosts: return {CursorPlace::Kind::hosts};
            case ObjectKind::host:
            case ObjectKind::remote: return {CursorPlace::Kind::remote, owner};
            case ObjectKind::remote_config: return {};
            default: return {CursorPlace::Kind::component, owner};
        }
    }

    CursorPlace begin(const std::string& name) const {
        lua_pushglobaltable(lua_);
        if (!push_raw(name)) {
            push_commands_table(lua_);
            if (!push_raw(name)) return {CursorPlace::Kind::component, name};
        }
        return value();
    }

    // Replaces the table on top of the stack by its field, if it has one; else takes it off.
    bool push_raw(const std::string& name) const {
        if (push_behind_lock(lua_, -1)) lua_remove(lua_, -2);
        lua_pushnil(lua_);
        while (lua_next(lua_, -2) != 0) {
            if (lua_type(lua_, -2) == LUA_TSTRING && text_at(lua_, -2) == name) {
                lua_replace(lua_, -3);
                lua_pop(lua_, 1);
                return true;
            }
            lua_pop(lua_, 1);
        }
        lua_pop(lua_, 1);
        return false;
    }

    CursorPlace member(const CursorPlace& place, const std::string& name) const {
        using Kind = CursorPlace::Kind;
        switch (place.kind) {
            case Kind::system: return {Kind::component, name};
            case Kind::hosts: return {Kind::remote, name};
            case Kind::remote:
                if (place.component.find('/') != std::string::npos) return {};
                return {Kind::remote, place.component + "/" + name};
            case Kind::component:
                if (name == "ports") return {Kind::ports, place.component};
                if (name == "config") return {Kind::config, place.component};
                if (name == "truth") return {Kind::truth, place.component};
                if (is_one_of(name, {"state", "tasks", "probes"})) return {Kind::data, place.component, name};
                return {Kind::port, place.component, name};
            case Kind::ports: return {Kind::port, place.component, name};
            case Kind::port:
                if (name == "value") return {Kind::value, place.component, place.port};
                return plotted_ ? CursorPlace{Kind::value, place.component, place.port, {name}} : CursorPlace{};
            case Kind::truth:
            case Kind::data:
            case Kind::value: {
                CursorPlace within = place;
                within.fields.push_back(name);
                return within;
            }
            case Kind::table: return push_raw(name) ? value() : CursorPlace{};
            default: return {};
        }
    }

    Session::Parts& parts_;
    lua_State* lua_;
    int top_;
    bool plotted_;
};

// The fields that a table has as the value of a port, `port:write { v`, `inject("name.port", { v`, or in a word of
// system files, `behavior "name" { s`.
Names field_names(Session::Parts& parts, const FieldAtCursor& field) {
    const TextAtCursor& call = field.call;
    Names chain;
    if (Names fields = field.path.empty() ? fields_of_table(call) : Names{}; !fields.empty()) return fields;
    if (call.callee.separator == ':' && call.argument == 1 && is_one_of(call.word, {"write", "inject", "hold"})) {
        chain = call.callee.chain;
    } else if (offer_at(call) == Offer::value) {
        chain = call.first_chain;
        const std::size_t dot = call.first.find('.');
        if (chain.empty() && dot != std::string::npos) chain = {call.first.substr(0, dot), call.first.substr(dot + 1)};
    }
    Walk walk(parts);
    CursorPlace place = walk.follow(chain);
    if (place.kind != CursorPlace::Kind::port) return {};
    place.kind = CursorPlace::Kind::value;
    place.fields = field.path;
    return walk.names(place, '.');
}

// The sets of the component that a chain of names leads to.
Names set_names(Session::Parts& parts, const Names& chain) {
    Walk walk(parts);
    const CursorPlace place = walk.follow(chain);
    return parts.at_system([&] {
        Names sets;
        const System& system = parts.live.system();
        const Component* component =
            place.kind == CursorPlace::Kind::component ? system.find(place.component) : nullptr;
        if (component == nullptr) return sets;
        for (const auto& [name, values] : component->sets) sets.push_back(name);
        return sets;
    });
}

// The files that `behavior "name" { script = "` can name.
Names script_names(Session::Parts& parts) {
    const auto at = parts.at_system([&] {
        return std::make_optional(std::pair{parts.live.project(), parts.live.spec().file});
    });
    return at ? at->first.names(FileKind::script, at->second) : Names{};
}

}  // namespace

Completion complete(Session::Parts& parts, std::string_view text, std::size_t cursor) {
    text = text.substr(0, cursor);
    Completion completion{text.size(), {}};
    if (parts.state->is_lost()) return completion;
    const CursorText at_cursor(text);
    if (at_cursor.in_comment()) return completion;
    const TextAtCursor quoted = at_cursor.quoted();
    if (quoted.open && quoted.word == "use" && quoted.callee.separator == ':') {
        completion.from = quoted.from;
        completion.candidates = set_names(parts, quoted.callee.chain);
    } else if (quoted.open && quoted.word == "behavior" && quoted.field == "script") {
        completion.from = quoted.from;
        completion.candidates = script_names(parts);
    } else if (quoted.open) {
        completion.from = quoted.from;
        completion.candidates = parts.at_system([&] { return texts_at(parts.live.system(), quoted); });
    } else {
        const NameAtCursor name = at_cursor.name();
        completion.from = name.from;
        const FieldAtCursor field = name.separator == 0 ? at_cursor.field() : FieldAtCursor{};
        Names fields = field.open ? field_names(parts, field) : Names{};
        if (!fields.empty()) {
            completion.candidates = std::move(fields);
        } else if (name.separator == 0) {
            completion.candidates = names_in_scope(parts);
            if (name.from < text.size())
                completion.candidates.insert(completion.candidates.end(), lua_keywords().begin(), lua_keywords().end());
        } else if (!name.broken) {
            const TextAtCursor call = at_cursor.call();
            Walk walk(parts, call.word == "plot" && call.callee.separator == 0);
            completion.candidates = walk.names(walk.follow(name.chain), name.separator);
        }
    }
    Names& all = completion.candidates;
    const std::string_view part = text.substr(completion.from);
    std::erase_if(all, [&](const std::string& name) { return !name.starts_with(part); });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return completion;
}

}  // namespace nezumi
