// The structures that hosts send to each other, except for the payloads of ports. Their CDR encoding is derived from
// their descriptions.
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

/// The protocol's version: increased with every change that makes hosts incompatible.
inline constexpr std::uint32_t protocol = 4;

/// The encoding of all these structures.
inline constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};

/// [bytes] of a name in a message; longer ones are refused.
inline constexpr std::size_t longest_name = 200;
/// [bytes] of the reason for a refusal.
inline constexpr std::size_t longest_reason = 1000;

/// The start of every announcement, in every protocol: enough to name a host that can't be understood.
struct AnnouncementHead {
    std::uint32_t protocol = dds::protocol;  ///< the protocol of the rest of the announcement
    std::string host;                        ///< name of the host
    std::string version;                     ///< of nezumi on that host
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
    std::string values;  ///< the allowed values, and their unit
    bool operator==(const AnnouncedField&) const = default;

    static constexpr std::string_view type_name = "AnnouncedField";
};

/// A message type that a file defines. If the definitions of two hosts differ, the error can name the field.
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
    AnnouncementHead head;                      ///< the host that is described
    std::uint64_t run = 0;                      ///< another number each time that a host starts
    std::uint64_t number = 0;                   ///< of this announcement in its run, from 1 on
    std::vector<std::uint64_t> heard;           ///< runs of the hosts whose announcements it has
    std::vector<AnnouncedPort> ports;           ///< the ports of this host
    std::vector<AnnouncedType> types;           ///< types of these ports that files define; large ones may be missing
    std::vector<AnnouncedConnection> wants;     ///< connections that were requested on this host
    std::vector<AnnouncedConnection> refusals;  ///< connections of other hosts that this host refuses
    double lockstep = 0;                        ///< [Hz] tick rate in lockstep; 0: not in lockstep
    std::vector<std::string> partners;          ///< hosts that this host waits for in lockstep, sorted
    bool operator==(const Announcement&) const = default;

    static constexpr std::string_view type_name = "Announcement";
};

/// The head of a message between hosts, before the payload.
struct MessageHead {
    std::uint64_t run = 0;     ///< as in the sender's announcement
    std::uint64_t number = 0;  ///< of the message in its topic, from 1 on
    double stamp = 0;          ///< [s] of the message, by the sender's time
    std::int64_t tick = 0;     ///< the sender's tick in which the message was sent
    double offset = 0;         ///< [s] the sender's monotonic clock minus its system time, when it was sent

    static constexpr std::string_view type_name = "MessageHead";
};

}  // namespace nezumi::dds
