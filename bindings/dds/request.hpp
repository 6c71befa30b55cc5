// Requests of one host to components of another, and the replies, as sent over the network.
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
    std::uint64_t from = 0;    ///< run of the host that sends the request
    std::uint64_t to = 0;      ///< run of the receiver: after a restart the request is no longer valid
    std::uint64_t number = 0;  ///< of the request in its run, from 1 on
    std::uint8_t what = 0;     ///< `Question::What`
    std::string component{};   ///< name of the component
    std::string name{};        ///< of a set, parameter or command
    PlainData values{};        ///< of the parameter, or arguments

    static constexpr std::string_view type_name = "Request";
};

struct Reply {
    std::uint64_t to = 0;      ///< run of the host that sent the request
    std::uint64_t number = 0;  ///< of the request
    bool well = false;         ///< the request was executed
    std::string problem{};     ///< the reason if it was not
    PlainData values{};        ///< the result

    static constexpr std::string_view type_name = "Reply";
};

/// The topics for requests to a host, and for replies to it. Best effort: a lost request is repeated by its sender, and
/// no old request waits in a broken connection to be executed much later.
Topic request_topic(std::string_view host);
Topic reply_topic(std::string_view host);

}  // namespace nezumi::dds
