// The environment of every sub-command: installed files, simulator, error output.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::cli {

/// The folders of the installed files, each with `behaviors/` and `engine/robots/`; empty if nothing is installed.
std::vector<std::filesystem::path> installed_folders();

/// The default seed of all random numbers.
inline constexpr std::uint64_t usual_seed = 124;

/// The functions of system files that describe peers: `network`, `ros` and `rtm`.
const PeerWords& peer_words();

/// Options for simulated systems: they find the installed files, and their networks send nothing.
LiveOptions simulated_systems();

/// The error of a program without simulation, vision and pictures (NEZUMI_SIMULATION=OFF) when one of these is needed.
inline constexpr std::string_view no_simulation =
    "this build of nezumi is for real robots only, without simulation, vision and pictures: use another computer; here "
    "you can use `nezumi run FILE --hw`";

/// Fails with `no_simulation` if this program has no simulation and a use is wanted (`true`). The error names the first
/// wanted use.
Expected<void> need_simulation(std::initializer_list<std::pair<std::string_view, bool>> uses);

/// Prints an error as one line on standard error. Returns `exit_could_not_run`.
int refuse(std::string_view why);
int refuse(const Error& error);
/// The line that `refuse` prints.
std::string refusal(const Error& error);

}  // namespace nezumi::cli
