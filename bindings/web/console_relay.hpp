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
    /// Sends the line of an event, without its line end, to a browser.
    using Tell = std::function<void(ClientId, std::string_view line)>;

    ConsoleRelay(ConsoleServer& consoles, Tell tell) : consoles_(consoles), tell_(std::move(tell)) {}

    /// Sends the line of a request; the first request opens the browser's console. Fails if the console can't be opened
    /// or accepts no more data.
    Expected<void> send(ClientId client, const std::string& line, const Actor& who);
    /// Passes the lines of consoles on to their browsers, a limited amount for each console.
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
