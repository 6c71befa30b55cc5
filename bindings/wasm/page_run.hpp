// A run in a web page: the engine and the server of the page. Messages go through a function instead of a socket.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/server.hpp"
#include "bindings/journal/replay.hpp"
#include "bindings/web/web_server.hpp"
#include "engine/base/error.hpp"
#include "engine/live/problems.hpp"
#include "engine/live/run_loop.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::web {

/// The seed for a system file without a seed, the same as in `nezumi run`.
inline constexpr std::uint64_t usual_seed = 124;

class PageRun {
public:
    using Clock = Pacer::Clock;
    /// Takes a message for the page.
    using Send = std::function<void(const Outgoing& message)>;

    /// Loads the system file, activates the system, and greets the page. `installed` are as in `simulated_systems`.
    static Expected<std::unique_ptr<PageRun>> open(const std::filesystem::path& file,
                                                   std::vector<std::filesystem::path> installed, Send send);
    /// Repeats the run of a journal, as fast as possible, and pauses at its end.
    static Expected<std::unique_ptr<PageRun>> open_run(const std::filesystem::path& journal,
                                                       std::vector<std::filesystem::path> installed, Send send);
    ~PageRun();
    PageRun(const PageRun&) = delete;
    PageRun& operator=(const PageRun&) = delete;

    /// Handles a message of the page.
    void receive(std::string_view text);
    /// Runs the ticks that are due, for about this time [s], and sends changes. Returns the time until the next tick is
    /// due [s]; 0: now; negative: the run has ended.
    double go_on(double seconds);

private:
    class Served;

    explicit PageRun(Send send);
    LiveOptions options(std::vector<std::filesystem::path> installed);
    Expected<void> serve();
    void send_all();

    Send send_;
    Problems problems_;
    std::unique_ptr<Replay> replay_;  // provides the files that the system reads
    std::unique_ptr<RunningSystem> live_;
    std::unique_ptr<RunLoop> loop_;
    std::unique_ptr<ConsoleServer> consoles_;
    std::unique_ptr<WebServer> server_;
    std::unique_ptr<Served> served_;
};

}  // namespace nezumi::web
