// GPIO lines and PWM channels as a device.
#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "engine/devices/gpio_message.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/wire/gpio_lines.hpp"
#include "hw/wire/wire_driver.hpp"
#include "hw/wire/wire_node.hpp"

namespace nezumi::hw {
namespace {

using Numbers = std::vector<std::int64_t>;

const NodeKind gpio_chip{.subsystem = "gpio",
                         .what = "a GPIO chip",
                         .example = "/dev/gpiochip0",
                         .when_missing = "is there such a chip? ls /dev/gpiochip*",
                         .group = "gpio"};

// A sysfs file, or nothing with `errno`.
Descriptor open_attribute(const std::string& path) { return Descriptor(open(path.c_str(), O_WRONLY | O_CLOEXEC)); }

int write_attribute(const std::string& path, const std::string& text) {
    const Descriptor file = open_attribute(path);
    if (!file) return errno;
    return write(file.get(), text.data(), text.size()) < 0 ? errno : 0;
}

class GpioWire final : public OpenWire {
public:
    GpioWire(Descriptor chip, Descriptor outputs, Descriptor inputs, std::vector<Descriptor> duty,
             const Numbers& input_lines)
        : chip_(std::move(chip)), outputs_(std::move(outputs)), inputs_(std::move(inputs)), duty_(std::move(duty)) {
        if (inputs_) read_levels(inputs_.get(), input_lines, first_);
    }

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        std::vector<GpioEdge> edges = std::exchange(first_, {});
        const int error = inputs_ ? read_edges(inputs_.get(), edges) : 0;
        for (const GpioEdge& each : edges) arrived.push_back({each.tm, fmt::format("{}={:d}", each.line, each.level)});
        if (error != 0) return tl::unexpected(error);
        return 0.5;
    }
    int watched_file() const override { return inputs_.get(); }
    WriteTarget target() const override {
        WriteTarget target{.by = WriteBy::gpio, .file = outputs_ ? outputs_.get() : chip_.get()};
        for (std::size_t i = 0; i < duty_.size(); ++i) target.pwm[i] = duty_[i].get();
        return target;
    }

private:
    Descriptor chip_, outputs_, inputs_;
    std::vector<Descriptor> duty_;
    std::vector<GpioEdge> first_;  // the levels at the start
};

class GpioDriver final : public WireDriver {
public:
    GpioDriver(const Parameters& parameters, DeviceRoots roots)
        : parameters_(parameters),
          roots_(std::move(roots)),
          path_(under_dev(roots_.dev, value_of<std::string>(parameters, "path").empty()
                                          ? fmt::format("/dev/gpiochip{}", value_of<std::int64_t>(parameters, "chip"))
                                          : value_of<std::string>(parameters, "path"))),
          pwm_folder_(
              fmt::format("{}/class/pwm/pwmchip{}", roots_.sys, value_of<std::int64_t>(parameters, "pwm_chip"))),
          period_(static_cast<std::uint64_t>(1e9 / value_of<double>(parameters, "pwm_frequency"))) {}

    Opened open() const override {
        auto node = open_chip();
        if (!node) return tl::unexpected(node.error());
        if (node->is_plain) return plain_wire(std::move(node->file));
        const int chip = node->file.get();
        Descriptor outs, ins;
        if (!outputs().empty()) {
            outs = request_outputs(chip, outputs(), safe_levels());
            if (!outs) return tl::unexpected(why_no_lines("outputs", errno));
        }
        if (!inputs().empty()) {
            ins = request_inputs(chip, inputs(), pull(), value_of<double>(parameters_, "debounce"));
            if (!ins) return tl::unexpected(why_no_lines("inputs", errno));
        }
        std::vector<Descriptor> duty;
        for (const std::int64_t channel : channels()) {
            auto opened = open_channel(channel);
            if (!opened) return tl::unexpected(opened.error());
            duty.push_back(std::move(*opened));
        }
        return std::make_unique<GpioWire>(std::move(node->file), std::move(outs), std::move(ins), std::move(duty),
                                          inputs());
    }
    // Only opens the chip, so that lines and channels do not change.
    OrWhy<void> examine() const override {
        const auto node = open_chip();
        return node ? OrWhy<void>() : tl::unexpected(node.error());
    }
    // The kernel gives a line to only one program, but a PWM channel to any. So only channels need a lease.
    Expected<Lease> lease() const override {
        std::error_code none;
        if (channels().empty() || is_plain() || !std::filesystem::exists(pwm_folder_, none)) return Lease::of_nothing();
        return Lease::take(fmt::format("wire {} {}", pwm_folder_, fmt::join(channels(), ",")), pwm_folder_);
    }
    OrWhy<std::string> encode(std::string_view message) const override {
        if (is_plain()) return std::string(message);
        auto levels = levels_of(message);
        if (!levels) return tl::unexpected(levels.error());
        return std::string(reinterpret_cast<const char*>(&*levels), sizeof *levels);
    }
    std::string encode_safe(std::string_view safe) const override {
        return safe.empty() ? "" : encode(safe).value_or("");  // `safe` was checked before
    }
    bool has_times() const override { return true; }
    std::string why_lost(int error) const override { return with_wire_advice(path_, error, gpio_chip); }

private:
    OrWhy<WireNode> open_chip() const {
        auto node = open_node(path_, roots_, gpio_chip);
        if (node && !node->is_plain && !is_gpio_chip(node->file.get()))
            return tl::unexpected(not_of_kind(path_, gpio_chip));
        return node;
    }
    const Numbers& outputs() const { return value_of<Numbers>(parameters_, "outputs"); }
    const Numbers& inputs() const { return value_of<Numbers>(parameters_, "inputs"); }
    const Numbers& channels() const { return value_of<Numbers>(parameters_, "pwm_channels"); }
    Pull pull() const {
        const auto& pull = value_of<std::string>(parameters_, "pull");
        return pull == "up" ? Pull::up : pull == "down" ? Pull::down : Pull::none;
    }
    bool is_plain() const {
        std::error_code none;
        return std::filesystem::is_regular_file(path_, none);
    }

