// Methods of ports, and the words of consoles and scenarios that take a port.
#include <fmt/format.h>

#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// Facts about a port that are needed to read a value for it.
struct PortToRead {
    RunningSystem* live;
    std::string path;
    std::string title;  // "input 'in' (TimedShortSeq)"
    const MessageType* type;
};

PortToRead to_read(const PortAt& at) {
    const Port& port = *at.port;
    return {at.live, at.path(),
            fmt::format("{} '{}' ({})", port.direction() == Direction::in ? "input" : "output", port.name(),
                        port.type_name()),
            port.type()};
}

// The value that a method puts into a port. `value` is its index.
Expected<Value> value_for(lua_State* L, int value, const PortToRead& port) {
    if (lua_type(L, value) == LUA_TNONE) return failure(fmt::format("expected a value for {}", port.path));
    if (lua_checkstack(L, 30) == 0) return failure("stack overflow");
    auto payload = read_payload(L, lua_absindex(L, value), port.type);
    if (!payload) return failure(fmt::format("{}: {}", port.title, payload.error().message));
    return payload;
}

// The act of a method of a port. `value` is the index of the value, if there is one.
Expected<Act> read_act(lua_State* L, const PortToRead& port, std::string_view method, int value) {
    const std::string& path = port.path;
    if (method == "release") return Release{path};
    if (method == "drop") return Drop{path};
    if (method == "freeze") return Freeze{path};
    auto payload = value_for(L, value, port);
    if (!payload) return Unexpected(payload.error());
    if (method == "inject") return Inject{path, std::move(*payload)};
    if (method == "write") return Write{path, std::move(*payload)};
    HoldOptions options;
    if (auto ok = read_options(L, value + 1, FieldCheck::of_options(path), options); !ok) return Unexpected(ok.error());
    return Hold{path, std::move(*payload), options.take};
}

// Performs a method of a port in two visits: the value is read between them, because it may be a million numbers, which
// would delay a tick. `find()` returns the `PortToRead`.
template <class Find>
Expected<Answer> act(lua_State* L, const Objects& objects, std::string_view method, int value, Find&& find) {
    Expected<PortToRead> port;
    auto found = ObjectAccess::visit(objects, [&]() -> Expected<Answer> {
        port = find();
        return port ? Expected<Answer>() : Unexpected(port.error());
    });
    if (!found) return found;
    const auto act = read_act(L, *port, method, value);
    if (!act) return Unexpected(act.error());
    return ObjectAccess::visit(objects, [&] { return answer_of(port->live->act(*act, ObjectAccess::who(objects))); });
}

// The description of an object for the error "expected a port, got ...".
std::string told(const ObjectRef& ref) {
    switch (ref.kind) {
        case ObjectKind::system: return "the system";
        case ObjectKind::component: return fmt::format("the component {}", ref.component());
        case ObjectKind::ports: return fmt::format("the ports of {}", ref.component());
        case ObjectKind::port: return fmt::format("the port {}.{}", ref.component(), ref.port());
        case ObjectKind::config: return fmt::format("the parameters of {}", ref.component());
        case ObjectKind::truth: return fmt::format("the truth of {}", ref.component());
        case ObjectKind::hosts: return "the hosts";
        case ObjectKind::host: return fmt::format("the host {}", ref.component());
        case ObjectKind::remote:
            return fmt::format("{} of another host", join_path(std::string(ref.component()), ref.port()));
    }
    return "";
}

}  // namespace

int call_port_method(lua_State* L) {
    Objects& objects = objects_of(L);
    return answer_beside(L, objects, [&]() -> Expected<Answer> {
        const std::string_view name = text_at(L, lua_upvalueindex(2));
        const ObjectRef* self = to_object(L, 1, ObjectKind::port);
        if (self == nullptr)
            return failure(fmt::format("{}: write `port:{}(...)` with a colon, not `port.{}(...)`", name, name, name));
        return act(L, objects, name, 2, [&]() -> Expected<PortToRead> {
            const auto at = find_port(*self);
            if (!at) return Unexpected(at.error());
            const MemberInfo& own = *find_member(port_members(), name);
            const std::string whole = fmt::format("{}:{}", at->path(), name);
            if (auto ok = Arguments{L, 2}.at_most(whole, own.most, own.usage); !ok) return Unexpected(ok.error());
            return to_read(*at);
        });
    });
}

Expected<PortAt> find_port(const ObjectRef& ref) {
    const auto node = node_of(ref);
    if (!node) return Unexpected(node.error());
    return PortAt{ref.live(), node->component(), node->port()};
}

Expected<PortAt> Objects::to_port(lua_State* L, int index) const {
    if (const ObjectRef* ref = to_object(L, index, ObjectKind::port)) return nezumi::find_port(*ref);
    if (const ObjectRef* ref = to_object(L, index, ObjectKind::component)) {
        return failure(
            fmt::format("expected a port, got the component {}: write {}.PORT", ref->component(), ref->component()));
    }
    if (lua_type(L, index) != LUA_TSTRING) {
        const ObjectRef* ref = to_object(L, index);
        return failure(fmt::format("expected a port or \"name.port\", got {}",
                                   ref != nullptr ? told(*ref) : std::string(Arguments{L}.kind(index))));
    }
    RunningSystem& live = core_->current();
    const std::string_view path = text_at(L, index);
    const auto port = live.system().port(path);
    if (!port) return Unexpected(port.error());
    return PortAt{&live, live.system().find(path.substr(0, path.find('.'))), *port};
}

Expected<void> Objects::act_on_port(lua_State* L, int index, std::string_view method) const {
    const auto done = act(L, *this, method, index + 1, [&]() -> Expected<PortToRead> {
        const auto at = to_port(L, index);
        if (!at) return Unexpected(at.error());
        return to_read(*at);
    });
    return done ? Expected<void>() : Unexpected(done.error());
}

}  // namespace nezumi
