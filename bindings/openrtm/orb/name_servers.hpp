// All name services of a system. One that does not answer is not asked for a while, so that it does not delay searches
// in the others.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"

namespace nezumi::openrtm {

class NameServers {
public:
    /// If there are several name services: one that did not answer is not asked again during this time.
    static constexpr std::chrono::seconds rest{3};

    struct Server {
        NameService names;
        bool may_rest = false;  ///< there are other name services to ask instead
        std::chrono::steady_clock::time_point rests_until{};
        bool is_resting() const { return std::chrono::steady_clock::now() < rests_until; }
        void let_rest() {
            if (may_rest) rests_until = std::chrono::steady_clock::now() + rest;
        }
    };

    /// `addresses`: "HOST:PORT", not empty. Makes no call yet.
    NameServers(CORBA::ORB_ptr orb, const std::vector<std::string>& addresses);

    std::deque<Server>& each() { return servers_; }
    /// "localhost:2809, pc:2809"
    std::string addresses() const;
    const std::string& own_context() const { return servers_.front().names.own_context(); }

    // If no name service answers, these functions throw the CORBA exception of the last one.
    /// Finds an RTC in the first name service that has it, as `NameService::find`.
    Expected<NameService::Named> find(const std::string& component);
    /// The RTCs of all name services. An RTC in several name services is listed once.
    std::vector<NameService::Named> all();
    /// Removes the name of an RTC that has ended from all name services. An error if the RTC still runs.
    PeerAnswer forget(const NameService::Named& named);

private:
    template <class Call>
    void ask_each(const Call& call);

    std::deque<Server> servers_;
};

}  // namespace nezumi::openrtm
