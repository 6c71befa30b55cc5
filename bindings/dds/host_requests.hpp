// Requests to other hosts and from them, and the answers.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/dds/host_table.hpp"
#include "bindings/dds/request.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/system/network.hpp"
#include "engine/system/questions.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// A request is sent again until its answer comes or its time is over; who is asked does it once, and says again what
/// came of it when that is asked for again.
class HostRequests {
public:
    static constexpr double patience = 2;      ///< [s] for an answer
    static constexpr double repetition = 0.2;  ///< [s] until a request is sent again

    /// `host`, `run`: this one's. The transport must outlive it.
    HostRequests(DdsTransport& transport, std::string host, std::uint64_t run)
        : transport_(transport), host_(std::move(host)), run_(run) {}

    // `now` [s] by a clock that never falls.

    /// As of `Network`.
    Expected<std::uint64_t> ask(const Question& question, const HostTable& hosts, double now);
    std::optional<Expected<PlainData>> answer(std::uint64_t number, double now);

    /// Does what others ask for, takes what they have answered, asks again.
    void serve(const HostTable& hosts, const System& system, bool writable, const ActDoor& act, double now);

private:
    struct Asked {
        std::string host;
        Octets bytes;
        double began = 0;
        double sent = 0;
        std::optional<Expected<PlainData>> answer{};
    };
    // What a run of another host has asked.
    struct Asker {
        std::map<std::uint64_t, Octets> replies;  // by request
        std::uint64_t newest = 0;                 // of the requests that were done
        std::uint64_t over = 0;  // so far it came before its host was away: what comes again is recorded
    };

    void take_requests(const HostTable& hosts, const System& system, bool writable, const ActDoor& act);
    void take_replies();
    Writer* writer_for(const Topic& topic);

    DdsTransport& transport_;
    std::string host_;
    std::uint64_t run_;
    std::unique_ptr<Reader> requests_;
    std::unique_ptr<Reader> replies_;
    std::map<std::string, std::unique_ptr<Writer>, std::less<>> writers_;  // by topic
    std::map<std::uint64_t, Asked> asked_;                                 // by number
    std::map<std::uint64_t, Asker> askers_;                                // by run
    std::uint64_t last_ = 0;
};

}  // namespace nezumi::dds
