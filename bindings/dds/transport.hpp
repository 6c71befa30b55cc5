// What carries octets between processes and hosts, by topics: an interface, so that all else of this room can be tried
// without a network.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi::dds {

/// A topic, and how it is carried. Both ends compare name, type and what they promise.
struct Topic {
    std::string name;  ///< on the wire: "nezumi/mouse_pi/controller/out", "rt/cmd_vel"
    std::string type;  ///< name of its type, as peers compare it
    bool reliable = false;
    bool keeps_last = false;  ///< who comes late is given the last message (reliable only)
    bool keeps_all = false;   ///< nothing is dropped: what finds no room is not taken (reliable only)
    bool wakes = false;       ///< of a reader: has `Reader::file`
    int depth = 1;            ///< messages that a reader keeps until they are taken; the oldest go first
    std::string user_data{};  ///< of the writer or reader, for whoever looks
    /// A reader's: what it does not admit is dropped as it comes, before it takes the place of what waits. None: all is
    /// admitted. Asked from any thread, several at once.
    std::function<bool(std::span<const std::uint8_t> cdr)> admits{};
};

/// A message as it came.
struct TopicSample {
    Octets bytes;              ///< CDR with its header
    std::uint64_t writer = 0;  ///< who sent it: the same number for the same writer, never again another's
};

/// Sends on a topic. It ends with its object.
class Writer {
public:
    virtual ~Writer() = default;
    /// Sends CDR with its header; never waits. False when it was not taken.
    virtual bool write(std::span<const std::uint8_t> cdr) = 0;
    /// How many readers there are just now.
    virtual int readers() const = 0;
};

/// Receives on a topic. It ends with its object.
class Reader {
public:
    virtual ~Reader() = default;
    /// What has come since the last call, oldest first.
    virtual std::vector<TopicSample> take() = 0;
    /// The writers there are just now, as in `TopicSample::writer`.
    virtual std::vector<std::uint64_t> writers() const = 0;
    /// Is readable when something has come since the last `take`; -1: none.
    virtual int file() const { return -1; }
    /// Messages that were lost, or dropped because nobody took them, since the start.
    virtual std::uint64_t lost() const = 0;
};

/// A writer or reader that somebody in the domain has.
struct SeenEndpoint {
    std::string topic;
    std::string type;
    bool writes = false;
    bool reliable = false;
    bool own = false;  ///< of this process
};

/// A place in a domain.
class DdsTransport {
public:
    virtual ~DdsTransport() = default;
    /// nullptr when there is none to be had: the reason is then `problem()`.
    virtual std::unique_ptr<Writer> write(const Topic& topic) = 0;
    virtual std::unique_ptr<Reader> read(const Topic& topic) = 0;
    /// Every writer and reader in the domain that was found up to now, own ones too.
    virtual std::vector<SeenEndpoint> seen() = 0;
    virtual std::string problem() const = 0;
    /// Messages that came and were dropped, as they were sealed with another secret or not at all.
    virtual std::uint64_t strange() const { return 0; }
};

}  // namespace nezumi::dds
