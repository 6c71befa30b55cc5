// Where the page's files are, and which port is free.
#include "bindings/cli/run_web.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bindings/cli/environment.hpp"

namespace nezumi::cli {
namespace {

// So many ports are tried, from the one that is wanted on.
constexpr int most_ports = 20;

}  // namespace

RunWeb::RunWeb(RunLoop& loop, RunConsole& console, std::unique_ptr<web::WebServer> server)
    : loop_(loop), console_(console), server_(std::move(server)) {
    console_.show_status_by([this](const std::string& text, bool running) { server_->show_status(text, running); });
}

RunWeb::~RunWeb() { console_.show_status_by({}); }

Expected<std::unique_ptr<RunWeb>> RunWeb::open(RunLoop& loop, RunConsole& console, const Web& web) {
    const auto folders = installed_folders();
    web::WebOptions options{.page = folders.empty() ? std::filesystem::path() : folders.front() / "bindings/web/page",
                            .version = NEZUMI_VERSION};
    options.sockets.first_port = web.port;
    options.sockets.ports = std::min(most_ports, 65536 - web.port);
    auto server = web::WebServer::open(loop.live(), loop, console.server(), options);
    if (!server) return Unexpected(server.error());
    return std::unique_ptr<RunWeb>(new RunWeb(loop, console, std::move(*server)));
}

}  // namespace nezumi::cli
