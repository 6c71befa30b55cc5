// Makes the networks of systems, each from what its file says: this host among others, and the node among those of ROS.
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

/// The places in domains that this process has. They stay while systems start anew.
class Domains {
public:
    using Open = std::function<Expected<std::unique_ptr<DdsTransport>>(const DomainOptions& options)>;

    explicit Domains(Open open = open_cyclone) : open_(std::move(open)) {}
    /// The place in this domain, which is joined when it is asked for first.
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

/// `domains` must outlive every system; `version`: of nezumi.
NetworkMaker make_networks(Domains& domains, std::string version);
/// Networks on which nobody else is: all is checked, and nothing leaves the process.
NetworkMaker make_silent_networks();
/// The same for a check of what would run here: the file of a secret is read as well.
NetworkMaker make_checked_networks();

}  // namespace nezumi::dds
