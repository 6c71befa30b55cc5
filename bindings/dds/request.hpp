// What one host asks of another's components, and the answer, as they travel.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"
#include "engine/values/describe.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi::dds {

struct RemoteRequest {
    std::uint64_t from = 0;    ///< run of the host that asks
    std::uint64_t to = 0;      ///< run of the host that is asked: another start of that host is another host
    std::uint64_t number = 0;  ///< of the request in its run, from 1 on
    std::uint8_t what = 0;     ///< `Question::What`
    std::string component{};   ///< of whom
    std::string name{};        ///< of a set, parameter or command
    PlainData values{};        ///< of the parameter, or arguments

    static constexpr std::string_view type_name = "Request";
};

struct Reply {
    std::uint64_t to = 0;      ///< run of who asked
    std::uint64_t number = 0;  ///< of the request
    bool well = false;         ///< it was done
    std::string problem{};     ///< when not
    PlainData values{};        ///< that it has come to

    static constexpr std::string_view type_name = "Reply";
};

/// Requests to a host, and replies to it. Best effort: what is lost is asked again, and nothing waits in a broken link
/// to be done when it heals.
Topic request_topic(std::string_view host);
Topic reply_topic(std::string_view host);

}  // namespace nezumi::dds
