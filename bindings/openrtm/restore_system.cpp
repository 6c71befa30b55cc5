// First everything is checked, then everything is changed. Robots move at the very end.
#include "bindings/openrtm/restore_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"

namespace nezumi::openrtm {
namespace {

using What = RtcRequest::What;

// Splits "localhost/pc.host_cxt/ConsoleIn0.rtc" into "localhost" and "pc.host_cxt/ConsoleIn0". Some editors write a "/"
// before the path.
std::pair<std::string, std::string> split_path(std::string_view path) {
    while (path.starts_with('/')) path.remove_prefix(1);
    const std::size_t slash = path.find('/');
    if (slash == std::string_view::npos) return {};
    std::string_view name = path.substr(slash + 1);
    if (constexpr std::string_view kind = ".rtc"; name.ends_with(kind)) name.remove_suffix(kind.size());
    return {std::string(path.substr(0, slash)), std::string(name)};
}

class Restoration {
public:
    Restoration(const SystemProfile& profile, const RestoreHost& host) : profile_(profile), host_(host) {}

    bool run() {
        if (!find_all() || !has_all_ports()) return false;
        for (const auto* connections : {&profile_.connections, &profile_.service_connections}) {
            for (const ProfiledConnection& each : *connections) connect(each);
        }
        for (const ProfiledComponent& each : profile_.components) configure(each);
        for (const ProfiledComponent& each : profile_.components) activate(each);
        return is_whole_;
    }

private:
    static std::string name_of(const ProfiledComponent& component) {
        const std::string name = split_path(component.path).second;
        return name.empty() ? component.instance : name;
    }

    void fail(const std::string& line) {
        is_whole_ = false;
        host_.say(true, visible(line));
    }
    void say(const std::string& line) const { host_.say(false, visible(line)); }

    const PeerSnapshot* find(const ProfiledComponent* component) const {
        const auto found = there_.find(component);
        return found != there_.end() ? &found->second : nullptr;
    }

    // Waits until all components answer. Returns false if a required component is missing.
    bool find_all() {
        std::map<const ProfiledComponent*, std::string> missing;
        bool waits = false;
        for (;;) {
            for (const ProfiledComponent& component : profile_.components) {
                if (there_.contains(&component)) continue;
                PeerAnswer answer = host_.ask({.name = name_of(component)});
                if (answer.problem.empty() && !answer.peers.empty() &&
                    answer.peers.front().state < PeerSnapshot::State::silent) {
                    there_.emplace(&component, std::move(answer.peers.front()));
                    missing.erase(&component);
                } else {
                    missing[&component] = answer.problem.empty() ? "it does not answer" : answer.problem;
                }
            }
            if (missing.empty()) break;
            if (!std::exchange(waits, true)) {
                std::string names;
                for (const auto& [component, problem] : missing)
                    names += (names.empty() ? "" : ", ") + component->instance;
                say("waiting for " + names);
            }
            if (!host_.wait()) break;
        }
        bool has_required = true;
        for (const ProfiledComponent& component : profile_.components) {
            const auto gone = missing.find(&component);
            const PeerSnapshot* peer = find(&component);
            if (gone != missing.end()) {
                fail(fmt::format("{}: {}", component.instance, gone->second));
            } else if (peer->state == PeerSnapshot::State::error) {
                fail(fmt::format("{}: it is in ERROR: reset it, for example by rtm(\"{}\", \"reset\")",
                                 component.instance, peer->name));
            } else {
                continue;
            }
            has_required = has_required && !component.is_required;
        }
        if (!has_required) host_.say(true, "nothing was changed: the system does not work without these components");
        return has_required;
    }

    // True if the ports of all connections between the found components exist.
    bool has_all_ports() {
        bool has_all = true;
        for (const auto* connections : {&profile_.connections, &profile_.service_connections}) {
            for (const ProfiledConnection& connection : *connections) {
                for (const ProfiledEnd* end : {&connection.from, &connection.to}) {
                    const ProfiledComponent* component = component_at(profile_, *end);
                    const PeerSnapshot* peer = find(component);
                    if (component == nullptr) {
                        fail(fmt::format("connection {}: the profile has no component '{}'", text_of(connection),
                                         end->instance));
                        has_all = false;
                    } else if (peer != nullptr &&
                               std::none_of(peer->ports.begin(), peer->ports.end(),
                                            [&](const auto& port) { return port.name == end->port; })) {
                        fail(fmt::format("{}: it has no port '{}'", end->instance, end->port));
                        has_all = has_all && !component->is_required;
                    }
                }
            }
        }
        if (!has_all) host_.say(true, "nothing was changed: the system does not work without these ports");
        return has_all;
    }

