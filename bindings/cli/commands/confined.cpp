// `nezumi confined`: runs nezumi with access to one folder, for `nezumi class`.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/web/classroom/confinement.hpp"
#include "engine/base/list.hpp"
#include "engine/base/module.hpp"

namespace nezumi::cli {
namespace {

struct ConfinedOptions {
    std::string folder;
    std::vector<std::string> words;
    bool bounds_only = false;
    std::vector<std::string> devices;
};

int run_confined(const ConfinedOptions& options) {
    for (const std::string& word : options.words) {
        if (options.devices.empty() && (word == "--hw" || word.starts_with("--hw=")))
            return refuse("confined: real robots and devices can't be reached from here: leave out --hw");
    }
    const std::string program = own_program();
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::canonical(options.folder, none);
    if (none || !std::filesystem::is_directory(folder, none))
        return refuse(fmt::format("confined: there is no folder {}", shown(options.folder)));
    // In a class, names of files are relative to the pupil's project, also in messages.
    if (contains(options.words, "--page-on-input")) std::filesystem::current_path(folder, none);
    // Other files that programs write go into the folder, too.
    for (const char* name : {"HOME", "TMPDIR", "XDG_RUNTIME_DIR", "XDG_STATE_HOME"})
        setenv(name, (folder / ".nezumi").c_str(), 1);
    if (auto ok = web::confine({.work = folder,
                                .readable = web::readable_parts(program, installed_folders()),
                                .devices = {options.devices.begin(), options.devices.end()},
                                .by_kernel = !options.bounds_only});
        !ok)
        return refuse("confined: " + ok.error().message);
    std::vector<std::string> words{program};
    words.insert(words.end(), options.words.begin(), options.words.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(program.c_str(), pointers.data());
    return refuse(fmt::format("confined: {}", std::strerror(errno)));
}

}  // namespace

SubCommand confined_command() {
    auto options = std::make_shared<ConfinedOptions>();
    return {
        .name = "confined",
        .help = "Run a command of nezumi that can reach only one folder and the installed files",
        .options = {{"--bounds-only", &options->bounds_only,
                     "limit only memory, files and priority: for kernels without Landlock"},
                    {"--devices", &options->devices, "devices in this folder may be used as well; may be repeated",
                     "DIR"},
                    {"FOLDER", &options->folder, "the folder that it may read and write"},
                    {"WORDS", &options->words, "the command and its arguments, after --"}},
        .run = [options] { return run_confined(*options); },
        .footer =
            "The kernel denies this command, and all programs that it starts, access to other files, to devices and to "
            "the network,\nand limits their memory to 512 MB. `nezumi class` runs the work of pupils in this way."};
}

}  // namespace nezumi::cli
