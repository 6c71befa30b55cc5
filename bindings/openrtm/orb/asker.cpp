// Asks many RTCs in parallel, so that several silent RTCs together cost one second.
#include "bindings/openrtm/orb/asker.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>
#include <utility>

#include "bindings/openrtm/orb/peer_calls.hpp"
#include "bindings/openrtm/orb/rtc_object.hpp"
#include "engine/base/list.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// The number of RTCs that are asked in parallel, and the time after which no further RTC is asked.
constexpr std::size_t most_at_once = 16;
constexpr std::chrono::seconds patience{3};
// Waiting questions.
constexpr std::size_t most_questions = 16;

// Returns "ConsoleOut0" of "pc.host_cxt/ConsoleOut0".
std::string last_of(const std::string& name) { return name.substr(name.rfind('/') + 1); }

}  // namespace

Asker::Asker(CORBA::ORB_ptr orb, const std::vector<std::string>& nameservers) : names_(orb, nameservers) {
    const CORBA::Object_var root = orb->resolve_initial_references("RootPOA");
    poa_ = PortableServer::POA::_narrow(root);
    thread_ = start_thread([this] { run(); });
}

Asker::~Asker() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
    for (Asked& asked : asked_) asked.take(asked.question, {.problem = "the run ends"});
}

void Asker::ask(PeerQuestion question, TakeAnswer take) {
    {
        const std::lock_guard lock(mutex_);
        if (asked_.size() < most_questions) {
            asked_.push_back({std::move(question), std::move(take)});
            changed_.notify_all();
            return;
        }
    }
    take(question, {.problem = "too many questions are already waiting"});
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
        asked.take(asked.question, answer(asked.question));
    }
}

PeerAnswer Asker::unknown(const std::string& name, const Error& error) {
    PeerAnswer none{.problem = error.message, .missing = name};
    const bool is_short = name.find('/') == std::string::npos;
    for (const auto& each : names_.all()) none.known.push_back(is_short ? last_of(each.name) : each.name);
    if (contains(none.known, none.missing)) none.known.clear();
    return none;
}

// Connects two ports of other programs, or ends their connection.
PeerAnswer Asker::of_connection(const RtcRequest& request) {
    std::array<PeerPort, 2> ends;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const std::string& path = i == 0 ? request.from : request.to;
        const std::size_t dot = std::min(path.rfind('.'), path.size());
        auto found = names_.find(path.substr(0, dot));
        if (!found) return unknown(path.substr(0, dot), found.error());
        ends[i] = {std::move(*found), path.substr(std::min(dot + 1, path.size()))};
    }
    return connect_peers(ends, request);
}

PeerAnswer Asker::answer(const PeerQuestion& question) {
    try {
        if (question.request && !question.request->from.empty()) return of_connection(*question.request);
        if (question.name.empty()) return look_at_all(question.is_whole);
        auto found = names_.find(question.name);
        if (!found) return unknown(question.name, found.error());
        try {
            if (question.request) {
                PeerAnswer answer = question.request->what == RtcRequest::What::forget
                                        ? names_.forget(*found)
                                        : perform(*found, *question.request);
                if (!answer.problem.empty()) answer.problem = "rtm:" + found->name + ": " + answer.problem;
                return answer;
            }
            return {.peers = {look_at(*found, true)}};
        } catch (const CORBA::TIMEOUT&) {
            return {.problem = "'" + question.name + "' does not answer"};
        } catch (const CORBA::Exception&) {
            return {.problem = "'" + question.name + "' was not found: its entry in the name service is stale"};
        }
    } catch (const CORBA::Exception&) {
        return {.problem = "no name service answers at " + names_.addresses() + ": start one, for example omniNames"};
    }
}

// For an RTC of this program, also adds the paths of its ports.
PeerSnapshot Asker::look_at_one(const NameService::Named& named, bool is_whole) {
    const RtcObject* ours = nullptr;
    PortableServer::ServantBase_var servant;
    try {
        servant = poa_->reference_to_servant(named.rtc);
        ours = dynamic_cast<const RtcObject*>(servant.in());
    } catch (const CORBA::Exception&) {
        ours = nullptr;  // it is of another program
    }
    PeerSnapshot snapshot = look_at(named, is_whole && ours == nullptr);
    if (ours == nullptr) return snapshot;
    snapshot.is_ours = true;
    for (PeerSnapshot::Port& port : snapshot.ports) {
        for (const RtcPort& known : ours->profile().ports) {
            if (known.name == port.name) port.path = known.path;
        }
    }
    return snapshot;
}

PeerAnswer Asker::look_at_all(bool is_whole) {
    const std::vector<NameService::Named> all = names_.all();
    PeerAnswer answer;
    answer.peers.resize(all.size());
    const auto end = std::chrono::steady_clock::now() + patience;
    std::atomic<std::size_t> next = 0;
    const auto look = [&] {
        for (std::size_t i = next++; i < all.size(); i = next++) {
            const bool has_time = !ends_ && std::chrono::steady_clock::now() < end;
            answer.peers[i] = has_time ? look_at_one(all[i], is_whole)
                                       : PeerSnapshot{.name = all[i].name, .state = PeerSnapshot::State::unasked};
        }
    };
    std::vector<std::thread> helpers;
    try {
        for (std::size_t i = 1; i < std::min(all.size(), most_at_once); ++i) helpers.push_back(start_thread(look));
    } catch (const std::system_error&) {
        // No further thread can be made. The existing ones do the work, only slower.
    }
    look();
    for (std::thread& helper : helpers) helper.join();
    return answer;
}

}  // namespace nezumi::openrtm
