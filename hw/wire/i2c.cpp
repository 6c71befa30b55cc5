// Devices on an I2C bus.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "hw/device/clock.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/wire/i2c_bus.hpp"
#include "hw/wire/period.hpp"
#include "hw/wire/wire_driver.hpp"
#include "hw/wire/wire_node.hpp"

namespace nezumi::hw {
namespace {

const NodeKind i2c_bus{.subsystem = "i2c-dev",
                       .what = "an I2C bus",
                       .example = "/dev/i2c-1",
                       .when_missing = "is I2C on? On a Raspberry Pi: sudo raspi-config nonint do_i2c 0",
                       .group = "i2c",
                       .module = "i2c-dev",
                       .node = "i2c-",
                       .adapter = "bus/i2c/devices/i2c-"};

struct Register {
    std::string number;  // the bytes that are sent
    std::size_t length;  // [bytes]
    Period period;
};

// Reads each register once per period. A message consists of the register's number and its bytes.
class I2cWire final : public OpenWire {
public:
    I2cWire(Descriptor bus, std::uint16_t address, std::vector<Register> registers)
        : bus_(std::move(bus)), address_(address), registers_(std::move(registers)) {}

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        double left = 0.5;
        for (Register& each : registers_) {
            if (each.period.is_due(clock_seconds())) {
                std::string message = each.number + std::string(each.length, '\0');
                char* bytes = message.data() + each.number.size();
                const int error =
                    retry_transfer([&] { return i2c_read(bus_.get(), address_, each.number, bytes, each.length); });
                if (error != 0) return tl::unexpected(error);
                arrived.push_back({clock_seconds(), std::move(message)});
            }
            left = std::min(left, each.period.left(clock_seconds()));
        }
        return left;
    }
    WriteTarget target() const override { return {.by = WriteBy::i2c, .address = address_, .file = bus_.get()}; }

private:
    Descriptor bus_;
    const std::uint16_t address_;
    std::vector<Register> registers_;
};

class I2cDriver final : public WireDriver {
public:
    I2cDriver(const Parameters& parameters, DeviceRoots roots, std::vector<Register> registers)
        : roots_(std::move(roots)),
          path_(under_dev(roots_.dev, value_of<std::string>(parameters, "path").empty()
                                          ? fmt::format("/dev/i2c-{}", value_of<std::int64_t>(parameters, "bus"))
                                          : value_of<std::string>(parameters, "path"))),
          address_(static_cast<std::uint16_t>(value_of<std::int64_t>(parameters, "address"))),
          registers_(std::move(registers)) {}

    Opened open() const override {
        auto node = open_node(path_, roots_, i2c_bus);
        if (!node) return tl::unexpected(node.error());
        if (node->is_plain) return plain_wire(std::move(node->file));
        if (const int error = i2c_claim(node->file.get(), address_); error != 0)
            return tl::unexpected(error == EBUSY
                                      ? fmt::format("{} at {:#x}: a driver of the kernel uses it", path_, address_)
                                      : with_wire_advice(path_, error, i2c_bus));
        const int silent = retry_transfer([&] { return i2c_probe(node->file.get(), address_); });
        if (silent != 0) return tl::unexpected(why_lost(silent));
        return std::make_unique<I2cWire>(std::move(node->file), address_, registers_);
    }
    // The lease is for one address; other programs may use other devices on the bus.
    Expected<Lease> lease() const override {
        std::error_code none;
        if (!std::filesystem::exists(path_, none)) return Lease::of_nothing();
        return Lease::take(fmt::format("wire {} {:#x}", path_, address_), path_);
    }
    std::string why_lost(int error) const override {
        if (error != ENXIO && error != EREMOTEIO && error != EIO && error != ETIMEDOUT)
            return with_wire_advice(path_, error, i2c_bus);
        return fmt::format("{}: no answer from address {:#x}: look at its wires, its power and its address (i2cdetect)",
                           path_, address_);
    }

private:
    const DeviceRoots roots_;
    const std::string path_;
    const std::uint16_t address_;
    const std::vector<Register> registers_;
};

std::string number_bytes(const Parameters& parameters, std::int64_t number) {
    const char low = static_cast<char>(number & 0xFF), high = static_cast<char>(number >> 8);
    if (value_of<std::int64_t>(parameters, "number_bytes") == 1) return {low};
    return value_of<std::string>(parameters, "order") == "big" ? std::string{high, low} : std::string{low, high};
}

}  // namespace

DriverOrWhy i2c_driver(const Parameters& parameters, const DeviceRoots& roots) {
    const auto& numbers = value_of<std::vector<std::int64_t>>(parameters, "registers");
    const auto& lengths = value_of<std::vector<std::int64_t>>(parameters, "lengths");
    const auto& periods = value_of<std::vector<double>>(parameters, "periods");
    std::vector<Register> registers;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        registers.push_back({number_bytes(parameters, numbers[i]), static_cast<std::size_t>(lengths[i]),
                             Period(periods.empty() ? value_of<double>(parameters, "every") : periods[i])});
    return std::make_unique<I2cDriver>(parameters, roots, std::move(registers));
}

}  // namespace nezumi::hw
