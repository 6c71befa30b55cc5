// Non-blocking sockets: a console that accepts no more data is overloaded.
#include "bindings/web/console_relay.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

namespace nezumi::web {

Expected<void> ConsoleRelay::send(ClientId client, const std::string& line, const Actor& who) {
    auto found = consoles_of_.find(client);
    if (found == consoles_of_.end()) {
        auto socket = consoles_.connect(ConsoleServer::Use::prompt, who);
        if (!socket) return Unexpected(socket.error());
        found = consoles_of_.emplace(client, Console{.socket = std::move(*socket)}).first;
    }
    // A partly sent line would corrupt the next one, so the console is closed.
    const ssize_t sent = ::send(found->second.socket.get(), line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(line.size())) return {};
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) return failure("the console is overloaded: try again");
    consoles_of_.erase(found);
    return failure("console buffer full; session restarted");
}

void ConsoleRelay::serve() {
    std::array<char, 65536> piece{};
    for (auto& [client, console] : consoles_of_) {
        const ssize_t got = recv(console.socket.get(), piece.data(), piece.size(), MSG_DONTWAIT);
        if (got <= 0) continue;
        console.reader.feed({piece.data(), static_cast<std::size_t>(got)});
        while (auto line = console.reader.next()) {
            if (*line) tell_(client, **line);
        }
    }
}

void ConsoleRelay::add_files(std::vector<int>& files) const {
    for (const auto& [client, console] : consoles_of_) files.push_back(console.socket.get());
}

}  // namespace nezumi::web
