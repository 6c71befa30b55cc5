// `nezumi calc`: finds the system, and starts the Python program that links its console with LibreOffice Calc.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/python_program.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/socket_directory.hpp"

namespace nezumi::cli {
namespace {

struct CalcOptions {
    std::string file;
    std::string system;
    std::vector<std::string> ports;
    double rate = 10;
    std::string profile;
    bool headless = false;
};

int link(const CalcOptions& options) {
    std::error_code wrong;
    std::string file;
    if (!options.file.empty()) {
        if (!std::filesystem::is_regular_file(options.file, wrong))
            return refuse("calc: there is no file " + options.file + ": leave it out to make a new sheet");
        file = std::filesystem::absolute(options.file).string();
    }
    const auto program = python_file("bindings/calc/link.py");
    if (!program) return refuse("calc: " + program.error().message);
    auto reached = connect_to_system(options.system);
    if (!reached) return refuse(reached.error());

    const int socket = reached->socket.get();
    fcntl(socket, F_SETFD, 0);  // keeps the socket open in the Python program
    std::vector<std::string> words{"--socket",
                                   std::to_string(socket),
                                   "--system=" + reached->system.name,
                                   "--file=" + file,
                                   "--profile=" + options.profile,
                                   "--rate",
                                   fmt::format("{}", options.rate)};
    for (const std::string& port : options.ports) words.push_back("--port=" + port);
    if (options.headless) words.emplace_back("--headless");
    become_python(*program, words);
    return refuse(
        fmt::format("the spreadsheet link needs LibreOffice Calc: sudo apt install --no-install-recommends "
                    "libreoffice-calc python3-uno ({})",
                    std::strerror(errno)));
}

}  // namespace

SubCommand calc_command() {
    auto options = std::make_shared<CalcOptions>();
    return {
        .name = "calc",
        .help = "Link a running system with LibreOffice Calc: ports in cells, both ways, live",
        .options = {{"[FILE]", &options->file, "the spreadsheet; without one, a new sheet that shows the system"},
                    {"--system", &options->system,
                     "the name of its system file, or its process number; may be omitted if only one system runs",
                     "SYSTEM"},
                    {"--port", &options->ports,
                     "in a new sheet: show only this port, or the ports of this component; may be repeated", "NAME"},
                    {"--rate", &options->rate, "refreshes per second", "HZ", number_from(4, 25)},
                    {"--profile", &options->profile, "a folder for a separate LibreOffice with its own settings",
                     "DIR"},
                    {"--headless", &options->headless, "open no window, for computers without a screen"}},
        .run = [options] { return link(*options); },
        .footer =
            "A table begins with the cells `Port` and `State` side by side; below them stand ports, right of "
            "them their values: docs/spreadsheet.md. Needs Debian's libreoffice-calc and python3-uno. Exit status: 0 "
            "the link ended normally, 2 it could not start."};
}

}  // namespace nezumi::cli