    static std::string text_of(const ProfiledConnection& connection) {
        return fmt::format("{}.{} to {}.{}", connection.from.instance, connection.from.port, connection.to.instance,
                           connection.to.port);
    }

    void connect(const ProfiledConnection& connection) {
        const ProfiledComponent* from = component_at(profile_, connection.from);
        const ProfiledComponent* to = component_at(profile_, connection.to);
        if (find(from) == nullptr || find(to) == nullptr) {
            return fail("not connected: " + text_of(connection) + ": one of the two components was not found");
        }
        const std::string between = text_of(connection);
        RtcRequest request{.what = What::connect,
                           .component = connection.name.empty() ? between : connection.name,
                           .values = connection.properties,
                           .from = find(from)->name + "." + connection.from.port,
                           .to = find(to)->name + "." + connection.to.port,
                           .id = connection.id};
        const PeerAnswer answer = host_.ask({.request = std::move(request)});
        if (!answer.problem.empty()) {
            unfit_.insert({from, to});
            return fail("not connected: " + between + ": " + answer.problem);
        }
        say((answer.was_so ? "connected already: " : "connected: ") + between);
    }

    void configure(const ProfiledComponent& component) {
        const PeerSnapshot* peer = find(&component);
        if (peer == nullptr) return;
        const auto ask = [&](RtcRequest request, const std::string& what) {
            const PeerAnswer answer = host_.ask({.name = peer->name, .request = std::move(request)});
            if (answer.problem.empty()) return true;
            unfit_.insert(&component);
            fail(fmt::format("{}: {}: {}", component.instance, what, answer.problem));
            return false;
        };
        // The set to be activated comes last, because a change of values also activates the changed set.
        std::vector<const std::pair<std::string, Texts>*> sets;
        for (const auto& set : component.sets) {
            if (!set.second.empty() && !set.first.starts_with("__")) sets.push_back(&set);
        }
        std::stable_partition(sets.begin(), sets.end(), [&](const auto* set) { return set->first != component.set; });
        bool is_done = true;
        for (const auto* set : sets) {
            if (has_values(*peer, *set)) continue;
            is_done = ask({.what = What::set, .set = set->first, .values = set->second}, "set '" + set->first + "'") &&
                      is_done;
        }
        if (!component.set.empty() && (!sets.empty() || peer->set != component.set))
            is_done = ask({.what = What::use, .set = component.set}, "set '" + component.set + "'") && is_done;
        if (is_done && !component.set.empty()) say(fmt::format("{}: set {}", component.instance, component.set));
    }

    static bool has_values(const PeerSnapshot& peer, const std::pair<std::string, Texts>& wanted) {
        const auto set = std::find_if(peer.sets.begin(), peer.sets.end(),
                                      [&](const auto& each) { return each.first == wanted.first; });
        if (set == peer.sets.end()) return false;
        return std::all_of(wanted.second.begin(), wanted.second.end(),
                           [&](const auto& value) { return contains(set->second, value); });
    }

    void activate(const ProfiledComponent& component) {
        const PeerSnapshot* peer = find(&component);
        if (peer == nullptr) return;
        if (unfit_.contains(&component))
            return fail("not activated: " + component.instance +
                        ": a connection or its configuration was refused, see above");
        if (peer->state == PeerSnapshot::State::error) return;  // reported
        if (peer->state == PeerSnapshot::State::active) return say("active already: " + component.instance);
        const PeerAnswer answer = host_.ask({.name = peer->name, .request = RtcRequest{.what = What::activate}});
        if (!answer.problem.empty()) return fail("not activated: " + component.instance + ": " + answer.problem);
        say("activated: " + component.instance);
    }

    const SystemProfile& profile_;
    const RestoreHost& host_;
    std::map<const ProfiledComponent*, PeerSnapshot> there_;
    std::set<const ProfiledComponent*> unfit_;  // components with a refused connection or configuration
    bool is_whole_ = true;
};

}  // namespace

Expected<std::vector<std::string>> nameservers_of(const SystemProfile& profile) {
    std::vector<std::string> all;
    for (const ProfiledComponent& component : profile.components) {
        std::string server = split_path(component.path).first;
        if (server.empty()) continue;
        if (const std::string problem = adopt_nameserver(server); !problem.empty())
            return failure(fmt::format("component '{}': path '{}': {}", shown(component.instance),
                                       shown(component.path), problem));
        add_once(all, std::move(server));
    }
    if (all.empty()) all = RtmSpec{}.nameservers;
    return all;
}

bool restore_system(const SystemProfile& profile, const RestoreHost& host) { return Restoration(profile, host).run(); }

}  // namespace nezumi::openrtm
