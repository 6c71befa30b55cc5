// What travels between hosts beside the payloads of ports, each described once: CDR follows.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "engine/values/cdr.hpp"
#include "engine/values/describe.hpp"

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

    static constexpr std::tuple fields{
        Field{"protocol", &AnnouncementHead::protocol, "", "what the rest is to be understood by"},
        Field{"host", &AnnouncementHead::host, "", "its name"},
        Field{"version", &AnnouncementHead::version, "", "of nezumi there"},
    };
};

struct AnnouncedPort {
    std::string name;
    std::string type;
    bool in = false;
    bool operator==(const AnnouncedPort&) const = default;

    static constexpr std::tuple fields{
        Field{"name", &AnnouncedPort::name, "", "name.port"},
        Field{"type", &AnnouncedPort::type, "", "of its messages"},
        Field{"in", &AnnouncedPort::in, "", "an in-port"},
    };
};

/// A connection between two hosts, both ends "host/name.port"; in a refusal with the reason.
struct AnnouncedConnection {
    std::string from;
    std::string to;
    std::string why{};
    bool operator==(const AnnouncedConnection&) const = default;

    static constexpr std::tuple fields{
        Field{"from", &AnnouncedConnection::from, "", "host/name.port of an out-port"},
        Field{"to", &AnnouncedConnection::to, "", "host/name.port of an in-port"},
        Field{"why", &AnnouncedConnection::why, "", "it is refused"},
    };
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

    static constexpr std::tuple fields{
        Field{"head", &Announcement::head, "", "who says this"},
        Field{"run", &Announcement::run, "", "since its start"},
        Field{"number", &Announcement::number, "", "in its run, from 1 on"},
        Field{"heard", &Announcement::heard, "", "runs of hosts that it knows of"},
        Field{"ports", &Announcement::ports, "", "that it has"},
        Field{"wants", &Announcement::wants, "", "connections with other hosts"},
        Field{"refusals", &Announcement::refusals, "", "of what others want"},
        Field{"lockstep", &Announcement::lockstep, "Hz", "its ticks, 0: its own time"},
        Field{"partners", &Announcement::partners, "", "to keep in step with"},
    };
};

/// What stands before the payload of a message between hosts.
struct MessageHead {
    std::uint64_t run = 0;     ///< as in the sender's announcement
    std::uint64_t number = 0;  ///< of the message in its topic, from 1 on
    double stamp = 0;
    std::int64_t tick = 0;
    double offset = 0;

    static constexpr std::tuple fields{
        Field{"run", &MessageHead::run, "", "of the sender"},
        Field{"number", &MessageHead::number, "", "in its topic, from 1 on"},
        Field{"stamp", &MessageHead::stamp, "s", "of the message, by the sender's time"},
        Field{"tick", &MessageHead::tick, "", "of the sender's, in which it was sent"},
        Field{"offset", &MessageHead::offset, "s", "of the sender's monotonic clock over its time, when it was sent"},
    };
};

}  // namespace nezumi::dds
