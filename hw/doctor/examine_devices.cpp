// The devices that a system names: serial lines, buses, GPIO.
#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"
#include "hw/drivers.hpp"

namespace nezumi::hw {

void examine_devices(const std::vector<ComponentEntry>& devices, const MachineRoots& roots, Findings& findings) {
    for (const ComponentEntry& device : devices) {
        const auto works = in_time([device, all = roots.devices] { return examine_device(device, all); });
        if (!works) {
            findings.push_back({device.name, Finding::State::wrong, "it does not answer",
                                "unplug it and plug it in again, and look at what dmesg says"});
        } else if (!*works) {
            findings.push_back({device.name, Finding::State::wrong, works->error().message, ""});
        } else {
            findings.push_back({device.name, Finding::State::good, "can be used", ""});
        }
    }
}

}  // namespace nezumi::hw
