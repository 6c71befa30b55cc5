// Carries requests and events between clients' sockets and the thread that ticks, which never waits for a client.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bindings/console/protocol.hpp"
#include "bindings/console/socket_directory.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi {

using ClientId = std::uint64_t;

class Transport {
public:
    /// What came from a client.
    struct Incoming {
        enum class What { opened, request, closed };
        ClientId client = 0;
        What what = What::request;
        Request request;
    };

    /// How a client's events are kept while it does not take them.
    enum class Flow {
        lossy,    ///< what only shows something is left out, and counted, past `max_backlog`; see `takes_more`
        lossless  ///< the same, past `max_lossless`: nothing is, where a run waits while it is behind
    };

    /// [bytes] that wait for a client.
    static constexpr std::size_t max_backlog = std::size_t{1} << 20;
    static constexpr std::size_t max_lossless = std::size_t{64} << 20;
    /// Requests of a client that are not finished yet; no more are read from it until some are.
    static constexpr std::size_t max_requests = 64;
    /// One more, and the oldest that has not sent a request yet goes.
    static constexpr std::size_t max_clients = 32;

    /// Starts the thread that waits for the sockets, if it can: see `ready`.
    Transport();
    /// Says `bye` to all clients, and gives them a moment to take it.
    ~Transport();
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;

    /// Why nobody can be a client: the process has no descriptor left. Then nothing else may be called but `file` and
    /// what does nothing for want of clients.
    Expected<void> ready() const;

    /// Takes clients from `listener` that belong to `user`. Once.
    void listen(Listener listener, uid_t user);
    /// Takes a client that is connected already.
    ClientId add(Descriptor socket, Flow flow);

    /// Readable while something waits for `take`.
    int file() const { return news_.get(); }
    /// What has come since the last call; never waits.
    std::vector<Incoming> take();
    /// A request has been dealt with: its client may send another.
    void finish_request(ClientId client);
    /// Whether nothing of what is sent now is left out, with a good reserve. When it says no, `file` becomes readable
    /// as soon as it would say yes. Yes for one that is gone.
    bool takes_more(ClientId client);
    /// A lossless client takes less than is sent: a run that follows no clock should wait.
    bool is_behind();
    /// Waits for nothing. Events to clients that are gone are dropped.
    void send(ClientId client, Event event);

private:
    struct Client {
        Descriptor socket;
        Flow flow = Flow::lossy;
        std::deque<Event> events;  // that wait
        std::size_t backlog = 0;   // [bytes] of them, about
        std::size_t lost = 0;
        bool awaited = false;      // somebody wants to know when it takes more
        bool has_spoken = false;   // it has sent a request, or was added from within
        std::size_t requests = 0;  // not finished
        // Of the thread alone:
        LineReader reader{};
        std::string writing{};    // lines that the socket has not taken whole
        std::size_t written = 0;  // of them
        bool finished = false;    // it sends nothing any more
        bool gone = false;
    };

    ClientId add(Descriptor socket, Flow flow, bool has_spoken);
    void work();
    bool accept_all(int listener);
    bool make_room();
    void serve(ClientId id, Client& client, short found);
    void read_from(ClientId id, Client& client);
    void write_to(Client& client);
    void put(Client& client, Event event);
    void remove(ClientId id);

    Descriptor news_;  // eventfd: something for `take`
    Descriptor wake_;  // eventfd: something for the thread
    int problem_ = 0;  // an errno: there is no thread

    Mutex mutex_;  // of all below, and of the first part of each client
    std::optional<Listener> listener_;
    uid_t user_ = geteuid();
    std::map<ClientId, std::unique_ptr<Client>> clients_;  // removed by the thread alone
    std::vector<Incoming> incoming_;
    bool drained_news_ = false;  // news_ is for who waits for `takes_more`
    ClientId last_id_ = 0;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi
