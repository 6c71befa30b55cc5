// If there is only one name service, it is always asked, because there is no other to ask instead.
#include "bindings/openrtm/orb/name_servers.hpp"

#include <algorithm>

#include "bindings/openrtm/orb/life.hpp"

namespace nezumi::openrtm {

NameServers::NameServers(CORBA::ORB_ptr orb, const std::vector<std::string>& addresses) {
    for (const std::string& address : addresses) servers_.push_back({NameService(orb, address), addresses.size() > 1});
}

std::string NameServers::addresses() const {
    std::string text;
    for (const Server& server : servers_) text += (text.empty() ? "" : ", ") + server.names.address();
    return text;
}

// Calls a function with each name service until it returns true.
template <class Call>
void NameServers::ask_each(const Call& call) {
    std::size_t silent = 0;
    const bool all_rest = std::all_of(servers_.begin(), servers_.end(), [](const Server& s) { return s.is_resting(); });
    for (Server& server : servers_) {
        if (server.is_resting() && !all_rest) {
            ++silent;
            continue;
        }
        try {
            if (call(server.names)) return;
        } catch (const CORBA::Exception&) {
            server.let_rest();
            if (++silent == servers_.size()) throw;
        }
    }
}

Expected<NameService::Named> NameServers::find(const std::string& component) {
    Expected<NameService::Named> found = failure("there is no RTC '" + component + "' in the name service");
    ask_each([&](NameService& names) {
        auto here = names.find(component);
        const bool is_more = here || !found;
        if (is_more) found = std::move(here);
        return found.has_value();
    });
    return found;
}

std::vector<NameService::Named> NameServers::all() {
    std::vector<NameService::Named> all;
    ask_each([&](NameService& names) {
        for (NameService::Named& each : names.all()) {
            const auto is_it = [&](const NameService::Named& other) {
                return other.name == each.name && other.rtc->_is_equivalent(each.rtc);
            };
            if (std::none_of(all.begin(), all.end(), is_it)) all.push_back(std::move(each));
        }
        return false;
    });
    return all;
}

PeerAnswer NameServers::forget(const NameService::Named& named) {
    if (life_of(named.rtc) != Life::gone)
        return {.problem = "the RTC still runs, or hangs: only names of RTCs that have ended can be removed"};
    ask_each([&](NameService& names) {
        names.unbind_whole(named);
        return false;
    });
    return {};
}

}  // namespace nezumi::openrtm
