// Connections that other hosts want: they are made and ended as acts of these hosts, or refused with a reason.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/dds/announced_types.hpp"
#include "bindings/dds/system_network.hpp"
#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"
#include "engine/messages/message_catalog.hpp"

namespace nezumi::dds {
namespace {

// Connections made per check at the request of other hosts: acts cost time, and other hosts are not trusted.
constexpr int most_made = 16;
// Limits over the life of this system: connections that other hosts make while they may only read, and reported
// refusals.
constexpr int most_looked = 4096, most_told = 100;

}  // namespace

void SystemNetwork::refuse(const Ends& ends, const std::string& why) {
    if (!refusals_.try_emplace(ends, why.substr(0, longest_reason)).second) return;
    if (++told_ > most_told) return;
    system_.log(LogLevel::warn, fmt::format("host {} asked for connect({}, {}), which was refused: {}", other_of(ends),
                                            local(ends.first), local(ends.second), why));
    if (told_ == most_told)
        system_.log(LogLevel::warn, "network: further refused connections of other hosts are not reported");
}

// True if both ends of a connection with this host exist; an error if they can't be connected.
Expected<bool> SystemNetwork::can_be(const Ends& ends, const Announcement& host) const {
    const bool ours_first = host_of(ends.first) == settings_.name;
    const std::string& our_end = ours_first ? ends.first : ends.second;
    const std::string& their_end = ours_first ? ends.second : ends.first;
    const auto ours = std::as_const(system_).port(without_host(our_end));
    const AnnouncedPort* theirs = HostTable::find_port(host, without_host(their_end));
    if (!ours || theirs == nullptr) return false;
    if (theirs->type == wire_name(*(*ours)->type())) return true;
    const auto defined = std::find_if(host.types.begin(), host.types.end(),
                                      [&](const AnnouncedType& each) { return each.type == theirs->type; });
    if (defined != host.types.end()) {
        const std::string difference = explain_difference(*(*ours)->type(), our_end, *defined, their_end);
        if (!difference.empty())
            return failure(fmt::format("the definitions of {} differ: {}", (*ours)->type_name(), difference));
    }
    return failure(fmt::format("types differ: {} is {}, {} is {}", our_end, (*ours)->type_name(), their_end,
                               shown(defined != host.types.end() ? defined->name : theirs->type)));
}

// Returns true if nothing is left for the next check.
bool SystemNetwork::make_what_others_want(const std::vector<Ends>& present, const ActDoor& act) {
    std::set<Ends> wanted;
    int made_now = 0;
    for (const Announcement* host : hosts_.all()) {
        const std::string& name = host->head.host;
        for (const AnnouncedConnection& want : host->wants) {
            const Ends ends{want.from, want.to};
            const bool theirs_first = host_of(want.from) == name && host_of(want.to) == settings_.name;
            const bool ours_first = host_of(want.from) == settings_.name && host_of(want.to) == name;
            if (!theirs_first && !ours_first) continue;
            wanted.insert(ends);
            if (refusals_.contains(ends)) continue;
            if (contains(present, ends)) continue;
            const auto fits = can_be(ends, *host);
            if (fits && !*fits) {  // one end is missing: for example a script was reloaded without the port
                brought_.erase(ends);
                continue;
            }
            if (brought_.contains(ends)) {  // the connection was ended here, so the other host is informed
                brought_.erase(ends);
                refusals_.try_emplace(ends, "the connection was ended on that host");
                continue;
            }
            if (!fits) {
                refuse(ends, fits.error().message);
                continue;
            }
            if (theirs_first && !settings_.writable) {
                refuse(ends,
                       "other hosts can only read: write secret or open = true in network { ... } to let them write");
                continue;
            }
            if (++made_now > most_made) continue;  // at the next check
            if (!settings_.writable && ++looked_ > most_looked) {
                refuse(ends, "other hosts have connected to too many ports");
                continue;
            }
            const auto made = act(Connect{local(want.from), local(want.to)}, {Actor::Kind::network, name});
            if (made) {
                brought_.emplace(ends, name);
            } else {
                refuse(ends, made.error().message);
            }
        }
    }
    // A refusal is forgotten when the connection is no longer requested, so that it may be requested again.
    std::erase_if(refusals_, [&](const auto& each) {
        return !wanted.contains(each.first) && hosts_.find(other_of(each.first)) != nullptr;
    });
    return made_now <= most_made;
}

void SystemNetwork::end_what_they_no_longer_want(const std::vector<Ends>& present, const ActDoor& act) {
    for (auto each = brought_.begin(); each != brought_.end();) {
        const Ends& ends = each->first;
        const std::string& name = each->second;
        const Announcement* host = hosts_.find(name);  // a missing host may come back
        const auto is_it = [&](const AnnouncedConnection& want) {
            return want.from == ends.first && want.to == ends.second;
        };
        if (host == nullptr || std::any_of(host->wants.begin(), host->wants.end(), is_it)) {
            ++each;
            continue;
        }
        if (contains(present, ends))
            static_cast<void>(act(Disconnect{local(ends.first), local(ends.second)}, {Actor::Kind::network, name}));
        each = brought_.erase(each);
    }
}

// Ends connections that this host requested but the other one refuses.
void SystemNetwork::end_what_is_refused(const std::vector<Ends>& present, const ActDoor& act) {
    for (const Announcement* host : hosts_.all()) {
        const std::string name = host->head.host;
        for (const AnnouncedConnection& refusal : host->refusals) {
            const Ends ends{refusal.from, refusal.to};
            if (other_of(ends) != name || brought_.contains(ends)) continue;
            if (!contains(present, ends)) continue;
            system_.log(LogLevel::warn, fmt::format("connect({}, {}): host {} refuses: {}", local(ends.first),
                                                    local(ends.second), name, visible(refusal.why)));
            static_cast<void>(act(Disconnect{local(ends.first), local(ends.second)}, {Actor::Kind::network, name}));
        }
    }
}

}  // namespace nezumi::dds
