// `nezumi run`: a system file, simulated.
#include <CLI/CLI.hpp>

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <string>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"

namespace nezumi::cli {
namespace {

struct RunOptions {
    std::string file;
    double duration = 10;
};

int run(const RunOptions& options) {
    LiveOptions live_options = simulated_systems();
    live_options.build.log = [](const LogLine& line) {
        fmt::print(stderr, "[{:8.3f}] {} {}: {}\n", line.seconds, to_text(line.level), line.component, line.text);
    };
    auto live = LiveSystem::load(options.file, std::move(live_options));
    if (!live) return refuse(live.error());
    (*live)->activate();
    const auto ticks = std::llround(options.duration * (*live)->system().settings().rate);
    for (long long tick = 0; tick < ticks; ++tick) (*live)->tick();
    return kDone;
}

}  // namespace

void add_run_command(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("run", "Run a system file");
    auto options = std::make_shared<RunOptions>();
    command->add_option("FILE", options->file, "the system file")->required();
    command->add_option("--duration", options->duration, "end after so many simulated seconds");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace nezumi::cli
