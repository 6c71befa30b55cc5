// `network` in system files: makes this system one of several hosts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/dds/domain_fields.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/peer_word_of.hpp"

namespace nezumi {
namespace dds {

/// `network { name, domain, interface, peers, secret, open, lockstep, hosts }`.
struct NetworkSpec {
    std::string name;
    std::int64_t domain = 0;
    std::string interface;  ///< "": the loopback
    std::vector<std::string> peers{};
    std::string secret{};       ///< the file of the secret, as written in the system file; "": none
    std::string secret_path{};  ///< where this file was found; "": nowhere
    bool open = false;
    bool lockstep = false;
    std::vector<std::string> hosts{};  ///< lockstep also waits for these before the first tick
    Place place{};
};

}  // namespace dds

template <>
struct Describe<dds::NetworkSpec> {
    static constexpr std::string_view name = "network";
    static constexpr std::string_view doc =
        "This system is one of several hosts. Without `network`, the system does not use the network.";
    static constexpr FieldList fields{
        Setting{"name", &dds::NetworkSpec::name, "", "what other hosts call this one", {.required = true}},
        Setting{"domain",
                &dds::NetworkSpec::domain,
                "",
                "hosts of one domain find each other",
                {.min = 0, .max = dds::last_domain}},
        Setting{"interface",
                &dds::NetworkSpec::interface,
                "",
                "the network interface, for example \"wlan0\"",
                {.fallback = "the loopback: processes of this machine"}},
        Setting{"peers", &dds::NetworkSpec::peers, "", "addresses of hosts, if the network has no multicast"},
        Setting{"secret",
                &dds::NetworkSpec::secret,
                "",
                "a file that `nezumi network secret` has made: hosts that have it may write",
                {.fallback = "on the loopback: the secret of this user"}},
        Setting{"open", &dds::NetworkSpec::open, "",
                "every host on the interface, or every user of this computer, may write without a secret"},
        Setting{"lockstep", &dds::NetworkSpec::lockstep, "",
                "connected simulations advance together, so that every run gives the same result"},
        Setting{"hosts", &dds::NetworkSpec::hosts, "",
                "hosts that lockstep waits for before it begins, in addition to those of connections"},
        Internal{&dds::NetworkSpec::secret_path},
        Internal{&dds::NetworkSpec::place},
    };
};

namespace dds {

class NetworkWord final : public PeerWordOf<NetworkSpec> {
public:
    bool needs_network() const override { return true; }
    Expected<void> check(const SystemSpec& system) const override;
    bool remove_at(SystemSpec& system, const Place& place) const override;

protected:
    void complete(NetworkSpec& given, Fields& fields, const PeerCall& call) const override;
    std::string text_of(const NetworkSpec& given) const override;
};

const NetworkWord& network_word();

}  // namespace dds
}  // namespace nezumi
