// If the connection to a console accepts no more data, the request is refused and nothing waits.
#include "bindings/web/console_relay.hpp"

#include <utility>

#include "bindings/web/console_socket.hpp"

namespace nezumi::web {

Expected<void> ConsoleRelay::send(ClientId client, const std::string& line, const Actor& who) {
    auto found = consoles_of_.find(client);
    if (found == consoles_of_.end()) {
        auto socket = consoles_.connect(ConsoleServer::Use::prompt, who);
        if (!socket) return Unexpected(socket.error());
        found = consoles_of_.emplace(client, Console{.socket = std::move(*socket)}).first;
    }
    const auto sent = send_line(found->second.socket, line);
    if (sent && !*sent) return failure("the console is overloaded: try again");
    if (sent) return {};
    // A partly sent line would corrupt the next one, so the console is closed.
    consoles_of_.erase(found);
    return Unexpected(sent.error());
}

void ConsoleRelay::serve() {
    for (auto& [client, console] : consoles_of_) {
        console.reader.feed(take_some(console.socket));
        while (auto line = console.reader.next()) {
            if (*line) tell_(client, **line);
        }
    }
}

void ConsoleRelay::add_files(std::vector<int>& files) const {
    for (const auto& [client, console] : consoles_of_) files.push_back(console.socket.get());
}

}  // namespace nezumi::web
