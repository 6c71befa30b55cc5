// `nezumi rtc`: writes the profile of a behaviour for RTCBuilder, or restores a system that RTSystemEditor saved.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/new/profile_behavior.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "bindings/openrtm/peer_orb.hpp"
#include "bindings/openrtm/restore_system.hpp"
#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr double longest_restoration = 86400;  // [s]

// When the file was changed, in UTC: "2026-01-31T12:00:00Z".
std::string date_of(const fs::path& file) {
    struct stat status {};
    stat(file.c_str(), &status);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(status.st_mtime));
}

Expected<SourceText> read_behavior(const std::string& given) {
    const auto files = find_lua_files(given);
    if (!files) return Unexpected(files.error());
    for (const fs::path& file : *files) {
        auto source = Project::of(file, installed_folders()).read_source(file.string());
        if (!source || kind_of_file(file, source->text) == LuaKind::behavior) return source;
    }
    return failure("is not a behaviour, and only behaviours have profiles", {given});
}

int write_profile(const std::string& given) {
    const auto source = read_behavior(given);
    if (!source) return refuse(source.error());
    const Project project = Project::of(source->path, installed_folders());
    ScriptContext context{.component = "component"};
    context.find_module = modules_of(project);
    context.find_message = messages_of(project);
    const auto script = Script::load(*source, std::move(context));
    if (!script) return refuse(script.error());
    const auto profile = profile_of(**script);
    const auto text = write_component_profile(profile, date_of(source->path));
    if (!text) return refuse({text.error().message, {source->shown}});
    for (const std::string& remark : profile.remarks)
        fmt::print(stderr, "{}: not in the profile: {}\n", source->shown, remark);
    fmt::print("{}", *text);
    return exit_done;
}

struct RestoreOptions {
    std::string file;     ///< a behaviour, whose profile is written; "": none
    std::string profile;  ///< the profile of a system to restore; "": none
    std::vector<std::string> nameservers;
    double wait = 10;  ///< [s] for components that are not running yet
};

int restore(RestoreOptions given) {
    const auto text = read_whole(given.profile, given.profile);
    if (!text) return refuse(text.error());
    const auto profile = openrtm::read_system_profile(*text, given.profile);
    if (!profile) return refuse(profile.error());
    auto nameservers = given.nameservers.empty() ? openrtm::nameservers_of(*profile)
                                                 : Expected<std::vector<std::string>>(given.nameservers);
    if (!nameservers) return refuse({nameservers.error().message, {given.profile}});
    for (std::string& nameserver : *nameservers) {
        if (const auto problem = openrtm::adopt_nameserver(nameserver); !problem.empty())
            return refuse("rtc: --nameserver " + problem);
    }
    auto peers = openrtm::PeerOrb::open(*nameservers);
    if (!peers) return refuse("rtc: " + peers.error().message);
    const StopSignals signals;
    constexpr std::chrono::milliseconds pause{250};
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(given.wait);
    const bool is_whole = openrtm::restore_system(
        *profile, {.ask = [&](const openrtm::PeerQuestion& question) { return peers->ask(question); },
                   .wait =
                       [&] {
                           std::this_thread::sleep_for(pause);
                           return signals.received() == 0 && std::chrono::steady_clock::now() < end;
                       },
                   .say =
                       [&](bool is_problem, const std::string& line) {
                           fmt::print(is_problem ? stderr : stdout, "{}\n", line);
                           std::fflush(stdout);
                       }});
    for (const std::string& remark : profile->remarks)
        fmt::print(stderr, "{}: left out: {}\n", given.profile, visible(remark));
    return is_whole ? exit_done : exit_failed;
}

int run_rtc(const RestoreOptions& given) {
    if (given.file.empty() == given.profile.empty())
        return refuse("rtc: expected a behaviour or --system PROFILE: see nezumi rtc --help");
    if (given.profile.empty() && !given.nameservers.empty())
        return refuse("rtc: --nameserver works only with --system PROFILE");
    return given.profile.empty() ? write_profile(given.file) : restore(given);
}

}  // namespace

SubCommand rtc_command() {
    auto given = std::make_shared<RestoreOptions>();
    return {.name = "rtc",
            .help = "Write the profile of a behaviour for RTCBuilder (RTC.xml), or restore a system of RTSystemEditor",
            .options = {{"[FILE]", &given->file, "the behaviour, by path or name"},
                        {.name = "--system",
                         .value = &given->profile,
                         .help = "connect, configure and activate the running RTCs of this profile (XML or YAML)",
                         .form = "PROFILE",
                         .check = not_empty},
                        {.name = "--nameserver",
                         .value = &given->nameservers,
                         .help = "a CORBA name service, instead of those of the profile; may be repeated",
                         .form = "HOST:PORT",
                         .check = not_empty},
                        {.name = "--wait",
                         .value = &given->wait,
                         .help = "how long it waits for RTCs that are not running yet (default 10)",
                         .form = "SECONDS",
                         .check = number_from(0, longest_restoration)}},
            .run = [given] { return run_rtc(*given); },
            .footer =
                "The profile goes to standard output: nezumi rtc line_follower > RTC.xml. `nezumi new behavior "
                "--rtc RTC.xml` makes a\nbehaviour from a profile. Anything that a profile can't contain is reported."};
}

}  // namespace nezumi::cli
