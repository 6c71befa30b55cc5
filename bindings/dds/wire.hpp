// What travels between hosts beside the payloads of ports, each described once: CDR follows.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "engine/ports/cdr.hpp"
#include "engine/ports/describe.hpp"

namespace nezumi::dds {

/// Changes with whatever makes two hosts unable to understand each other.
inline constexpr std::uint32_t protocol = 2;

/// How all of it is encoded.
inline constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};

/// [bytes] of a name in a message; longer ones are refused.
inline constexpr std::size_t longest_name = 200;

/// What every announcement begins with, in every protocol: enough to say who can't be understood.
struct AnnouncementHead {
    std::uint32_t protocol = dds::protocol;
    std::string host;
    std::string version;
    bool operator==(const AnnouncementHead&) const = default;
};

struct AnnouncedPort {
    std::string name;
    std::string type;
    bool in = false;
    bool operator==(const AnnouncedPort&) const = default;
};

/// A connection between two hosts, both ends "host/name.port"; in a refusal with the reason.
struct AnnouncedConnection {
    std::string from;
    std::string to;
    std::string why{};
    bool operator==(const AnnouncedConnection&) const = default;
};

/// What a host says of itself, again whenever it changes. Who comes late is given the last one.
struct Announcement {
    AnnouncementHead head;
    std::uint64_t run = 0;                      ///< another number each time that a host starts
    std::uint64_t number = 0;                   ///< of this announcement in its run, from 1 on
    std::vector<std::uint64_t> heard;           ///< runs of the hosts whose announcements it has
    std::vector<AnnouncedPort> ports;           ///< that it has
    std::vector<AnnouncedConnection> wants;     ///< connections that it was asked for
    std::vector<AnnouncedConnection> refusals;  ///< of those that other hosts want with it
    double lockstep = 0;                        ///< [Hz] its ticks, 0 where it keeps its own time
    std::vector<std::string> partners;          ///< hosts with which it is to keep in step, sorted
    bool operator==(const Announcement&) const = default;
};

/// What stands before the payload of a message between hosts.
struct MessageHead {
    std::uint64_t run = 0;     ///< as in the sender's announcement
    std::uint64_t number = 0;  ///< of the message in its topic, from 1 on
    double stamp = 0;
    std::int64_t tick = 0;
    double offset = 0;
};

}  // namespace nezumi::dds

namespace nezumi {

template <>
struct Describe<dds::AnnouncementHead> {
    using T = dds::AnnouncementHead;
    static constexpr std::string_view name = "AnnouncementHead";
    static constexpr std::tuple fields{
        Field{"protocol", &T::protocol, "", "what the rest is to be understood by"},
        Field{"host", &T::host, "", "its name"},
        Field{"version", &T::version, "", "of nezumi there"},
    };
};

template <>
struct Describe<dds::AnnouncedPort> {
    using T = dds::AnnouncedPort;
    static constexpr std::string_view name = "AnnouncedPort";
    static constexpr std::tuple fields{
        Field{"name", &T::name, "", "name.port"},
        Field{"type", &T::type, "", "of its messages"},
        Field{"in", &T::in, "", "an in-port"},
    };
};

template <>
struct Describe<dds::AnnouncedConnection> {
    using T = dds::AnnouncedConnection;
    static constexpr std::string_view name = "AnnouncedConnection";
    static constexpr std::tuple fields{
        Field{"from", &T::from, "", "host/name.port of an out-port"},
        Field{"to", &T::to, "", "host/name.port of an in-port"},
        Field{"why", &T::why, "", "it is refused"},
    };
};

template <>
struct Describe<dds::Announcement> {
    using T = dds::Announcement;
    static constexpr std::string_view name = "Announcement";
    static constexpr std::tuple fields{
        Field{"head", &T::head, "", "who says this"},
        Field{"run", &T::run, "", "since its start"},
        Field{"number", &T::number, "", "in its run, from 1 on"},
        Field{"heard", &T::heard, "", "runs of hosts that it knows of"},
        Field{"ports", &T::ports, "", "that it has"},
        Field{"wants", &T::wants, "", "connections with other hosts"},
        Field{"refusals", &T::refusals, "", "of what others want"},
        Field{"lockstep", &T::lockstep, "Hz", "its ticks, 0: its own time"},
        Field{"partners", &T::partners, "", "to keep in step with"},
    };
};

template <>
struct Describe<dds::MessageHead> {
    using T = dds::MessageHead;
    static constexpr std::string_view name = "MessageHead";
    static constexpr std::tuple fields{
        Field{"run", &T::run, "", "of the sender"},
        Field{"number", &T::number, "", "in its topic, from 1 on"},
        Field{"stamp", &T::stamp, "s", "of the message, by the sender's time"},
        Field{"tick", &T::tick, "", "of the sender's, in which it was sent"},
        Field{"offset", &T::offset, "s", "of the sender's monotonic clock over its time, when it was sent"},
    };
};

}  // namespace nezumi
