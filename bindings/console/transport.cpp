// One thread waits for all sockets with poll. It holds the lock only to move data in and out of queues.
#include "bindings/console/transport.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "engine/base/descriptor.hpp"

namespace nezumi {
namespace {

using Clock = std::chrono::steady_clock;

// At the end of the run, clients have this time to receive the remaining events.
constexpr std::chrono::milliseconds transport_farewell{300};
// The pause after an accept failed because the process had no free descriptor.
constexpr int no_descriptor_pause = 200;  // ms
// If more bytes than this wait for a client, `takes_more` is false, so senders that can wait do so.
constexpr std::size_t high_water = Transport::max_backlog / 2;
// Lines are written in pieces of about this size.
constexpr std::size_t portion = std::size_t{1} << 16;

void signal(const Descriptor& event) {
    const std::uint64_t one = 1;
    // EAGAIN: the counter is full, so the file is readable anyway. After other errors tries only 3 times, because the
    // caller must not wait.
    for (int tries = 0; tries < 3 && ::write(event.get(), &one, sizeof one) < 0 && errno != EAGAIN; ++tries) {
    }
}

void clear(const Descriptor& event) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(event.get(), &count, sizeof count);
}

std::size_t size_of(const Event& event) {
    std::size_t size = 64 + event.text.size();
    for (const std::string& item : event.items) size += item.size() + 4;
    return size;
}

bool only_shows(const Event& event) {
    switch (event.kind) {
        case Event::Kind::output:
        case Event::Kind::error:
        case Event::Kind::log:
        case Event::Kind::status: return true;
        case Event::Kind::answer:
        case Event::Kind::completions:
        case Event::Kind::keys:
        case Event::Kind::lost:
        case Event::Kind::bye: return false;
    }
    return false;
}

}  // namespace

Transport::Transport() : news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (news_ && wake_) {
        thread_ = std::thread([this] { work(); });
    } else {
        problem_ = errno;
    }
}

Expected<void> Transport::ready() const {
    if (problem_ == 0) return {};
    return failure(std::string("can't open a console: ") + std::strerror(problem_));
}

Transport::~Transport() {
    if (problem_ != 0) return;
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        for (auto& [id, client] : clients_) put(*client, {.kind = Event::Kind::bye, .text = "the system has ended"});
    }
    signal(wake_);
    thread_.join();
}

void Transport::listen(Listener listener, uid_t user) {
    {
        const std::lock_guard lock(mutex_);
        listener_.emplace(std::move(listener));
        user_ = user;
    }
    signal(wake_);
}

ClientId Transport::add(Descriptor socket, Flow flow) { return add(std::move(socket), flow, true); }

ClientId Transport::add(Descriptor socket, Flow flow, bool has_spoken) {
    fcntl(socket.get(), F_SETFL, fcntl(socket.get(), F_GETFL) | O_NONBLOCK);
    auto client = std::make_unique<Client>();
    client->socket = std::move(socket);
    client->flow = flow;
    client->has_spoken = has_spoken;
    ClientId id = 0;
    {
        const std::lock_guard lock(mutex_);
        id = ++last_id_;
        clients_.emplace(id, std::move(client));
        incoming_.push_back({.client = id, .what = Incoming::What::opened, .request = {}});
    }
    signal(news_);
    signal(wake_);
    return id;
}

std::vector<Transport::Incoming> Transport::take() {
    const std::lock_guard lock(mutex_);
    if (incoming_.empty() && !std::exchange(drained_news_, false)) return {};
    clear(news_);
    return std::exchange(incoming_, {});
}

void Transport::finish_request(ClientId id) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end() || found->second->requests == 0) return;
    --found->second->requests;
    signal(wake_);
}

bool Transport::takes_more(ClientId id) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end()) return true;
    found->second->awaited = found->second->backlog > high_water;
    return !found->second->awaited;
}

bool Transport::is_behind() {
    const std::lock_guard lock(mutex_);
    return std::any_of(clients_.begin(), clients_.end(), [](const auto& each) {
        return each.second->flow == Flow::lossless && each.second->backlog > high_water;
    });
}

void Transport::send(ClientId id, Event event) {
    const std::lock_guard lock(mutex_);
    const auto found = clients_.find(id);
    if (found == clients_.end()) return;
    put(*found->second, std::move(event));
    signal(wake_);
}

// Call this with the lock held.
void Transport::put(Client& client, Event event) {
    const std::size_t most = client.flow == Flow::lossless ? max_lossless : max_backlog;
    const bool full = client.backlog > (client.lost > 0 ? high_water : most);
    if (full && only_shows(event)) {
        ++client.lost;
        return;
    }
    // Before an answer, lost events are always reported, because a client may leave after the answer.
    if (client.lost > 0 && (!full || event.kind == Event::Kind::answer))
        client.events.push_back({.kind = Event::Kind::lost, .text = {}, .count = std::exchange(client.lost, 0)});
    client.backlog += size_of(event);
    client.events.push_back(std::move(event));
}

