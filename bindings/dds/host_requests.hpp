// Requests to and from other hosts, with their answers.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bindings/dds/host_table.hpp"
#include "bindings/dds/request.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/system/network.hpp"
#include "engine/system/questions.hpp"

namespace nezumi::dds {

/// A request is repeated until its answer arrives or its time is over. The other host executes it once, and repeats the
/// answer if the request arrives again.
class HostRequests {
public:
    static constexpr double patience = 2;      ///< [s] to wait for an answer
    static constexpr double repetition = 0.2;  ///< [s] between repetitions of a request

    /// `host`, `run`: of this host. The transport must outlive this object.
    HostRequests(DdsTransport& transport, std::string host, std::uint64_t run)
        : transport_(transport), host_(std::move(host)), run_(run) {}

    // `now` [s] by a monotonic clock.

    /// See `Network`.
    Expected<std::uint64_t> ask(const Question& question, const HostTable& hosts, double now);
    std::optional<Expected<PlainData>> answer(std::uint64_t number, double now);

    using Answer = std::function<Expected<PlainData>(const Question& question, const Actor& who)>;
    /// Answers requests of other hosts with `answer`, receives replies, and repeats requests that have no reply yet.
    void serve(const HostTable& hosts, const Answer& answer, double now);

private:
    struct Asked {
        std::string host;
        Octets bytes;
        double began = 0;
        double sent = 0;
        std::optional<Expected<PlainData>> answer{};
    };
    // The requests of one run of another host.
    struct Asker {
        std::map<std::uint64_t, Octets> replies;  // by request
        std::uint64_t newest = 0;                 // of the executed requests
        // Requests up to this number came before the host was last absent. If one arrives again, it is a replayed
        // message.
        std::uint64_t over = 0;
    };

    void take_requests(const HostTable& hosts, const Answer& answer);
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
