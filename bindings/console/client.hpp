// The client's end of the console's protocol: what the prompt, attach and batch talk through.
#pragma once

#include <optional>
#include <string>

#include "bindings/console/protocol.hpp"
#include "engine/base/descriptor.hpp"

namespace nezumi {

class ConsoleClient {
public:
    explicit ConsoleClient(Descriptor socket) : socket_(std::move(socket)) {}

    /// Readable when an event may have come.
    int file() const { return socket_.get(); }
    bool is_open() const { return bool(socket_); }
    /// Leaves.
    void close() { socket_.close(); }

    /// Sends a request, under an id of its own that is returned. When the system is gone, the client is closed.
    std::int64_t send(Request request);
    /// The next event; waits for it for at most `timeout` [ms], -1: as long as it takes. Nothing when none came in that
    /// time, or when the system is gone (`is_open`).
    std::optional<Event> next(int timeout);
    /// Asks for a sign of life, and whether it came within `timeout` [ms]. Before any other request.
    bool is_answered(int timeout);

private:
    std::optional<Event> read_line();

    // Results may be long; a system is trusted not to send lines without end.
    static constexpr std::size_t longest_event = std::size_t{1} << 28;

    Descriptor socket_;
    LineReader reader_{longest_event};
    bool fed_ = false;  // the reader may have another line
    std::int64_t last_id_ = 0;
};

}  // namespace nezumi
