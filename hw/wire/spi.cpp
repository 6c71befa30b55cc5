// Devices on SPI.
#include <fmt/format.h>

#include <filesystem>

#include "hw/device/clock.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/wire/period.hpp"
#include "hw/wire/spi_bus.hpp"
#include "hw/wire/wire_driver.hpp"
#include "hw/wire/wire_node.hpp"

namespace nezumi::hw {
namespace {

const NodeKind spi_device{.subsystem = "spidev",
                          .what = "an SPI device",
                          .example = "/dev/spidev0.0",
                          .when_missing = "is SPI on? On a Raspberry Pi: sudo raspi-config nonint do_spi 0",
                          .group = "spi",
                          .module = "spidev",
                          .node = "spidev",
                          .adapter = "bus/spi/devices/spi"};

// Sends each frame once per period. A message consists of the frame and the bytes that were received at the same time.
class SpiWire final : public OpenWire {
public:
    SpiWire(Descriptor device, std::vector<std::string> frames, double every, bool answers)
        : device_(std::move(device)), frames_(std::move(frames)), period_(every), answers_(answers) {}

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        if (frames_.empty()) return 0.5;
        if (!period_.is_due(clock_seconds())) return period_.left(clock_seconds());
        for (const std::string& frame : frames_) {
            std::string message = frame + std::string(frame.size(), '\0');
            const int error = spi_transfer(device_.get(), frame.data(), message.data() + frame.size(), frame.size());
            if (error != 0) return tl::unexpected(error);
            arrived.push_back({clock_seconds(), std::move(message)});
        }
        return period_.left(clock_seconds());
    }
    WriteTarget target() const override {
        return {.by = answers_ ? WriteBy::spi_answered : WriteBy::spi, .file = device_.get()};
    }

private:
    Descriptor device_;
    const std::vector<std::string> frames_;
    Period period_;
    const bool answers_;
};

class SpiDriver final : public WireDriver {
public:
    SpiDriver(const Parameters& parameters, DeviceRoots roots)
        : parameters_(parameters),
          roots_(std::move(roots)),
          path_(under_dev(roots_.dev, value_of<std::string>(parameters, "path").empty()
                                          ? fmt::format("/dev/spidev{}.{}", value_of<std::int64_t>(parameters, "bus"),
                                                        value_of<std::int64_t>(parameters, "chip_select"))
                                          : value_of<std::string>(parameters, "path"))) {}

    Opened open() const override {
        auto node = open_node(path_, roots_, spi_device);
        if (!node) return tl::unexpected(node.error());
        if (node->is_plain) return plain_wire(std::move(node->file));
        const int error =
            spi_set_up(node->file.get(), static_cast<std::uint8_t>(value_of<std::int64_t>(parameters_, "mode")),
                       static_cast<std::uint32_t>(value_of<std::int64_t>(parameters_, "speed")));
        if (error != 0) return tl::unexpected(why_lost(error));
        return std::make_unique<SpiWire>(
            std::move(node->file), value_of<std::vector<std::string>>(parameters_, "frames"),
            value_of<double>(parameters_, "every"), value_of<bool>(parameters_, "answers"));
    }
    Expected<Lease> lease() const override {
        std::error_code none;
        return std::filesystem::exists(path_, none) ? Lease::take("wire " + path_, path_) : Lease::of_nothing();
    }
    std::string why_lost(int error) const override { return with_wire_advice(path_, error, spi_device); }

private:
    const Parameters parameters_;
    const DeviceRoots roots_;
    const std::string path_;
};

}  // namespace

DriverOrWhy spi_driver(const Parameters& parameters, const DeviceRoots& roots) {
    return std::make_unique<SpiDriver>(parameters, roots);
}

}  // namespace nezumi::hw