    OrWhy<GpioLevels> levels_of(std::string_view message) const {
        const auto levels = read_gpio_message(message, {outputs(), channels()});
        if (!levels) return tl::unexpected(levels.error());
        GpioLevels all;
        for (const GpioLevel& each : *levels) {
            const Numbers& among = each.is_pwm ? channels() : outputs();
            const auto index =
                static_cast<std::size_t>(std::find(among.begin(), among.end(), each.number) - among.begin());
            if (each.is_pwm) {
                all.channels = static_cast<std::uint8_t>(all.channels | 1U << index);
                all.duty[index] = static_cast<std::uint64_t>(each.value * static_cast<double>(period_));
            } else {
                const std::uint64_t bit = std::uint64_t{1} << index;
                all.lines |= bit;
                all.levels = each.value != 0 ? all.levels | bit : all.levels & ~bit;
            }
        }
        return all;
    }
    std::uint64_t safe_levels() const {
        return levels_of(value_of<std::string>(parameters_, "safe")).value_or(GpioLevels{}).levels;
    }

    std::string why_no_lines(std::string_view which, int error) const {
        if (error == EBUSY)
            return fmt::format("{}: {} {}: another program or driver uses one of them (gpioinfo shows it)", path_,
                               which, fmt::join(which == "inputs" ? inputs() : outputs(), ", "));
        if (error == EINVAL)
            return fmt::format("{}: {} {}: the chip has no such line, or can't do this", path_, which,
                               fmt::join(which == "inputs" ? inputs() : outputs(), ", "));
        return with_wire_advice(path_, error, gpio_chip);
    }

    // Sets up a PWM channel and returns its file duty_cycle.
    OrWhy<Descriptor> open_channel(std::int64_t channel) const {
        const std::string folder = fmt::format("{}/pwm{}", pwm_folder_, channel);
        const auto refuse = [&](int error) {
            const std::string text = fmt::format("{}: {}", folder, std::strerror(error));
            return tl::unexpected(
                error == ENOENT ? text + ": is the PWM overlay loaded, and does the chip have this channel?" : text);
        };
        std::error_code none;
        if (!std::filesystem::exists(folder, none)) {
            if (const int error = write_attribute(pwm_folder_ + "/export", std::to_string(channel)); error != 0)
                return refuse(error);
            // udev sets the permission for the group a little later.
            const double end = clock_seconds() + 0.5;
            while (!open_attribute(folder + "/duty_cycle") && clock_seconds() < end) usleep(5000);
        }
        Descriptor duty = open_attribute(folder + "/duty_cycle");
        if (!duty) return refuse(errno);
        // The kernel refuses a period that is shorter than the duty, so the duty is set to 0 first.
        write_attribute(folder + "/duty_cycle", "0");
        if (const int error = write_attribute(folder + "/period", std::to_string(period_)); error != 0)
            return refuse(error);
        if (const int error = write_attribute(folder + "/enable", "1"); error != 0) return refuse(error);
        return duty;
    }

    const Parameters parameters_;
    const DeviceRoots roots_;
    const std::string path_, pwm_folder_;
    const std::uint64_t period_;  // [ns]
};

}  // namespace

DriverOrWhy gpio_driver(const Parameters& parameters, const DeviceRoots& roots) {
    return std::make_unique<GpioDriver>(parameters, roots);
}

}  // namespace nezumi::hw
