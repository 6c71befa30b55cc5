// The ioctls of <linux/gpio.h>.
#include "hw/wire/gpio_lines.hpp"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

gpio_v2_line_request request_of(const std::vector<std::int64_t>& lines, std::uint64_t flags) {
    gpio_v2_line_request request{};
    request.num_lines = static_cast<std::uint32_t>(std::min<std::size_t>(lines.size(), GPIO_V2_LINES_MAX));
    std::copy_n(lines.begin(), request.num_lines, request.offsets);
    std::strncpy(request.consumer, "nezumi", sizeof request.consumer - 1);
    request.config.flags = flags;
    return request;
}

void add_attribute(gpio_v2_line_request& request, const gpio_v2_line_attribute& attribute) {
    gpio_v2_line_config_attribute& added = request.config.attrs[request.config.num_attrs++];
    added.attr = attribute;
    added.mask = request.num_lines == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << request.num_lines) - 1;
}

Descriptor get_lines(int chip, gpio_v2_line_request& request) {
    return Descriptor(ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request) < 0 ? -1 : request.fd);
}

int set_duty(int file, std::uint64_t nanoseconds) {
    std::array<char, 24> text{};
    const char* end = std::to_chars(text.data(), text.data() + text.size(), nanoseconds).ptr;
    // Empties a plain file that replaces the kernel's file in tests. The kernel's files ignore this.
    if (ftruncate(file, 0) != 0 && errno == EIO) return errno;
    return pwrite(file, text.data(), static_cast<std::size_t>(end - text.data()), 0) < 0 ? errno : 0;
}

}  // namespace

int set_gpio(int lines, const std::array<int, most_pwm_channels>& pwm, const GpioLevels& levels) {
    int error = 0;
    if (levels.lines != 0) {
        gpio_v2_line_values values{.bits = levels.levels, .mask = levels.lines};
        if (ioctl(lines, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) < 0) error = errno;
    }
    for (std::size_t i = 0; i < pwm.size(); ++i) {
        if ((levels.channels >> i & 1U) == 0) continue;
        if (const int failed = set_duty(pwm[i], levels.duty[i]); failed != 0) error = failed;
    }
    return error;
}

Descriptor request_outputs(int chip, const std::vector<std::int64_t>& lines, std::uint64_t levels) {
    gpio_v2_line_request request = request_of(lines, GPIO_V2_LINE_FLAG_OUTPUT);
    gpio_v2_line_attribute attribute{};
    attribute.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
    attribute.values = levels;
    add_attribute(request, attribute);
    return get_lines(chip, request);
}

Descriptor request_inputs(int chip, const std::vector<std::int64_t>& lines, Pull pull, double debounce) {
    const std::uint64_t bias = pull == Pull::up     ? GPIO_V2_LINE_FLAG_BIAS_PULL_UP
                               : pull == Pull::down ? GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN
                                                    : 0;
    gpio_v2_line_request request = request_of(
        lines, GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING | bias);
    request.event_buffer_size = 1024;
    if (debounce > 0) {
        gpio_v2_line_attribute attribute{};
        attribute.id = GPIO_V2_LINE_ATTR_ID_DEBOUNCE;
        attribute.debounce_period_us = static_cast<std::uint32_t>(debounce * 1e6);
        add_attribute(request, attribute);
    }
    Descriptor inputs = get_lines(chip, request);
    if (inputs) fcntl(inputs.get(), F_SETFL, O_NONBLOCK);
    return inputs;
}

int read_edges(int inputs, std::vector<GpioEdge>& edges) {
    std::array<gpio_v2_line_event, 16> events;
    for (;;) {
        const ssize_t size = read(inputs, events.data(), sizeof events);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) return errno == EAGAIN ? 0 : errno;
        if (size == 0) return ENODEV;
        const std::size_t count = static_cast<std::size_t>(size) / sizeof(gpio_v2_line_event);
        for (std::size_t i = 0; i < count; ++i)
            edges.push_back({static_cast<double>(events[i].timestamp_ns) * 1e-9, events[i].offset,
                             events[i].id == GPIO_V2_LINE_EVENT_RISING_EDGE});
    }
}

int read_levels(int inputs, const std::vector<std::int64_t>& lines, std::vector<GpioEdge>& edges) {
    gpio_v2_line_values values{.bits = 0,
                               .mask = lines.size() >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << lines.size()) - 1};
    if (ioctl(inputs, GPIO_V2_LINE_GET_VALUES_IOCTL, &values) < 0) return errno;
    for (std::size_t i = 0; i < lines.size(); ++i)
        edges.push_back({clock_seconds(), lines[i], (values.bits >> i & 1U) != 0});
    return 0;
}

bool is_gpio_chip(int file) {
    gpiochip_info info{};
    return ioctl(file, GPIO_GET_CHIPINFO_IOCTL, &info) == 0;
}

}  // namespace nezumi::hw