void Transport::work() {
    std::vector<pollfd> polled;
    std::vector<std::pair<ClientId, Client*>> present;
    std::optional<Clock::time_point> end;
    bool let_in = true;
    for (;;) {
        polled.assign(1, {.fd = wake_.get(), .events = POLLIN, .revents = 0});
        present.clear();
        int listener = -1;
        bool all_written = true;
        {
            const std::lock_guard lock(mutex_);
            if (listener_ && !ends_) listener = listener_->file();
            if (ends_ && !end) end = Clock::now() + transport_farewell;
            for (auto& [id, client] : clients_) {
                present.emplace_back(id, client.get());
                const bool writes = client->written < client->writing.size() || !client->events.empty();
                const bool reads = !client->finished && client->requests < max_requests && !ends_;
                all_written = all_written && !writes;
                const int wanted = (writes ? POLLOUT : 0) | (reads ? POLLIN : 0);
                polled.push_back({.fd = client->socket.get(), .events = static_cast<short>(wanted), .revents = 0});
            }
        }
        if (end && (all_written || Clock::now() >= *end)) break;
        polled.push_back({.fd = let_in ? listener : -1, .events = POLLIN, .revents = 0});
        int timeout = let_in ? -1 : no_descriptor_pause;
        if (end) timeout = 20;
        poll(polled.data(), polled.size(), timeout);

        if (polled.front().revents != 0) clear(wake_);
        for (std::size_t at = 0; at < present.size(); ++at)
            serve(present[at].first, *present[at].second, polled[at + 1].revents);
        let_in = true;
        if ((polled.back().revents & POLLIN) != 0) let_in = accept_all(listener);
    }
    const std::lock_guard lock(mutex_);
    clients_.clear();
}

// Returns false if there is no descriptor for another client.
bool Transport::accept_all(int listener) {
    for (;;) {
        Descriptor socket(accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!socket) return errno != EMFILE && errno != ENFILE && errno != ENOBUFS && errno != ENOMEM;
        const bool ours = is_peer(socket.get(), user_);
        if (ours && leaves_free(socket.get(), for_files) && make_room()) {
            add(std::move(socket), Flow::lossy, false);
            continue;
        }
        const std::string line =
            to_line({.kind = Event::Kind::bye,
                     .text = ours ? "too many consoles are attached" : "the system belongs to another user"});
        ::send(socket.get(), line.data(), line.size(), MSG_NOSIGNAL);
    }
}

// Makes room for a new client: if there are too many, disconnects the oldest that has sent no request. Returns false if
// all have sent one.
bool Transport::make_room() {
    ClientId silent = 0;
    {
        const std::lock_guard lock(mutex_);
        if (clients_.size() < max_clients) return true;
        const auto oldest =
            std::find_if(clients_.begin(), clients_.end(), [](const auto& each) { return !each.second->has_spoken; });
        if (oldest == clients_.end()) return false;
        silent = oldest->first;
    }
    remove(silent);
    return true;
}

void Transport::serve(ClientId id, Client& client, short found) {
    if ((found & POLLIN) != 0) read_from(id, client);
    if ((found & POLLOUT) != 0) write_to(client);
    // The client has closed both directions.
    if ((found & (POLLHUP | POLLERR | POLLNVAL)) != 0) client.gone = true;
    bool idle = false;
    {
        const std::lock_guard lock(mutex_);
        idle = client.requests == 0 && client.events.empty() && client.written == client.writing.size();
    }
    if (client.gone || (client.finished && idle)) remove(id);
}

void Transport::read_from(ClientId id, Client& client) {
    std::array<char, portion> piece{};
    const ssize_t got = recv(client.socket.get(), piece.data(), piece.size(), 0);
    if (got < 0) {
        client.gone = client.gone || (errno != EAGAIN && errno != EINTR);
        return;
    }
    if (got == 0) client.finished = true;
    client.reader.feed({piece.data(), static_cast<std::size_t>(got)});
    while (auto line = client.reader.next()) {
        auto request = line->has_value() ? read_request(**line) : Unexpected(line->error());
        const std::lock_guard lock(mutex_);
        if (!request) {
            put(client, {.kind = Event::Kind::error, .text = "not understood: " + request.error().message});
            continue;
        }
        ++client.requests;
        client.has_spoken = true;
        incoming_.push_back({.client = id, .what = Incoming::What::request, .request = std::move(*request)});
        signal(news_);
    }
}

void Transport::write_to(Client& client) {
    if (client.written == client.writing.size()) {
        std::vector<Event> events;
        {
            const std::lock_guard lock(mutex_);
            for (std::size_t size = 0; size < portion && !client.events.empty(); client.events.pop_front()) {
                size += size_of(client.events.front());
                events.push_back(std::move(client.events.front()));
            }
            for (const Event& event : events) client.backlog -= std::min(client.backlog, size_of(event));
            if (client.awaited && client.backlog <= high_water) {
                client.awaited = false;
                drained_news_ = true;
                signal(news_);
            }
        }
        client.writing.clear();
        client.written = 0;
        for (const Event& event : events) client.writing += to_line(event);
    }
    const ssize_t sent = ::send(client.socket.get(), client.writing.data() + client.written,
                                client.writing.size() - client.written, MSG_NOSIGNAL);
    if (sent >= 0) {
        client.written += static_cast<std::size_t>(sent);
    } else {
        client.gone = client.gone || (errno != EAGAIN && errno != EINTR);
    }
}

void Transport::remove(ClientId id) {
    const std::lock_guard lock(mutex_);
    clients_.erase(id);
    incoming_.push_back({.client = id, .what = Incoming::What::closed, .request = {}});
    signal(news_);
}

}  // namespace nezumi
