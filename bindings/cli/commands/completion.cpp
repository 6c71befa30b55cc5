// `nezumi completion`: completions of the command line for a shell.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/shell/completion.hpp"
#include "engine/base/list.hpp"

namespace nezumi::cli {
namespace {

int write_completion(const SubCommand& program, const std::string& shell) {
    const auto& known = completed_shells();
    if (!contains(known, shell)) {
        return refuse(fmt::format("completion: there is no completion for the shell '{}'{}; known are {}", shown(shell),
                                  did_you_mean(shell, known), fmt::join(known, ", ")));
    }
    fmt::print("{}", completion_script(program, shell));
    return exit_done;
}

}  // namespace

SubCommand completion_command(SubCommand (*program)()) {
    auto shell = std::make_shared<std::string>();
    return {.name = "completion",
            .help = "Write a script that lets a shell complete nezumi's command line",
            .options = {{"SHELL", shell.get(), "the shell", "bash|zsh|fish"}},
            .run = [shell, program] { return write_completion(program(), *shell); },
            .footer =
                "For this shell: `source <(nezumi completion bash)`, `source <(nezumi completion zsh)`, `nezumi "
                "completion fish | source`.\nFor every new shell: the same line in ~/.bashrc, in ~/.zshrc below "
                "compinit, in ~/.config/fish/config.fish.\nDebian's package brings them."};
}

}  // namespace nezumi::cli
