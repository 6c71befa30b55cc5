// `nezumi manual`: the manual page.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/shell/manual.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

int write_manual(const SubCommand& program, const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) return refuse({"can't be made: " + problem.message(), {folder}});
    for (const ManualPage& page : manual_pages(program)) {
        const std::string file = (std::filesystem::path(folder) / page.name).string();
        if (auto written = write_whole(file, page.text); !written) return refuse(written.error());
        fmt::print("wrote {}\n", file);
    }
    return exit_done;
}

}  // namespace

SubCommand manual_command(SubCommand (*program)()) {
    auto folder = std::make_shared<std::string>();
    return {
        .name = "manual",
        .help = "Write the manual pages, nezumi.1 and one for each command",
        .options = {{"DIR", folder.get(), "the folder to write them into; older ones are replaced"}},
        .run = [folder, program] { return write_manual(program(), *folder); },
        .footer =
            "They have the same text as --help. `man -l DIR/nezumi-run.1` shows one; Debian's package brings them."};
}

}  // namespace nezumi::cli
