// `hosts`: the other hosts, and the components of each.
#include "bindings/lua/live/hosts_object.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/lua/live/object_core.hpp"

namespace nezumi {

using Names = std::vector<std::string>;

std::vector<Host> hosts_of(const System& system) {
    return system.network() != nullptr ? system.network()->hosts() : std::vector<Host>{};
}

std::vector<std::string> component_names(const Host& host) {
    std::vector<std::string> names;
    for (const OfferedPort& port : host.ports) names.push_back(port.name.substr(0, port.name.find('.')));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::vector<OfferedPort> ports_of(const System& system, std::string_view path) {
    std::vector<OfferedPort> ports;
    const std::string prefix = fmt::format("{}.", without_host(path));
    for (const Host& host : hosts_of(system)) {
        if (host.name != host_of(path)) continue;
        for (OfferedPort port : host.ports) {
            if (!port.name.starts_with(prefix)) continue;
            port.name.erase(0, prefix.size());
            ports.push_back(std::move(port));
        }
    }
    return ports;
}

Expected<Host> find_host(const System& system, std::string_view name) {
    if (system.network() == nullptr)
        return failure("this system is not on a network: add network { name = ... } to its file");
    const std::vector<Host> all = hosts_of(system);
    for (const Host& host : all) {
        if (host.name == name) return host;
    }
    return failure(fmt::format("there is no host '{}'{}", shown(name), did_you_mean(name, all, &Host::name)));
}

Expected<void> check_offered(const System& system, std::string_view path) {
    const auto host = find_host(system, host_of(path));
    if (!host) return Unexpected(host.error());
    if (!host->here) return failure(fmt::format("host '{}' is offline", host->name));
    const std::string_view port = without_host(path);
    for (const OfferedPort& each : host->ports) {
        if (each.name == port) return {};
    }
    return failure(fmt::format("host {} has no port {}{}", host->name, shown(port),
                               did_you_mean(port, host->ports, &OfferedPort::name)));
}

namespace {

int refuse_set_hosts(lua_State* L) {
    return answer(L, objects_of(L),
                  []() -> Expected<Answer> { return failure("the object hosts and its members can't be set"); });
}

int host_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        if (lua_type(L, 2) != LUA_TSTRING) return failure("expected the name of a component of the host");
        const std::string_view name = text_at(L, 2);
        return Answer{ObjectName{ObjectKind::remote, ref.live(), fmt::format("{}/{}", ref.component(), name), ""}};
    });
}

int host_tostring(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        const ObjectRef& ref = *to_object(L, 1);
        const auto host = find_host(ref.live()->system(), ref.component());
        if (!host) return Answer{host.error().message};
        if (!host->here) return Answer{fmt::format("host '{}' is offline", host->name)};
        return Answer{fmt::format("{}: {}", host->name, fmt::join(component_names(*host), ", "))};
    });
}

int hosts_index(lua_State* L) {
    return look(L, objects_of(L), [&]() -> Expected<Answer> {
        RunningSystem* live = to_object(L, 1)->live();
        if (lua_type(L, 2) != LUA_TSTRING) return failure("expected the name of a host, as in hosts.ev3");
        const auto host = find_host(live->system(), text_at(L, 2));
        if (!host) return Unexpected(host.error());
        return Answer{ObjectName{ObjectKind::host, live, host->name, ""}};
    });
}

int hosts_tostring(lua_State* L) {
    return answer(L, objects_of(L), [&]() -> Expected<Answer> {
        const System& system = to_object(L, 1)->live()->system();
        if (system.network() == nullptr) return Answer{find_host(system, "").error().message};
        Names lines;
        for (const Host& host : hosts_of(system))
            lines.push_back(host.here ? fmt::format("{}: {}", host.name, fmt::join(component_names(host), ", "))
                                      : fmt::format("host '{}' is offline", host.name));
        return Answer{lines.empty() ? "there are no other hosts" : fmt::format("{}", fmt::join(lines, "\n"))};
    });
}

int host_pairs(lua_State* L) {
    return pairs_of_names(L, [](const ObjectRef& ref) -> Expected<Names> {
        const auto host = find_host(ref.live()->system(), ref.component());
        if (!host) return Unexpected(host.error());
        return component_names(*host);
    });
}

int hosts_pairs(lua_State* L) {
    return pairs_of_names(L, [](const ObjectRef& ref) -> Expected<Names> { return host_names(ref.live()->system()); });
}

}  // namespace

const ObjectFunctions& hosts_functions() {
    static constexpr ObjectFunctions functions{hosts_index, refuse_set_hosts, hosts_pairs, hosts_tostring, "hosts"};
    return functions;
}

const ObjectFunctions& host_functions() {
    static constexpr ObjectFunctions functions{host_index, refuse_set_hosts, host_pairs, host_tostring, "host"};
    return functions;
}

void push_hosts(lua_State* L, Objects& objects, RunningSystem& live) {
    push_object(L, objects, ObjectKind::hosts, live, "", "");
}

Names host_names(const System& system) {
    Names names;
    for (const Host& host : hosts_of(system)) names.push_back(host.name);
    return names;
}

Names offered_ports(const System& system, bool in, bool out, std::string_view type) {
    Names paths;
    for (const Host& host : hosts_of(system)) {
        for (const OfferedPort& port : host.ports) {
            const bool fits = (port.direction == Direction::in ? in : out) && (type.empty() || type == port.type);
            if (fits) paths.push_back(fmt::format("{}/{}", host.name, port.name));
        }
    }
    return paths;
}

std::string offered_type(const System& system, std::string_view path) {
    for (const Host& host : hosts_of(system)) {
        if (host.name != host_of(path)) continue;
        for (const OfferedPort& port : host.ports) {
            if (port.name == without_host(path)) return port.type;
        }
    }
    return "";
}

}  // namespace nezumi
