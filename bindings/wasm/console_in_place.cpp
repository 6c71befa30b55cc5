// Consoles without sockets: the lines of both directions wait in memory.
#include <sys/socket.h>

#include <map>
#include <string>
#include <utility>

#include "bindings/console/transport.hpp"
#include "bindings/web/console_socket.hpp"

namespace nezumi {
namespace {

struct Lines {
    std::string requests;
    std::string events;
};

// The connections by their numbers. A number means both ends of a connection, and is not a file descriptor.
std::map<int, Lines>& connections() {
    static std::map<int, Lines> the;
    return the;
}

// Takes all lines, each with its end of line.
std::string take_lines(std::string& from) { return std::exchange(from, {}); }

}  // namespace

Transport::Transport() = default;
Transport::~Transport() = default;
Expected<void> Transport::ready() const { return {}; }
void Transport::listen(Listener /*listener*/, uid_t /*user*/) {}

ClientId Transport::add(Descriptor socket, Flow flow) {
    auto client = std::make_unique<Client>();
    client->socket = std::move(socket);
    client->flow = flow;
    const ClientId id = ++last_id_;
    clients_.emplace(id, std::move(client));
    incoming_.push_back({.client = id, .what = Incoming::What::opened, .request = {}});
    return id;
}

std::vector<Transport::Incoming> Transport::take() {
    for (auto& [id, client] : clients_) {
        client->reader.feed(take_lines(connections()[client->socket.get()].requests));
        while (auto line = client->reader.next()) {
            auto request = line->has_value() ? read_request(**line) : Unexpected(line->error());
            if (request) {
                incoming_.push_back({.client = id, .what = Incoming::What::request, .request = std::move(*request)});
            } else {
                send(id, {.kind = Event::Kind::error, .text = "not understood: " + request.error().message});
            }
        }
    }
    return std::exchange(incoming_, {});
}

void Transport::finish_request(ClientId /*client*/) {}
bool Transport::takes_more(ClientId /*client*/) { return true; }
bool Transport::is_behind() { return false; }

void Transport::send(ClientId id, Event event) {
    const auto client = clients_.find(id);
    if (client != clients_.end()) connections()[client->second->socket.get()].events += to_line(event);
}

std::filesystem::path console_folder() { return "/tmp"; }
Expected<Listener> Listener::open(std::string_view /*name*/, const std::filesystem::path& /*folder*/) {
    return failure("a console can't attach to a system that runs in a web page");
}
Listener::~Listener() = default;

}  // namespace nezumi

namespace nezumi::web {

Expected<bool> send_line(const Descriptor& socket, const std::string& line) {
    connections()[socket.get()].requests += line;
    return true;
}

std::string take_some(const Descriptor& socket) { return take_lines(connections()[socket.get()].events); }

}  // namespace nezumi::web

// Both ends get the same number. It is not an open file, so `close` fails for it, and closing both ends does no harm.
extern "C" int socketpair(int /*domain*/, int /*type*/, int /*protocol*/, int ends[2]) {
    static int last = 1 << 20;
    ends[0] = ends[1] = ++last;
    return 0;
}
