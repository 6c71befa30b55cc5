// Queues messages and requests from CORBA's threads for the ticking thread. Messages are decoded in the thread that
// received them.
#include "bindings/openrtm/inbox.hpp"

#include <utility>

#include "bindings/openrtm/rtm_wiring.hpp"
#include "engine/ports/payload.hpp"
#include "engine/values/limits.hpp"

namespace nezumi::openrtm {
namespace {

std::size_t bytes_of(const Arrival& arrival) {
    return sizeof(Arrival) + arrival.path.size() + arrival.from.size() + heap_bytes(arrival.value);
}

// True for a velocity that has waited too long. A stop (zero) is never outdated.
bool is_outdated(const Arrival& arrival, Inbox::Clock::time_point now) {
    const auto* velocity = arrival.value.get_if<Velocity2D>();
    return velocity != nullptr && *velocity != Velocity2D{} && now - arrival.came > Inbox::longest_wait;
}

}  // namespace

void Inbox::open_to(const std::map<std::string, const Port*, std::less<>>& ports) {
    const std::lock_guard lock(mutex_);
    std::map<std::string, Waiting, std::less<>> open;
    for (const auto& [path, port] : ports) {
        const auto before = ports_.find(path);
        const bool stays = before != ports_.end() && before->second.type == port->type();
        const auto opened = open.emplace(path, stays ? std::move(before->second) : Waiting{.type = port->type()});
        opened.first->second.port = port;
    }
    ports_ = std::move(open);
}

PutAnswer Inbox::put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                     std::endian order, std::string& problem) {
    const MessageType* type = nullptr;
    {
        const std::lock_guard lock(mutex_);
        const auto port = ports_.find(path);
        if (port == ports_.end()) return PutAnswer::unknown;
        type = port->second.type;
    }
    Arrival arrival{std::string(path), std::string(from), make_payload(type)};
    const auto read = read_rtm_message(bytes, *type, arrival.value, order);
    problem = read ? find_misfit(ValueView(arrival.value)) : read.error().message;
    if (problem.empty() && !is_finite(arrival.value)) problem = "expected finite numbers";
    const bool is_fit = problem.empty();
    const std::lock_guard lock(mutex_);
    if (!is_fit) {
        ++malformed_;
        return PutAnswer::malformed;
    }
    const auto port = ports_.find(path);
    if (port == ports_.end() || port->second.type != type) return PutAnswer::unknown;
    keep(port->second, std::move(arrival));
    return PutAnswer::taken;
}

void Inbox::put_zero(std::string_view path, std::string_view from) {
    const std::lock_guard lock(mutex_);
    const auto port = ports_.find(path);
    if (port == ports_.end() || port->second.type != message_of<Velocity2D>()) return;
    keep(port->second, {std::string(path), std::string(from), Velocity2D{}});
}

void Inbox::keep(Waiting& waiting, Arrival arrival) {
    arrival.came = Clock::now();
    if (waiting.type == message_of<Velocity2D>()) {
        waiting.arrivals.clear();
        waiting.bytes = 0;
    }
    waiting.bytes += bytes_of(arrival);
    waiting.arrivals.push_back(std::move(arrival));
    while (waiting.arrivals.size() > 1 && (waiting.arrivals.size() > most_waiting || waiting.bytes > most_bytes)) {
        waiting.bytes -= bytes_of(waiting.arrivals.front());
        waiting.arrivals.pop_front();
        ++dropped_;
    }
}

std::vector<Arrival> Inbox::take(Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    std::vector<Arrival> all;
    for (auto& [path, waiting] : ports_) {
        for (Arrival& arrival : waiting.arrivals) {
            if (is_outdated(arrival, now)) continue;
            arrival.port = waiting.port;
            all.push_back(std::move(arrival));
        }
        waiting.arrivals.clear();
        waiting.bytes = 0;
    }
    return all;
}

RtcAnswer Inbox::ask(const RtcRequest& request, std::chrono::milliseconds patience) {
    Asked asked{request};
    Lock lock(mutex_);
    asked_.push_back(&asked);
    const auto was_done = [&] { return asked.state == Asked::State::done; };
    if (answered_.wait_for(lock, patience, was_done)) return asked.answer;
    if (asked.state == Asked::State::begun) {
        answered_.wait(lock, was_done);  // the request is being executed, and this ends soon
    } else {
        std::erase(asked_, &asked);
    }
    return asked.answer;
}

Inbox::Asked* Inbox::next_asked() {
    const std::lock_guard lock(mutex_);
    if (asked_.empty()) return nullptr;
    Asked* asked = asked_.front();
    asked_.pop_front();
    asked->state = Asked::State::begun;
    return asked;
}

void Inbox::finish(Asked& asked, RtcAnswer answer) {
    const std::lock_guard lock(mutex_);
    asked.answer = answer;
    asked.state = Asked::State::done;
    answered_.notify_all();  // with the lock held: the asking thread may destroy it as soon as it is answered
}

bool Inbox::has_requests() {
    const std::lock_guard lock(mutex_);
    return !asked_.empty();
}

std::uint64_t Inbox::dropped() {
    const std::lock_guard lock(mutex_);
    return dropped_;
}

std::uint64_t Inbox::malformed() {
    const std::lock_guard lock(mutex_);
    return malformed_;
}

}  // namespace nezumi::openrtm
