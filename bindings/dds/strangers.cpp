// A host with another secret sends messages that can't be decrypted. Hosts with and without a secret use topics with
// different names.
#include "bindings/dds/strangers.hpp"

#include <fmt/format.h>

#include <string_view>

#include "bindings/dds/host_table.hpp"
#include "bindings/dds/sealed_transport.hpp"

namespace nezumi::dds {
namespace {

// [s] between two checks of all endpoints of the domain.
constexpr double strangers_period = 1;

}  // namespace

std::string Strangers::look(double now) {
    if (told_ || now < next_) return "";
    next_ = now + strangers_period;
    std::string_view who;
    if (transport_.strange() > 0) who = "a host with another secret (for example of another user)";
    const std::string plain = announcement_topic().name;
    const std::string sealed = sealed_name(plain);
    for (const SeenEndpoint& each : transport_.seen()) {
        if (each.own || !each.writes || !who.empty()) continue;
        if (sealed_ && each.topic == plain) who = "a host without a secret (open = true)";
        if (!sealed_ && each.topic == sealed) who = "a host with a secret";
    }
    if (who.empty()) return "";
    told_ = true;
    return fmt::format("{} was found, but refused: set the same `secret = FILE` on both, or `open = true` on both",
                       who);
}

}  // namespace nezumi::dds
