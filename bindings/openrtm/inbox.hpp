// The queue from CORBA's threads to the ticking thread: decoded messages for in-ports, and requests; both limited.
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

    /// Per in-port; above it the oldest is dropped. Of velocities only the latest waits.
    static constexpr std::size_t most_waiting = 64;
    static constexpr std::size_t most_bytes = std::size_t{32} << 20;
    /// A velocity that has waited longer than this is dropped. It is also the time after which robots without a command
    /// stop.
    static constexpr std::chrono::milliseconds longest_wait{500};

    /// Sets the in-ports that accept messages; they must outlive the next call. Waiting messages for others are
    /// dropped.
    void open_to(const std::map<std::string, const Port*, std::less<>>& ports);

    /// Decodes a message and queues it. `problem` gets the error of a malformed one.
    PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes, std::endian order,
                  std::string& problem);
    /// Queues a zero for a velocity's in-port when the sender has disconnected.
    void put_zero(std::string_view path, std::string_view from);
    /// Returns all waiting messages; those of each port in order of arrival.
    std::vector<Arrival> take(Clock::time_point now = Clock::now());

    /// Queues a request and waits for its answer for at most `patience`. After that it is not executed.
    RtcAnswer ask(const RtcRequest& request, std::chrono::milliseconds patience);
    /// Answers all waiting requests before it returns.
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
    // A request on the stack of the asking thread.
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
