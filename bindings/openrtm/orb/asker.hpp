// The thread that asks RTCs when a user wants to know something, so that no other thread waits for a silent RTC.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_servers.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

class Asker {
public:
    Asker(CORBA::ORB_ptr orb, const std::vector<std::string>& nameservers);
    /// Answers the waiting questions before it returns.
    ~Asker();
    Asker(const Asker&) = delete;
    Asker& operator=(const Asker&) = delete;

    void ask(PeerQuestion question, TakeAnswer take);

private:
    struct Asked {
        PeerQuestion question{};
        TakeAnswer take{};
    };

    void run();
    PeerAnswer answer(const PeerQuestion& question);
    PeerAnswer unknown(const std::string& name, const Error& error);
    PeerAnswer of_connection(const RtcRequest& request);
    PeerAnswer look_at_all(bool is_whole);
    PeerSnapshot look_at_one(const NameService::Named& named, bool is_whole);

    NameServers names_;  // used only by the thread
    PortableServer::POA_var poa_;
    std::atomic<bool> ends_ = false;
    Mutex mutex_;  // for the next two
    std::condition_variable changed_;
    std::deque<Asked> asked_;
    std::thread thread_;
};

}  // namespace nezumi::openrtm
