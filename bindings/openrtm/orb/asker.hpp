// The thread that asks RTCs questions of people: no other thread waits for a silent RTC.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <string>
#include <thread>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

class Asker {
public:
    Asker(CORBA::ORB_ptr orb, const std::string& nameserver);
    /// Answers waiting questions: the run ends.
    ~Asker();
    Asker(const Asker&) = delete;
    Asker& operator=(const Asker&) = delete;

    std::future<Expected<std::string>> ask(PeerQuestion question, TellPeers* tell);

private:
    struct Asked {
        PeerQuestion question{};
        TellPeers* tell = nullptr;
        std::promise<Expected<std::string>> promise{};
    };

    void run();
    PeerAnswer answer(const PeerQuestion& question);
    PeerAnswer look_at_all();

    NameService names_;  // used only by the thread
    std::atomic<bool> ends_ = false;
    Mutex mutex_;  // for the next two
    std::condition_variable changed_;
    std::deque<Asked> asked_;
    std::thread thread_;
};

}  // namespace nezumi::openrtm
