// Finds cameras by the kernel's list, loudspeakers by ALSA's.
#include <fmt/format.h>

#include <cerrno>
#include <fstream>

#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"

namespace nezumi::hw {
namespace {

using enum Finding::State;

std::string for_group(const std::string& node, const std::string& group) {
    const std::string advice = group_that_may(node);
    return advice.empty() ? "sudo adduser $USER " + group + ", then log in again" : advice;
}

void examine_cameras(const MachineRoots& roots, Findings& findings) {
    bool any = false;
    for (const std::string& name : names_in(roots.devices.sys + "/class/video4linux")) {
        const std::string node = roots.devices.dev + "/" + name;
        const std::string label = first_line(fmt::format("{}/class/video4linux/{}/name", roots.devices.sys, name));
        const std::string what = label.empty() ? name : fmt::format("{}: {}", name, label);
        any = true;
        switch (opening_fails_with(node, Node::Access::read)) {
            case 0: findings.push_back({"camera", good, what, ""}); break;
            case EACCES:
            case EPERM:
                findings.push_back(
                    {"camera", wrong, what + ": this user has no permission to use it", for_group(node, "video")});
                break;
            default:
                findings.push_back({"camera", wrong, fmt::format("{}: {} does not open", what, node),
                                    "unplug it and plug it in again, and look at what dmesg says"});
        }
    }
    if (!any) {
        findings.push_back({"camera", note, "not found", "plug one in if a system has a component Camera"});
    } else if (const auto loaded = roots.load_cameras(); !loaded) {
        findings.push_back({"camera", wrong, "nezumi can't use it", loaded.error()});
    }
}

// ALSA's list has two lines per card: " 0 [Headphones     ]: bcm2835_headpho - bcm2835 Headphones".
void examine_sound(const MachineRoots& roots, Findings& findings) {
    std::ifstream cards(roots.proc + "/asound/cards");
    std::vector<std::string> names;
    for (std::string line; std::getline(cards, line);) {
        const std::size_t dash = line.find("]: "), name = line.find(" - ");
        if (dash != line.npos && name != line.npos) names.push_back(line.substr(name + 3));
    }
    if (names.empty()) {
        findings.push_back({"sound", note, "no sound card was found", "plug in a loudspeaker if a robot must speak"});
        return;
    }
    const std::string folder = roots.devices.dev + "/snd";
    for (const std::string& node : names_in(folder)) {
        if (!node.starts_with("pcm")) continue;
        const std::string path = fmt::format("{}/{}", folder, node);
        const int code = opening_fails_with(path, Node::Access::read);
        if (code != EACCES && code != EPERM) continue;
        findings.push_back(
            {"sound", wrong, listed(names) + ": this user has no permission to use it", for_group(path, "audio")});
        return;
    }
    findings.push_back({"sound", good, listed(names), ""});
}

}  // namespace

void examine_media(const MachineRoots& roots, Findings& findings) {
    examine_cameras(roots, findings);
    examine_sound(roots, findings);
}

}  // namespace nezumi::hw
