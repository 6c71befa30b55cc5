// Consoles of browsers: each has a connection to the console's server, and lines go to and fro as they are.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/protocol.hpp"
#include "bindings/console/server.hpp"
#include "bindings/web/site.hpp"
#include "engine/base/descriptor.hpp"

namespace nezumi::web {

/// All of it is to be called from the thread that ticks; none of it waits.
class ConsoleRelay {
public:
    /// Takes an event's line, without its end.
    using Tell = std::function<void(ClientId, std::string_view line)>;

    ConsoleRelay(ConsoleServer& consoles, Tell tell) : consoles_(consoles), tell_(std::move(tell)) {}

    /// Sends a request's line; the first opens the console. An error when that can't be, or when it takes no more.
    Expected<void> send(ClientId client, const std::string& line, const Actor& who);
    /// Passes on what consoles have said, a portion of each.
    void serve();
    void close(ClientId client) { consoles_of_.erase(client); }
    void add_files(std::vector<int>& files) const;

private:
    struct Console {
        Descriptor socket;
        LineReader reader{std::size_t{1} << 24};
    };

    ConsoleServer& consoles_;
    Tell tell_;
    std::map<ClientId, Console> consoles_of_;
};

}  // namespace nezumi::web
