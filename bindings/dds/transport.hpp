// The interface for sending bytes between processes and hosts by topics, so that the rest of bindings/dds can be
// tested without a network.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"

namespace nezumi::dds {

/// A topic and its quality of service. A writer and a reader are matched by name, type and reliability.
struct Topic {
    std::string name;  ///< in DDS: "nezumi/mouse_pi/controller/out", "rt/cmd_vel"
    std::string type;  ///< name of its type, compared by peers
    bool reliable = false;
    bool keeps_last = false;  ///< a late reader gets the last message (reliable only)
    bool keeps_all = false;   ///< nothing is dropped: a write without space is refused (reliable only)
    bool wakes = false;       ///< for a reader: has `Reader::file`
    int depth = 1;            ///< longest queue of a reader; the oldest messages are dropped
    std::string user_data{};  ///< of the writer or reader, visible to others
    /// For a reader: rejected messages are dropped on arrival, before they displace waiting ones. None: all are
    /// admitted. Called from any thread, also by several at the same time.
    std::function<bool(std::span<const std::uint8_t> cdr)> admits{};
};

/// A received message.
struct TopicSample {
    Octets bytes;              ///< CDR with its header
    std::uint64_t writer = 0;  ///< the sender: a number that belongs to one writer and is not used again
};

/// Sends on a topic during its lifetime.
class Writer {
public:
    virtual ~Writer() = default;
    /// Sends CDR with its header; never blocks. Returns false if it was not accepted.
    virtual bool write(std::span<const std::uint8_t> cdr) = 0;
    /// The present number of readers.
    virtual int readers() const = 0;
};

/// Receives on a topic during its lifetime.
class Reader {
public:
    virtual ~Reader() = default;
    /// The messages since the last call, oldest first.
    virtual std::vector<TopicSample> take() = 0;
    /// The present writers, as in `TopicSample::writer`.
    virtual std::vector<std::uint64_t> writers() const = 0;
    /// Readable when a message has come since the last `take`; -1: not available.
    virtual int file() const { return -1; }
    /// The number of lost or dropped messages since the start.
    virtual std::uint64_t lost() const = 0;
};

/// A writer or reader in the domain.
struct SeenEndpoint {
    std::string topic;
    std::string type;
    bool writes = false;
    bool reliable = false;
    bool own = false;  ///< of this process
};

/// A participant in a domain.
class DdsTransport {
public:
    virtual ~DdsTransport() = default;
    /// Returns nullptr on failure; the reason is then `problem()`.
    virtual std::unique_ptr<Writer> write(const Topic& topic) = 0;
    virtual std::unique_ptr<Reader> read(const Topic& topic) = 0;
    /// Every known writer and reader in the domain, including its own.
    virtual std::vector<SeenEndpoint> seen() = 0;
    virtual std::string problem() const = 0;
    /// The number of messages that were dropped because they are not encrypted, or encrypted with another secret.
    virtual std::uint64_t strange() const { return 0; }
};

}  // namespace nezumi::dds
