// Asks many RTCs in parallel, so that several silent ones cost one second in all.
#include "bindings/openrtm/orb/asker.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

#include "bindings/openrtm/orb/peer_calls.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// RTCs asked in parallel, and the time during which further ones are started.
constexpr std::size_t most_at_once = 16;
constexpr std::chrono::seconds patience{3};
// Waiting questions.
constexpr std::size_t most_questions = 16;

// Returns "ConsoleOut0" of "pc.host_cxt/ConsoleOut0".
std::string last_of(const std::string& name) { return name.substr(name.rfind('/') + 1); }

}  // namespace

Asker::Asker(CORBA::ORB_ptr orb, const std::string& nameserver) : names_(orb, nameserver) {
    thread_ = start_thread([this] { run(); });
}

Asker::~Asker() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
    for (Asked& asked : asked_) asked.promise.set_value(failure("the run ends"));
}

std::future<Expected<std::string>> Asker::ask(PeerQuestion question, TellPeers* tell) {
    Asked asked{std::move(question), tell};
    auto answer = asked.promise.get_future();
    {
        const std::lock_guard lock(mutex_);
        if (asked_.size() < most_questions) {
            asked_.push_back(std::move(asked));
        } else {
            asked.promise.set_value(failure("too many questions are already waiting"));
        }
    }
    changed_.notify_all();
    return answer;
}

void Asker::run() {
    for (;;) {
        Asked asked;
        {
            Lock lock(mutex_);
            changed_.wait(lock, [this] { return ends_ || !asked_.empty(); });
            if (ends_) return;
            asked = std::move(asked_.front());
            asked_.pop_front();
        }
        asked.promise.set_value(asked.tell(asked.question, answer(asked.question)));
    }
}

PeerAnswer Asker::answer(const PeerQuestion& question) {
    try {
        if (question.name.empty()) return look_at_all();
        auto found = names_.find(question.name);
        if (!found) {
            PeerAnswer none{.problem = found.error().message, .missing = question.name};
            const bool is_short = question.name.find('/') == std::string::npos;
            for (const auto& each : names_.all()) none.known.push_back(is_short ? last_of(each.name) : each.name);
            if (std::find(none.known.begin(), none.known.end(), none.missing) != none.known.end()) none.known.clear();
            return none;
        }
        try {
            if (question.request) {
                PeerAnswer answer = perform(*found, *question.request);
                if (!answer.problem.empty()) answer.problem = "rtm:" + found->name + ": " + answer.problem;
                return answer;
            }
            return {.peers = {look_at(*found, true)}};
        } catch (const CORBA::TIMEOUT&) {
            return {.problem = "'" + question.name + "' does not answer"};
        } catch (const CORBA::Exception&) {
            return {.problem = "'" + question.name + "' is not there: its entry in the name service is stale"};
        }
    } catch (const CORBA::Exception&) {
        return {.problem = "no name service answers at " + names_.address() + ": start one, as omniNames"};
    }
}

PeerAnswer Asker::look_at_all() {
    const std::vector<NameService::Named> all = names_.all();
    PeerAnswer answer;
    answer.peers.resize(all.size());
    const auto end = std::chrono::steady_clock::now() + patience;
    std::atomic<std::size_t> next = 0;
    const auto look = [&] {
        for (std::size_t i = next++; i < all.size(); i = next++) {
            const bool has_time = !ends_ && std::chrono::steady_clock::now() < end;
            answer.peers[i] = has_time ? look_at(all[i], false)
                                       : PeerSnapshot{.name = all[i].name, .state = PeerSnapshot::State::unasked};
        }
    };
    std::vector<std::thread> helpers;
    try {
        for (std::size_t i = 1; i < std::min(all.size(), most_at_once); ++i) helpers.push_back(start_thread(look));
    } catch (const std::system_error&) {
        // No further thread can be made: the existing ones do the work.
    }
    look();
    for (std::thread& helper : helpers) helper.join();
    return answer;
}

}  // namespace nezumi::openrtm
