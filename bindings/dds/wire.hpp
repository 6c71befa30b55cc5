// What travels between hosts beside the payloads of ports, each described once: CDR follows.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/values/cdr.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::dds {

/// Changes with every change that makes two hosts unable to understand each other.
inline constexpr std::uint32_t protocol = 4;

/// How all of it is encoded.
inline constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};

/// [bytes] of a name in a message; longer ones are refused.
inline constexpr std::size_t longest_name = 200;
/// [bytes] of the reason for a refusal.
inline constexpr std::size_t longest_reason = 1000;

/// The start of every announcement, in every protocol: enough to name a host that can't be understood.
struct AnnouncementHead {
    std::uint32_t protocol = dds::protocol;  ///< what the rest is to be understood by
    std::string host;                        ///< its name
    std::string version;                     ///< of nezumi there
    bool operator==(const AnnouncementHead&) const = default;

    static constexpr std::string_view type_name = "AnnouncementHead";
};

struct AnnouncedPort {
    std::string name;  ///< name.port
    std::string type;  ///< of its messages
    bool in = false;   ///< an in-port
    bool operator==(const AnnouncedPort&) const = default;

    static constexpr std::string_view type_name = "AnnouncedPort";
};

/// A field of a message type, or one within it.
struct AnnouncedField {
    std::string path;    ///< "corners[i].x"; "" where the message is a single value
    std::string values;  ///< which ones it may have, and their unit
    bool operator==(const AnnouncedField&) const = default;

    static constexpr std::string_view type_name = "AnnouncedField";
};

/// A message type that a file defines. Hosts whose definitions differ say the field by it.
struct AnnouncedType {
    std::string type;  ///< as ports announce it
    std::string name;  ///< as its file defines it
    std::vector<AnnouncedField> fields;
    bool operator==(const AnnouncedType&) const = default;

    static constexpr std::string_view type_name = "AnnouncedType";
};

/// A connection between two hosts, both ends "host/name.port"; `why` is set in a refusal.
struct AnnouncedConnection {
    std::string from;   ///< host/name.port of an out-port
    std::string to;     ///< host/name.port of an in-port
    std::string why{};  ///< the reason of a refusal
    bool operator==(const AnnouncedConnection&) const = default;

    static constexpr std::string_view type_name = "AnnouncedConnection";
};

/// The description of a host, sent again whenever it changes. A host that comes late gets the last one.
struct Announcement {
    AnnouncementHead head;                      ///< who says this
    std::uint64_t run = 0;                      ///< another number each time that a host starts
    std::uint64_t number = 0;                   ///< of this announcement in its run, from 1 on
    std::vector<std::uint64_t> heard;           ///< runs of the hosts whose announcements it has
    std::vector<AnnouncedPort> ports;           ///< the ports of this host
    std::vector<AnnouncedType> types;           ///< of these ports, but the compiled ones; large ones may be left out
    std::vector<AnnouncedConnection> wants;     ///< connections that it was asked for
    std::vector<AnnouncedConnection> refusals;  ///< of those that other hosts want with it
    double lockstep = 0;                        ///< [Hz] its ticks, 0 where it keeps its own time
    std::vector<std::string> partners;          ///< hosts with which it is to keep in step, sorted
    bool operator==(const Announcement&) const = default;

    static constexpr std::string_view type_name = "Announcement";
};

/// What stands before the payload of a message between hosts.
struct MessageHead {
    std::uint64_t run = 0;     ///< as in the sender's announcement
    std::uint64_t number = 0;  ///< of the message in its topic, from 1 on
    double stamp = 0;          ///< [s] of the message, by the sender's time
    std::int64_t tick = 0;     ///< of the sender's, in which it was sent
    double offset = 0;         ///< [s] of the sender's monotonic clock over its time, when it was sent

    static constexpr std::string_view type_name = "MessageHead";
};

}  // namespace nezumi::dds
