// The parameters of each kind of device on a wire.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/devices/gpio_message.hpp"
#include "engine/devices/wired_device.hpp"

namespace nezumi {
namespace {

using Integers = std::vector<std::int64_t>;

ParameterSpec text(std::string name, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = std::string();
    spec.doc = std::move(doc);
    return spec;
}

ParameterSpec whole(std::string name, std::int64_t initial, double min, double max, std::string unit, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = initial;
    spec.min = min;
    spec.max = max;
    spec.unit = std::move(unit);
    spec.doc = std::move(doc);
    return spec;
}

ParameterSpec flag(std::string name, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = false;
    spec.doc = std::move(doc);
    return spec;
}

ParameterSpec seconds(std::string name, double initial, double min, double max, std::string doc) {
    ParameterSpec spec = whole(std::move(name), 0, min, max, "s", std::move(doc));
    spec.initial = initial;
    return spec;
}

ParameterSpec numbers(std::string name, double min, double max, std::string doc) {
    ParameterSpec spec = whole(std::move(name), 0, min, max, "", std::move(doc));
    spec.initial = std::vector<std::int64_t>{};
    spec.max_size = 64;
    return spec;
}

template <class T>
const T& value_of(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<T>();
}

ParameterSpec periods() {
    ParameterSpec spec = numbers("periods", 0.002, 60, "instead of `every`: the period of each register");
    spec.initial = std::vector<double>{};
    spec.unit = "s";
    return spec;
}

ParameterSpec frames() {
    ParameterSpec spec = text("frames", "the bytes that are sent every period; the answer to each of them is read");
    spec.initial = std::vector<std::string>{};
    spec.max_size = 16;
    return spec;
}

std::string check_spi(const Parameters& parameters) {
    for (const std::string& frame : value_of<std::vector<std::string>>(parameters, "frames")) {
        if (frame.empty()) return "frames: expected the bytes that are sent, got an empty string";
        if (frame.size() > 256) return fmt::format("frames: expected at most 256 bytes, got {}", frame.size());
    }
    return "";
}

ParameterSpec pwm_channels() {
    ParameterSpec spec = numbers("pwm_channels", 0, 63, "the PWM chip's channels that are set");
    spec.max_size = 8;
    return spec;
}

ParameterSpec pwm_frequency() {
    ParameterSpec spec = whole("pwm_frequency", 0, 1, 1e6, "Hz", "of the PWM channels; 50 for servos");
    spec.initial = 1000.0;
    return spec;
}

std::string check_i2c(const Parameters& parameters) {
    if (value_of<std::int64_t>(parameters, "address") == 0)
        return "address: expected the device's address on the bus, such as 0x40";
    const Integers& registers = value_of<Integers>(parameters, "registers");
    const std::size_t lengths = value_of<Integers>(parameters, "lengths").size();
    if (registers.size() != lengths)
        return fmt::format("lengths: expected the number of bytes of each of the {} registers, got {} numbers",
                           registers.size(), lengths);
    const std::size_t periods = value_of<std::vector<double>>(parameters, "periods").size();
    if (periods != 0 && periods != registers.size())
        return fmt::format("periods: expected the period of each of the {} registers, got {} numbers", registers.size(),
                           periods);
    for (const std::int64_t number : registers) {
        if (number > 255 && value_of<std::int64_t>(parameters, "number_bytes") == 1)
            return fmt::format("registers: {} does not fit in a byte: expected at most 255, or number_bytes = 2",
                               number);
    }
    return "";
}

ParameterSpec choice(std::string name, std::vector<Value> choices, std::string doc) {
    ParameterSpec spec = text(std::move(name), std::move(doc));
    spec.initial = choices.front();
    spec.choices = std::move(choices);
    return spec;
}

GpioOutputs gpio_outputs(const Parameters& parameters) {
    return {value_of<Integers>(parameters, "outputs"), value_of<Integers>(parameters, "pwm_channels")};
}

// Each output and each channel needs its safe level.
std::string check_safe_levels(const Parameters& parameters) {
    const auto& safe = value_of<std::string>(parameters, "safe");
    if (safe.empty()) return "";
    const GpioOutputs outputs = gpio_outputs(parameters);
    const auto levels = read_gpio_message(safe, outputs);
    if (!levels) return "safe: " + levels.error();
    const auto has = [&](bool is_pwm, std::int64_t number) {
        return std::any_of(levels->begin(), levels->end(),
                           [&](const GpioLevel& each) { return each.is_pwm == is_pwm && each.number == number; });
    };
    for (const std::int64_t line : outputs.lines) {
        if (!has(false, line)) return fmt::format("safe: output {0} has no level: add {0}=0 or {0}=1", line);
    }
    for (const std::int64_t channel : outputs.pwm_channels) {
        if (!has(true, channel)) return fmt::format("safe: pwm_channel {0} has no duty cycle: add pwm{0}=0", channel);
    }
    return "";
}

std::string check_gpio(const Parameters& parameters) {
    Integers lines = value_of<Integers>(parameters, "outputs");
    const auto& inputs = value_of<Integers>(parameters, "inputs");
    lines.insert(lines.end(), inputs.begin(), inputs.end());
    if (lines.empty() && value_of<Integers>(parameters, "pwm_channels").empty())
        return "expected inputs, outputs or pwm_channels";
    std::sort(lines.begin(), lines.end());
    if (const auto twice = std::adjacent_find(lines.begin(), lines.end()); twice != lines.end())
        return fmt::format("GPIO line {} is given twice", *twice);
    return check_safe_levels(parameters);
}

std::string check_gpio_message(const Parameters& parameters, std::string_view message) {
    const auto levels = read_gpio_message(message, gpio_outputs(parameters));
    return levels ? "" : levels.error();
}

std::vector<ParameterSpec> with_safe(std::vector<ParameterSpec> specs) {
    specs.push_back(text("safe",
                         "the bytes that stop what the device moves: sent at every kind of stop, and when the "
                         "engine dies; at most 255"));
    specs.push_back(flag("measures_only",
                         "the device moves nothing, so it needs no `safe`; in a robot file: "
                         "`safe = false`"));
    return specs;
}

}  // namespace

std::span<const DeviceKind> device_kinds() {
    static const std::array<DeviceKind, 5> kinds{
        DeviceKind{"serial", "Serial",
                   with_safe({text("path", "the device, such as /dev/ttyACM0"),
                              text("vendor", "instead of `path`: the USB vendor's number, such as \"2341\""),
                              text("serial_number", "with `vendor`: the device's own serial number"),
                              whole("baud", 115200, 50, 4000000, "Bd", "bits per second"),
                              text("ends", "the end of each line, such as \"\\n\": ports are TimedString then"),
                              text("terminator", "instead of `ends`: the last bytes of each frame"),
                              whole("length", 0, 0, 1024, "", "instead of `ends`: bytes of each frame"),
                              flag("cobs", "instead of `ends`: frames are encoded by COBS and end with 0")})},
        DeviceKind{"udp", "Udp",
                   with_safe({text("host", "the device's address, such as \"192.168.4.1\""),
                              whole("port", 0, 0, 65535, "", "the device's port"),
                              whole("local_port", 0, 0, 65535, "", "this computer's port; 0: any"),
                              text("ends", "the end of each datagram's text: ports are TimedString then")})},
        DeviceKind{
            "i2c", "I2c",
            with_safe({whole("bus", 1, 0, 255, "", "the bus's number: 1 is /dev/i2c-1"),
                       text("path", "instead of `bus`: the bus, such as /dev/i2c-1"),
                       whole("address", 0, 0, 0x77, "", "the device's address on the bus, 7 bits, such as 0x40"),
                       numbers("registers", 0, 65535, "the registers that are read every period"),
                       numbers("lengths", 1, 32, "how many bytes are read from each register"),
                       seconds("every", 0.05, 0.002, 60, "the period"), periods(),
                       whole("number_bytes", 1, 1, 2, "", "the bytes of a register's number"),
                       choice("order", {"big", "little"}, "with `number_bytes = 2`: \"big\": the higher byte first")}),
            check_i2c},
        DeviceKind{
            "spi", "Spi",
            with_safe({whole("bus", 0, 0, 255, "", "the bus's number: 0 of /dev/spidev0.1"),
                       whole("chip_select", 0, 0, 255, "", "the device's line: 1 of /dev/spidev0.1"),
                       text("path", "instead of `bus` and `chip_select`: the device, such as /dev/spidev0.1"),
                       whole("speed", 1000000, 1000, 125000000, "Hz", "of the clock"),
                       whole("mode", 0, 0, 3, "", "the clock's polarity and phase, as in the device's data sheet"),
                       frames(), seconds("every", 0.05, 0.002, 60, "the period"),
                       flag("answers", "the answers to messages to the device are read too, as those to `frames`")}),
            check_spi},
        DeviceKind{"gpio", "Gpio",
                   with_safe({whole("chip", 0, 0, 255, "", "the chip's number: 0 is /dev/gpiochip0"),
                              text("path", "instead of `chip`: the chip, such as /dev/gpiochip0"),
                              numbers("outputs", 0, 1023, "the chip's lines that are set"),
                              numbers("inputs", 0, 1023, "the chip's lines whose edges are reported"),
                              choice("pull", {"none", "up", "down"}, "the resistors of the inputs"),
                              seconds("debounce", 0, 0, 1, "how long a level of an input must last"),
                              whole("pwm_chip", 0, 0, 255, "", "the PWM chip's number: 0 is /sys/class/pwm/pwmchip0"),
                              pwm_channels(), pwm_frequency()}),
                   check_gpio, true, check_gpio_message}};
    return kinds;
}

const DeviceKind* find_device_kind(std::string_view type) {
    for (const DeviceKind& kind : device_kinds()) {
        if (kind.type == type) return &kind;
    }
    return nullptr;
}

}  // namespace nezumi
