// `nezumi doctor`: examines this machine as a robot, and says what to do about missing parts.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/base/stop_signals.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/guided/person.hpp"
#include "bindings/cli/guided/setup.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/visible.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/system/script_drivers.hpp"
#include "hw/calibrate/move_check.hpp"
#include "hw/doctor/doctor.hpp"

namespace nezumi::cli {
namespace {

struct DoctorOptions {
    std::string file;
    std::string dev_root, sys_root, proc_root, udev_root;
    bool json = false;
    bool move = false;
    bool is_sure = false;
};

hw::MachineRoots roots(const DoctorOptions& options) {
    hw::MachineRoots roots;
    if (!options.dev_root.empty()) roots.devices.dev = options.dev_root;
    if (!options.sys_root.empty()) roots.devices.sys = options.sys_root;
    if (!options.proc_root.empty()) roots.proc = options.proc_root;
    if (!options.udev_root.empty()) roots.udev = {options.udev_root};
    for (const auto& folder : installed_folders()) roots.rules = (folder / "hw/udev/60-nezumi.rules").string();
    return roots;
}

std::string_view word(hw::Finding::State state) {
    switch (state) {
        case hw::Finding::State::good: return "ok";
        case hw::Finding::State::note: return "note";
        case hw::Finding::State::wrong: return "wrong";
    }
    return "";
}

void print(const hw::Findings& findings) {
    for (const hw::Finding& finding : findings) {
        fmt::print("{:<6} {}: {}\n", word(finding.state), finding.check, visible(finding.found));
        if (!finding.advice.empty()) fmt::print("       do: {}\n", visible(finding.advice));
    }
}

// {"robot":"raspimouse","findings":[{"check":"driver","state":"ok","found":"...","advice":"..."}]}
std::string to_json(const hw::Examination& examination) {
    std::string text;
    for (const hw::Finding& finding : examination.findings)
        text += fmt::format("{}{{\"check\":{},\"state\":\"{}\",\"found\":{},\"advice\":{}}}",
                            text.empty() ? "" : ",\n ", json_text(finding.check), word(finding.state),
                            json_text(finding.found), json_text(finding.advice));
    return fmt::format("{{\"robot\":{},\"findings\":[{}]}}\n", json_text(examination.driver), text);
}

Expected<hw::Findings> moves(const DoctorOptions& options, const std::string& driver) {
    StopSignals signals;
    Person person(signals.received(), options.is_sure);
    if (auto there = person.is_there(); !there) return Unexpected(there.error());
    Hardware hardware;
    const hw::MachineRoots all = roots(options);
    hardware.dev_root = all.devices.dev;
    hardware.sys_root = all.devices.sys;
    auto robot = guided_by_model(driver, hardware, signals.received());
    if (!robot) return Unexpected(robot.error());
    auto ok = person.confirm("The wheels are going to turn: hold the robot so that they touch nothing.");
    if (!ok) return Unexpected(ok.error());
    return hw::check_moves(**robot, [&](const std::string& text) { person.tell(text); });
}

// The devices of a system's components, and of its robots' drivers.
Expected<std::vector<ComponentEntry>> devices_of(const std::string& file) {
    if (file.empty()) return {};
    const LiveOptions live = simulated_systems();
    auto spec = read_system_file(file, Project::of(file, live.installed), {.peer_words = live.peer_words});
    if (!spec) return Unexpected(spec.error());
    for (RobotEntry* robot : entries_of<RobotEntry>(*spec)) {
        const auto model = spec->models.find(robot->described_by());
        if (model != spec->models.end() && !model->second.hardware.script.empty()) robot->backend = scripted;
    }
    if (auto ok = add_script_drivers(*spec); !ok) return Unexpected(ok.error());
    std::vector<ComponentEntry> devices;
    for (const ComponentEntry* component : entries_of<ComponentEntry>(*spec)) {
        if (find_device_kind(component->type) != nullptr) devices.push_back(*component);
    }
    return devices;
}

int doctor(const DoctorOptions& options) {
    const auto devices = devices_of(options.file);
    if (!devices) return refuse(devices.error());
    hw::Examination examination = hw::examine(roots(options), *devices);
    if (options.move) {
        if (examination.driver.empty()) return refuse("--move: no robot was found on this machine");
        if (!options.json) print(examination.findings);
        const auto moved = moves(options, examination.driver);
        if (!moved) return refuse(moved.error());
        if (!options.json) print(*moved);
        examination.findings.insert(examination.findings.end(), moved->begin(), moved->end());
    } else if (!options.json) {
        print(examination.findings);
    }
    if (options.json) fmt::print("{}", to_json(examination));
    const auto wrong = std::count_if(examination.findings.begin(), examination.findings.end(),
                                     [](const auto& finding) { return finding.state == hw::Finding::State::wrong; });
    if (!options.json)
        fmt::print("{}\n",
                   wrong == 0 ? "nothing wrong" : fmt::format("{} thing{} to do", wrong, wrong == 1 ? "" : "s"));
    return wrong == 0 ? exit_done : exit_failed;
}

}  // namespace

SubCommand doctor_command() {
    auto options = std::make_shared<DoctorOptions>();
    return {.name = "doctor",
            .help = "Check a robot's hardware, and report how to fix what is missing",
            .options = {{"[FILE]",
                         &options->file,
                         "a system file: examine the devices of its robots too",
                         "",
                         {},
                         FileUse::source},
                        {"--json", &options->json, "write {robot, findings: [{check, state, found, advice}]}"},
                        {"--move", &options->move,
                         "turn each wheel as well, slowly, with the robot held in the air; asks first"},
                        {"--yes", &options->is_sure, "with --move: do not ask before it moves"},
                        {"--dev-root", &options->dev_root, "the folder of the device files (default /dev)", "DIR"},
                        {"--sys-root", &options->sys_root, "the folder of the kernel's devices (default /sys)", "DIR"},
                        {"--proc-root", &options->proc_root, "the folder of processes (default /proc)", "DIR"},
                        {"--udev-root", &options->udev_root, "the folder of rules.d (default /etc/udev and /lib/udev)",
                         "DIR"}},
            .run = [options] { return doctor(*options); },
            .footer =
                "Each finding is a line `ok`, `note` or `wrong`, and what to do about it. Without --move nothing is "
                "written to any device.\nExit status: 0 no problems, 1 something needs to be fixed, 2 --move could not "
                "be done."};
}

}  // namespace nezumi::cli
