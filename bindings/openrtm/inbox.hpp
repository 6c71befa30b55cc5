// Queues from CORBA's threads to the ticking thread: decoded messages for in-ports, and requests. Both are limited.
#pragma once

#include <bit>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "engine/base/mutex.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/values/value.hpp"

namespace nezumi::openrtm {

struct Arrival {
    std::string path{};  ///< of an in-port
    std::string from{};  ///< the connection's name
    Value value{};
    const Port* port = nullptr;  ///< the in-port, set by `take`
    std::chrono::steady_clock::time_point came{};
};

class Inbox {
public:
    using Clock = std::chrono::steady_clock;

    /// Limits of waiting messages per in-port; above them the oldest is dropped. Of velocities only the latest waits.
    static constexpr std::size_t most_waiting = 64;
    static constexpr std::size_t most_bytes = std::size_t{32} << 20;
    /// A velocity that has waited longer than this is dropped. Robots without a command stop after the same time.
    static constexpr std::chrono::milliseconds longest_wait{500};

    /// Sets the in-ports that accept messages; the ports must exist until the next call. Waiting messages for other
    /// ports are dropped.
    void open_to(const std::map<std::string, const Port*, std::less<>>& ports);

    /// Decodes a message and queues it. If the message is malformed, `problem` gets the error.
    PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes, std::endian order,
                  std::string& problem);
    /// Queues a zero for a velocity's in-port when the sender has disconnected.
    void put_zero(std::string_view path, std::string_view from);
    /// Returns all waiting messages; those of each port in order of arrival.
    std::vector<Arrival> take(Clock::time_point now = Clock::now());

    /// Queues a request and waits for its answer. A request that is not begun within `patience` is not executed.
    RtcAnswer ask(const RtcRequest& request, std::chrono::milliseconds patience);
    /// Executes all waiting requests with `perform`, and answers them.
    template <class Perform>
    void answer(const Perform& perform) {
        while (Asked* asked = next_asked()) finish(*asked, perform(asked->request));
    }
    bool has_requests();

    std::uint64_t dropped();
    std::uint64_t malformed();

private:
    struct Waiting {
        const Port* port = nullptr;
        const MessageType* type = nullptr;
        std::deque<Arrival> arrivals{};
        std::size_t bytes = 0;
    };
    // A waiting request. It is on the stack of the thread that called `ask`.
    struct Asked {
        const RtcRequest& request;
        enum class State { waits, begun, done } state = State::waits;
        RtcAnswer answer = RtcAnswer::busy;
    };

    void keep(Waiting& waiting, Arrival arrival);
    Asked* next_asked();
    void finish(Asked& asked, RtcAnswer answer);

    Mutex mutex_;  // for all members below
    std::map<std::string, Waiting, std::less<>> ports_;
    std::deque<Asked*> asked_;
    std::condition_variable answered_;
    std::uint64_t dropped_ = 0;
    std::uint64_t malformed_ = 0;
};

}  // namespace nezumi::openrtm
