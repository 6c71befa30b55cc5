// Finds the installed files, and gives the engine its simulator, peers and drivers.
#include "bindings/cli/base/environment.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "bindings/cli/base/status.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/dds/network_word.hpp"
#include "bindings/dds/ros/ros_word.hpp"
#include "bindings/embed/simulation.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "engine/base/module.hpp"
#include "engine/base/visible.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {

std::vector<std::filesystem::path> installed_folders() {
    // The folders bin and share are next to each other. In a build folder, share/nezumi is a link to the sources: the
    // link is resolved, so that messages show the path of the sources.
    std::error_code none;
    std::filesystem::path folder =
        std::filesystem::canonical(own_program().parent_path().parent_path() / "share/nezumi", none);
    if (!std::filesystem::is_directory(folder / "engine/robots", none)) return {};
    return {std::move(folder)};
}

const PeerWords& peer_words() {
    static const PeerWords words{&dds::network_word(), &dds::ros_word(), &openrtm::rtm_word()};
    return words;
}

LiveOptions simulated_systems() {
    LiveOptions live = nezumi::simulated_systems(installed_folders());
    live.peer_words = peer_words();
    live.network = dds::make_silent_networks();
    live.network_of_past = live.network;
    for (const auto& [name, maker] : hw::drivers({})) live.drivers.push_back(name);
    return live;
}

Expected<void> need_simulation(std::initializer_list<std::pair<std::string_view, bool>> uses) {
    if (nezumi::simulated_systems({}).world) return {};
    for (const auto& [use, is_wanted] : uses) {
        if (is_wanted) return failure(fmt::format("{}: {}", use, no_simulation));
    }
    return {};
}

std::string refusal(const Error& error) {
    // The location comes first in the line, so that editors can jump to it.
    if (error.place.file.empty()) return visible("nezumi: " + error.message) + "\n";
    return visible(describe(error)) + "\n";
}

int refuse(std::string_view why) { return refuse(Error{std::string(why), {}}); }

int refuse(const Error& error) {
    put_text(stderr, refusal(error));
    return exit_could_not_run;
}

}  // namespace nezumi::cli
