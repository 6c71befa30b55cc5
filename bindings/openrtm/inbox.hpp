// What CORBA's threads leave for the thread that ticks: messages for in-ports, decoded and bounded, and requests.
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
    const Port* port = nullptr;  ///< that it is for, in what is taken
    std::chrono::steady_clock::time_point came{};
};

class Inbox {
public:
    using Clock = std::chrono::steady_clock;

    /// Of each in-port; beyond these the oldest is dropped. Of velocities the latest alone waits.
    static constexpr std::size_t most_waiting = 64;
    static constexpr std::size_t most_bytes = std::size_t{32} << 20;
    /// A velocity that has waited longer, as while time stands, moves nobody any more: as long as robots go on without
    /// a word.
    static constexpr std::chrono::milliseconds longest_wait{500};

    /// The in-ports that take messages; must outlive the next call. What waits for others is dropped.
    void open_to(const std::map<std::string, const Port*, std::less<>>& ports);

    /// Decodes a message and keeps it. `problem` says what is wrong with one that is malformed.
    PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes, std::endian order,
                  std::string& problem);
    /// Keeps a zero for a velocity's in-port: who commanded it is gone.
    void put_zero(std::string_view path, std::string_view from);
    /// All messages that wait, those of each port in the order in which they came.
    std::vector<Arrival> take(Clock::time_point now = Clock::now());

    /// Leaves a request, and waits for its answer until `patience` is over: then it was not, and will not be, done.
    RtcAnswer ask(const RtcRequest& request, std::chrono::milliseconds patience);
    /// The requests that wait, each to be answered before this returns.
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
        std::size_t type = 0;
        std::deque<Arrival> arrivals{};
        std::size_t bytes = 0;
    };
    // A request on the stack of who asks.
    struct Asked {
        const RtcRequest& request;
        enum class State { waits, begun, done } state = State::waits;
        RtcAnswer answer = RtcAnswer::busy;
    };

    void keep(Waiting& waiting, Arrival arrival);
    Asked* next_asked();
    void finish(Asked& asked, RtcAnswer answer);

    Mutex mutex_;  // of all below
    std::map<std::string, Waiting, std::less<>> ports_;
    std::deque<Asked*> asked_;
    std::condition_variable answered_;
    std::uint64_t dropped_ = 0;
    std::uint64_t malformed_ = 0;
};

}  // namespace nezumi::openrtm
