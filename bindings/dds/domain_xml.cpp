// The elements are those of the configuration reference of Cyclone DDS 0.10.
#include "bindings/dds/domain_xml.hpp"

#include <fmt/format.h>

#include "engine/base/xml_text.hpp"

namespace nezumi::dds {
namespace {

std::string quoted(const std::string& text) {
    std::string all = "\"";
    // Cyclone would insert an environment variable at a '$'.
    for (const char c : xml_text(text)) all += c == '$' ? std::string("&#36;") : std::string(1, c);
    return all + "\"";
}

std::string peer(const std::string& address) { return fmt::format("<Peer address={}/>", quoted(address)); }

}  // namespace

std::string domain_xml(const std::string& interface, const std::vector<std::string>& peers) {
    // A killed host is noticed after this time; hosts announce themselves four times as often.
    constexpr const char* lease = "5s";
    // The largest number of processes at one address that can be found without multicast.
    constexpr int processes = 32;
    std::string known;
    for (const std::string& address : peers) known += peer(address);
    if (interface.empty()) known += peer("127.0.0.1");
    return fmt::format(
        "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name={}/></Interfaces>"
        "<AllowMulticast>{}</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex><LeaseDuration>{}</LeaseDuration><Peers>{}</Peers>"
        "</Discovery></Domain></CycloneDDS>",
        quoted(interface.empty() ? "lo" : interface), interface.empty() ? "false" : "spdp", processes - 1, lease,
        known);
}

}  // namespace nezumi::dds
