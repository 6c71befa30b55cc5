// Consoles of browsers: each has its own connection to the console server, and lines are passed on unchanged.
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

/// Must be called from the ticking thread. Never blocks.
class ConsoleRelay {
public:
    /// Takes the line of an event, without its line end.
    using Tell = std::function<void(ClientId, std::string_view line)>;

    ConsoleRelay(ConsoleServer& consoles, Tell tell) : consoles_(consoles), tell_(std::move(tell)) {}

    /// Sends the line of a request; the first one opens the console. Fails if it can't be opened or accepts no more
    /// data.
    Expected<void> send(ClientId client, const std::string& line, const Actor& who);
    /// Passes on what consoles have sent, a limited amount of each.
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
