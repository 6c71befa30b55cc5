// Transports requests and events between the sockets of clients and the ticking thread. The ticking thread never waits
// for a client.
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
    /// A message from a client.
    struct Incoming {
        enum class What { opened, request, closed };
        ClientId client = 0;
        What what = What::request;
        Request request;
    };

    /// What happens with the events of a slow client.
    enum class Flow {
        lossy,    ///< events that only show something are dropped and counted beyond `max_backlog`; see `takes_more`
        lossless  ///< as `lossy`, beyond `max_lossless`: none are dropped if the run waits while the client is slow
    };

    /// [bytes] that may wait for a client.
    static constexpr std::size_t max_backlog = std::size_t{1} << 20;
    static constexpr std::size_t max_lossless = std::size_t{64} << 20;
    /// The most unfinished requests of a client. No more are read until some are finished.
    static constexpr std::size_t max_requests = 64;
    /// The most clients. With one more, the oldest client that has sent no request is disconnected.
    static constexpr std::size_t max_clients = 32;

    /// Starts the thread that waits for the sockets; `ready` says whether this succeeded.
    Transport();
    /// Sends `bye` to all clients, and waits a moment until they have taken it.
    ~Transport();
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;

    /// Returns an error if no client can connect because the process has no descriptor left. After an error, call only
    /// `file` and functions that do nothing without clients.
    Expected<void> ready() const;

    /// Accepts clients of `user` from `listener`. Call it once.
    void listen(Listener listener, uid_t user);
    /// Adds a client that is already connected.
    ClientId add(Descriptor socket, Flow flow);

    /// A file descriptor that is readable while something waits for `take`.
    int file() const { return news_.get(); }
    /// The messages since the last call; never waits.
    std::vector<Incoming> take();
    /// A request is finished: its client may send another one.
    void finish_request(ClientId client);
    /// Whether a large output could be sent now without dropping events. If not, `file` becomes readable as soon as
    /// this is possible. True for a client that is gone.
    bool takes_more(ClientId client);
    /// Whether a lossless client is slow: then a run that does not follow real time should wait.
    bool is_behind();
    /// Does not wait. Drops events to clients that are gone.
    void send(ClientId client, Event event);

private:
    struct Client {
        Descriptor socket;
        Flow flow = Flow::lossy;
        std::deque<Event> events;  // waiting events
        std::size_t backlog = 0;   // [bytes] of the waiting events, about
        std::size_t lost = 0;
        bool awaited = false;      // the caller wants to know when it takes more
        bool has_spoken = false;   // the client has sent a request, or was added by this process
        std::size_t requests = 0;  // number of unfinished requests
        // For the thread only:
        LineReader reader{};
        std::string writing{};    // lines that the socket has taken only in part
        std::size_t written = 0;  // bytes of `writing` that were sent
        bool finished = false;    // the client sends nothing more
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

    Descriptor news_;  // eventfd: there is something for `take`
    Descriptor wake_;  // eventfd: there is something for the thread
    int problem_ = 0;  // errno of the failed start; not 0: there is no thread

    Mutex mutex_;  // of all members below, and of the first part of each client
    std::optional<Listener> listener_;
    uid_t user_ = geteuid();
    std::map<ClientId, std::unique_ptr<Client>> clients_;  // removed by the thread only
    std::vector<Incoming> incoming_;
    bool drained_news_ = false;  // news_ also serves a caller that waits for `takes_more`
    ClientId last_id_ = 0;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi
