// The client's side of the console's protocol, for the prompt, attach and batch.
#pragma once

#include <optional>
#include <string>

#include "bindings/console/protocol.hpp"
#include "engine/base/descriptor.hpp"

namespace nezumi {

class ConsoleClient {
public:
    explicit ConsoleClient(Descriptor socket) : socket_(std::move(socket)) {}

    /// A file descriptor that is readable if an event may have come.
    int file() const { return socket_.get(); }
    bool is_open() const { return bool(socket_); }
    /// Closes the connection.
    void close() { socket_.close(); }

    /// Sends a request with a new id and returns this id. Closes the connection if the system is gone.
    std::int64_t send(Request request);
    /// The next event. Waits for at most `timeout` [ms]; -1 waits without a limit. Returns nothing if no event came in
    /// this time, or if the system is gone (`is_open`).
    std::optional<Event> next(int timeout);
    /// Sends a ping and returns whether the system answered within `timeout` [ms]. Call it before any other request.
    bool is_answered(int timeout);

private:
    std::optional<Event> read_line();

    // Results may be long; the limit is for a system that sends a line without an end.
    static constexpr std::size_t longest_event = std::size_t{1} << 28;

    Descriptor socket_;
    LineReader reader_{longest_event};
    bool fed_ = false;  // the reader may have another line
    std::int64_t last_id_ = 0;
};

}  // namespace nezumi
