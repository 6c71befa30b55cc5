// Serial lines.
#include <asm/termbits.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/wire/framing.hpp"
#include "hw/wire/wire_driver.hpp"
#include "hw/wire/wire_node.hpp"

namespace nezumi::hw {
namespace {

namespace fs = std::filesystem;

// Reads a stream of bytes and splits it into messages. Each call reads until nothing is left.
class StreamWire final : public OpenWire {
public:
    StreamWire(Descriptor file, const Framing& framing) : file_(std::move(file)), framer_(framing) {}

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        char buffer[4096];
        for (;;) {
            const ssize_t length = ::read(file_.get(), buffer, sizeof buffer);
            if (length < 0 && errno == EINTR) continue;
            if (length < 0 && errno == EAGAIN) return quiet;
            // A terminal gives EIO after its other end was closed.
            if (length <= 0) return tl::unexpected(length == 0 || errno == EIO ? 0 : errno);
            const double now = clock_seconds();
            for (std::string& message : framer_.take({buffer, static_cast<std::size_t>(length)}))
                arrived.push_back({now, std::move(message)});
        }
    }
    int watched_file() const override { return file_.get(); }
    WriteTarget target() const override { return {.by = WriteBy::stream, .file = file_.get()}; }

private:
    static constexpr double quiet = 0.5;  // [s] between checks of a device that sends nothing

    Descriptor file_;
    Framer framer_;
};

const NodeKind serial_line{.subsystem = "",  // pseudo-terminals have none, so isatty is used instead
                           .what = "a serial line",
                           .example = "/dev/ttyACM0",
                           .when_missing = "is the device plugged in?",
                           .group = "dialout"};

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

// Sets a line to raw mode, 8N1, at any speed. termios(3) can't be used, because it supports only some speeds.
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

OrWhy<std::string> path_of(const Parameters& parameters, const DeviceRoots& roots) {
    const auto &path = value_of<std::string>(parameters, "path"), &vendor = value_of<std::string>(parameters, "vendor");
    if (path.empty() == vendor.empty())
        return tl::unexpected<std::string>(
            "expected either path, such as \"/dev/ttyACM0\", or vendor, the USB vendor's number");
    if (path.empty()) return find_usb_serial(roots, vendor, value_of<std::string>(parameters, "serial_number"));
    return under_dev(roots.dev, path);
}

OrWhy<Framing> framing_of(const Parameters& parameters) {
    const auto& ends = value_of<std::string>(parameters, "ends");
    const auto& terminator = value_of<std::string>(parameters, "terminator");
    const auto length = value_of<std::int64_t>(parameters, "length");
    const bool cobs = value_of<bool>(parameters, "cobs");
    const int ways = (terminator.empty() ? 0 : 1) + (length > 0 ? 1 : 0) + (cobs ? 1 : 0) + (ends.empty() ? 0 : 1);
    if (ways > 1) return tl::unexpected<std::string>("ends, terminator, length and cobs: expected only one of them");
    return Framing{.end = ends.empty() ? terminator : ends, .length = static_cast<std::size_t>(length), .cobs = cobs};
}

class SerialDriver final : public WireDriver {
public:
    SerialDriver(Parameters parameters, DeviceRoots roots, Framing framing)
        : parameters_(std::move(parameters)), roots_(std::move(roots)), framing_(std::move(framing)) {}

    Opened open() const override {
        const auto path = path_of(parameters_, roots_);
        if (!path) return tl::unexpected(path.error());
        auto node = open_node(*path, roots_, serial_line);
        if (!node) return tl::unexpected(node.error());
        if (node->is_plain) return plain_wire(std::move(node->file));
        if (isatty(node->file.get()) == 0) return tl::unexpected(not_of_kind(*path, serial_line));
        const auto speed = static_cast<unsigned>(value_of<std::int64_t>(parameters_, "baud"));
        if (const int error = set_up(node->file.get(), speed); error != 0)
            return tl::unexpected(with_wire_advice(*path, error, serial_line));
        return std::make_unique<StreamWire>(std::move(node->file), framing_);
    }
    Expected<Lease> lease() const override {
        const std::string node = path_of(parameters_, roots_).value_or("");
        std::error_code none;
        const std::string place = fs::canonical(node, none).string();
        return place.empty() ? Lease::of_nothing() : Lease::take("wire " + place, place);
    }
    OrWhy<std::string> encode(std::string_view message) const override {
        auto bytes = Framer(framing_).encode(message);
        if (!bytes) return tl::unexpected(fmt::format("expected {} bytes, the parameter length", framing_.length));
        return std::move(*bytes);
    }
    std::string end() const override { return Framer(framing_).end(); }

private:
    const Parameters parameters_;
    const DeviceRoots roots_;
    const Framing framing_;
};

}  // namespace

OrWhy<std::string> find_usb_serial(const DeviceRoots& roots, const std::string& vendor,
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

DriverOrWhy serial_driver(const Parameters& parameters, const DeviceRoots& roots) {
    auto framing = framing_of(parameters);
    if (!framing) return tl::unexpected(framing.error());
    return std::make_unique<SerialDriver>(parameters, roots, std::move(*framing));
}

}  // namespace nezumi::hw
