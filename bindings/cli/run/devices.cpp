// The times of a device log are counted from the first tick.
#include "bindings/cli/run/devices.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/base/file_writer.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t largest_log = std::size_t{1} << 30;  // bytes

}  // namespace

Expected<RunDevices> RunDevices::open(const Hardware& hardware) {
    RunDevices devices;
    devices.roots_ = {.dev = hardware.dev_root, .sys = hardware.sys_root};
    if (!hardware.device_log.empty()) {
        devices.file_ = hardware.device_log;
        auto logged = hw::LoggedFiles::create(devices.file_, devices.roots_);
        if (!logged) return Unexpected(logged.error());
        devices.logged_ = std::move(*logged);
        devices.roots_.files = devices.logged_;
    } else if (!hardware.played_log.empty()) {
        devices.file_ = hardware.played_log;
        const auto text = read_whole(devices.file_, devices.file_, largest_log);
        if (!text) return Unexpected(text.error());
        auto log = hw::read_device_log(*text, devices.file_);
        if (!log) return Unexpected(log.error());
        devices.played_ = std::make_shared<hw::PlayedFiles>(std::move(*log), devices.file_);
        devices.roots_.files = devices.played_;
    }
    return devices;
}

void RunDevices::close(const Say& say) {
    if (!logged_) return;
    logged_->close();
    if (say) tell_problem(say);
}

void RunDevices::give_up() {
    if (logged_) logged_->give_up();
}

void RunDevices::follow(RunLoop& loop, Say say) {
    if (!logged_ && !played_) return;
    loop_ = &loop;
    say_ = std::move(say);
    loop.after_tick([this] { after_tick(); });
    if (logged_) logged_->start();
    if (played_) played_->start();
}

void RunDevices::after_tick() {
    if (logged_) tell_problem(say_);
    if (!played_) return;
    for (const std::string& line : played_->take_differences()) say_(line);
    if (played_->is_over()) loop_->quit();
}

void RunDevices::tell_problem(const Say& say) {
    const int problem = logged_->problem();
    if (problem == 0 || std::exchange(has_told_problem_, true)) return;
    say(fmt::format("{}: the device log can't be written: {}: the run continues without it{}", file_,
                    why_not_written(problem), logged_->file().told_of_older()));
}

void RunDevices::end() {
    if (logged_) logged_->end();
    if (!played_) return;
    for (const std::string& line : played_->finish()) say_(line);
}

bool RunDevices::finish() {
    if (logged_) tell_problem(say_);
    if (!played_) return true;
    const hw::WriteComparison& comparison = played_->comparison();
    const int differences = comparison.differences();
    say_(differences == 0
             ? fmt::format("{}: replayed, {} writes were equal", file_, comparison.compared())
             : fmt::format("{}: replayed, {} difference{}", file_, differences, differences == 1 ? "" : "s"));
    return differences == 0;
}

}  // namespace nezumi::cli
