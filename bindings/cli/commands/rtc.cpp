// `nezumi rtc`: the profile of a behaviour for RTCBuilder.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/new/profile_behavior.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

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
    ScriptContext context{.component = "component"};
    context.find_module = modules_of(Project::of(source->path, installed_folders()));
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

}  // namespace

SubCommand rtc_command() {
    auto file = std::make_shared<std::string>();
    return {.name = "rtc",
            .help = "Write the profile of a behaviour for RTCBuilder (RTC.xml)",
            .options = {{"FILE", file.get(), "the behaviour, by path or name"}},
            .run = [file] { return write_profile(*file); },
            .footer =
                "The profile goes to standard output: nezumi rtc line_follower > RTC.xml. `nezumi new behavior "
                "--rtc RTC.xml` makes a\nbehaviour from a profile. Anything that a profile can't contain is reported."};
}

}  // namespace nezumi::cli
