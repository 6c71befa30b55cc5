// What every sub-command takes from around it: the installed files, the simulator, the way to speak.
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

/// The folder of the installed files, which has `behaviors/` and `engine/robots/`; none where they are not installed.
std::vector<std::filesystem::path> installed_folders();

/// What decides all that is drawn at random where nobody says another seed.
inline constexpr std::uint64_t usual_seed = 124;

/// The words of system files for other hosts, ROS 2 and OpenRTM.
const PeerWords& peer_words();

/// How systems are made here: simulated, from the project's files and the installed ones.
LiveOptions simulated_systems();

/// What a program that is built without simulation, vision and pictures (NEZUMI_SIMULATION=OFF) says where one of these
/// is wanted.
inline constexpr std::string_view no_simulation =
    "this nezumi is built for real robots alone, without simulation, vision and pictures: do it on another computer; "
    "here is `nezumi run FILE --hw`";

/// That error in such a program, with the name of the first use that is wanted and needs one of these.
Expected<void> need_simulation(std::initializer_list<std::pair<std::string_view, bool>> uses);

/// Says on standard error why something can't be done: one plain line. Returns `exit_could_not_run`.
int refuse(std::string_view why);
int refuse(const Error& error);
/// That line.
std::string refusal(const Error& error);

}  // namespace nezumi::cli
