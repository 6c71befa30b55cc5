// Makes the networks that a system file declares: this host among other hosts, and the ROS node.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/system/network.hpp"

namespace nezumi::dds {

/// The DDS participants of this process. They stay while systems restart.
class Domains {
public:
    using Open = std::function<Expected<std::unique_ptr<DdsTransport>>(const DomainOptions& options)>;

    explicit Domains(Open open = open_cyclone) : open_(std::move(open)) {}
    /// The participant in this domain; joins it at the first call.
    Expected<DdsTransport*> join(std::int64_t domain, const std::string& interface,
                                 const std::vector<std::string>& peers);

private:
    struct Joined {
        std::string xml;
        std::unique_ptr<DdsTransport> transport;
    };
    Open open_;
    std::map<std::int64_t, Joined> joined_;
};

/// `domains` must outlive every system. `version`: of nezumi.
NetworkMaker make_networks(Domains& domains, std::string version);
/// Makes networks that check everything but send and receive nothing.
NetworkMaker make_silent_networks();
/// Makes silent networks for checking whether a system can run on this computer: also reads the file of the secret.
NetworkMaker make_checked_networks();

}  // namespace nezumi::dds
