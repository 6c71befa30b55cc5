// Serial lines.
#include <asm/termbits.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "hw/device/node.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/wire/endpoint.hpp"

namespace nezumi::hw {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<std::string>();
}

std::string with_advice(const std::string& path, int error) {
    std::string text = describe(NodeError{path, error});
    if (error == EACCES) text += ": add this user to the group dialout: sudo adduser $USER dialout, then log in again";
    if (error == ENOENT) text += ": is the device plugged in?";
    return text;
}

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

// Raw, 8N1, at any speed. No functions of termios(3): they only know some speeds.
int set_up(int file, unsigned speed) {
    termios2 settings{};
    if (ioctl(file, TCGETS2, &settings) != 0) return errno;
    settings.c_iflag = 0;
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
    settings.c_ispeed = settings.c_ospeed = speed;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    return ioctl(file, TCSETS2, &settings) != 0 ? errno : 0;
}

tl::expected<std::string, std::string> path_of(const Parameters& parameters, const DeviceRoots& roots) {
    const std::string path = text_of(parameters, "path"), vendor = text_of(parameters, "vendor");
    if (path.empty() == vendor.empty())
        return tl::unexpected<std::string>(
            "expected either path, such as \"/dev/ttyACM0\", or vendor, the USB vendor's number");
    if (path.empty()) return find_usb_serial(roots, vendor, text_of(parameters, "serial_number"));
    return under_dev(roots.dev, path);
}

}  // namespace

OpenWire::~OpenWire() {
    if (file >= 0) close(file);
}

tl::expected<std::string, std::string> find_usb_serial(const DeviceRoots& roots, const std::string& vendor,
                                                       const std::string& serial_number) {
    std::vector<std::string> found, others;
    std::error_code error;
    for (fs::directory_iterator entry(roots.sys + "/class/tty", error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code none;
        fs::path folder = fs::canonical(entry->path() / "device", none);
        // The USB device is a few folders above its interface.
        for (int up = 0; !none && up < 4 && !fs::exists(folder / "idVendor"); ++up) folder = folder.parent_path();
        const std::string its = none ? "" : first_line(folder / "idVendor");
        if (its.empty()) continue;
        const std::string serial = first_line(folder / "serial");
        const bool is_it = its == vendor && (serial_number.empty() || serial == serial_number);
        (is_it ? found : others)
            .push_back(is_it ? entry->path().filename().string() : fmt::format("{} {}", its, serial));
    }
    std::sort(found.begin(), found.end());
    std::sort(others.begin(), others.end());
    if (found.size() == 1) return fmt::format("{}/{}", roots.dev, found.front());
    if (!found.empty())
        return tl::unexpected(fmt::format("{} serial lines have USB vendor {}: give serial_number as well ({})",
                                          found.size(), vendor, fmt::join(found, ", ")));
    return tl::unexpected(
        fmt::format("no serial line has USB vendor {}{}{}", vendor,
                    serial_number.empty() ? "" : " and serial number " + serial_number,
                    others.empty() ? ": is it plugged in?" : fmt::format(": there are {}", fmt::join(others, ", "))));
}

Opened open_serial(const Parameters& parameters, const DeviceRoots& roots) {
    const auto path = path_of(parameters, roots);
    if (!path) return tl::unexpected(path.error());
    const bool may_be_plain = roots.dev != "/dev" && path->starts_with(roots.dev + "/");
    // Looks before it opens: opening may wake, rewind or block other devices.
    struct stat status {};
    if (stat(path->c_str(), &status) != 0) return tl::unexpected(with_advice(*path, errno));
    const bool is_plain = S_ISREG(status.st_mode);
    const auto no_line = [&] {
        return tl::unexpected(fmt::format("{}: it is no serial line: expected a device such as /dev/ttyACM0", *path));
    };
    if (!S_ISCHR(status.st_mode) && !(is_plain && may_be_plain)) return no_line();
    const int file = open(path->c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return tl::unexpected(with_advice(*path, errno));
    auto wire = std::make_unique<OpenWire>(file, is_plain, false);
    if (is_plain) return wire;
    if (isatty(file) == 0) return no_line();
    const auto speed = static_cast<unsigned>(parameters.find("baud")->value.get<std::int64_t>());
    if (const int error = set_up(file, speed); error != 0) return tl::unexpected(with_advice(*path, error));
    return wire;
}

std::string lease_of(const std::string& type, const Parameters& parameters, const DeviceRoots& roots) {
    if (type != "Serial") return "";
    std::error_code none;
    return fs::canonical(path_of(parameters, roots).value_or(""), none).string();
}

}  // namespace nezumi::hw
