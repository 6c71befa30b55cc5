// Reads, checks and writes `network { ... }`.
#include "bindings/dds/network_word.hpp"

#include <fmt/format.h>

#include "engine/base/names.hpp"
#include "engine/records/write_record.hpp"

namespace nezumi::dds {

void NetworkWord::complete(NetworkSpec& given, Fields& fields, const PeerCall& call) const {
    FieldCheck& check = fields.check();
    if (check.ok() && !is_identifier(given.name))
        check.wrong({"name"},
                    fmt::format("expected letters, digits and _, not beginning with a digit, got '{}'", given.name));
    if (check.ok() && call.is_taken(given.name))
        check.wrong({"name"}, fmt::format("may not be '{}', a keyword of Lua or a command of the console", given.name));
    if (check.ok() && given.open && !given.secret.empty())
        check.explain({"open"},
                      "with a `secret`, only hosts that have the secret may write: leave out `open` or `secret`");
    if (check.ok() && !given.hosts.empty() && !given.lockstep)
        check.explain({"hosts"}, "only lockstep waits for hosts: say `lockstep = true` as well");
    check_peers(check, given.peers);
    for (const std::string& host : given.hosts) {
        if (!check.ok()) break;
        if (!is_identifier(host)) check.wrong({"hosts"}, fmt::format("expected names of hosts, got '{}'", host));
        if (host == given.name)
            check.wrong({"hosts"}, fmt::format("may not contain '{}', the name of this host", host));
    }
    // The secret is not read here, because everything that is read for a system is recorded.
    if (!check.ok() || given.secret.empty()) return;
    if (const auto path = call.project.find(FileKind::data, given.secret, given.place.file))
        given.secret_path = path->string();
}

std::string NetworkWord::text_of(const NetworkSpec& given) const {
    const std::string own = write_record(given);
    return fmt::format("network {{ {}{}{} }}\n", own.substr(2, own.size() - 4), names_text("peers", given.peers),
                       names_text("hosts", given.hosts));
}

Expected<void> NetworkWord::check(const SystemSpec& system) const {
    const NetworkSpec* network = find(system);
    for (const ConnectionSpec& each : system.connections) {
        if (!is_remote(each.from) && !is_remote(each.to)) continue;
        const std::string& remote = is_remote(each.from) ? each.from : each.to;
        const auto refuse = [&](std::string_view why) {
            return failure(fmt::format("connect: {}: {}", remote, why), each.place);
        };
        if (network == nullptr) return refuse("a port of another host needs network { name = ... } in the system file");
        if (is_remote(each.from) && is_remote(each.to))
            return refuse("both ports are on other hosts: connect them in the system file of one of these hosts");
        if (host_of(remote) == network->name)
            return refuse(fmt::format("this host is '{}' itself: write \"{}\"", network->name, without_host(remote)));
    }
    return {};
}

bool NetworkWord::remove_at(SystemSpec& system, const Place& place) const {
    const NetworkSpec* network = find(system);
    if (network == nullptr || network->place != place) return false;
    system.peers.erase(std::string(name()));
    std::erase_if(system.connections, [](const ConnectionSpec& c) { return is_remote(c.from) || is_remote(c.to); });
    return true;
}

const NetworkWord& network_word() {
    static const NetworkWord word;
    return word;
}

}  // namespace nezumi::dds
