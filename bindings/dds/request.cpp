// The topics of requests and replies between hosts.
#include "bindings/dds/request.hpp"

#include <fmt/format.h>

namespace nezumi::dds {
namespace {

Topic topic(std::string_view host, std::string_view what, std::string_view type) {
    constexpr int most_waiting = 64;
    return {.name = fmt::format("nezumi/{}/{}", host, what),
            .type = fmt::format("nezumi::{}", type),
            .reliable = false,
            .depth = most_waiting};
}

}  // namespace

Topic request_topic(std::string_view host) { return topic(host, "requests", Describe<RemoteRequest>::name); }
Topic reply_topic(std::string_view host) { return topic(host, "replies", Describe<Reply>::name); }

}  // namespace nezumi::dds
