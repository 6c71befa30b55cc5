// Finds a gamepad and processes its events.
#include "hw/gamepad/evdev_gamepad.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <libevdev/libevdev.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/node.hpp"
#include "hw/device/numbered_nodes.hpp"

namespace nezumi::hw {
namespace {

constexpr double usual_dead_zone = 0.05;  // as a part of a stick's range

// True for gamepads and joysticks: they have properties that keyboards, mice and touch pads do not have.
bool is_gamepad(libevdev* device) {
    const auto has = [device](unsigned type, unsigned code) {
        return libevdev_has_event_code(device, type, code) == 1;
    };
    return has(EV_ABS, ABS_X) && has(EV_ABS, ABS_Y) && (has(EV_KEY, BTN_GAMEPAD) || has(EV_KEY, BTN_JOYSTICK));
}

std::string with_gamepad_advice(const NodeError& error) {
    if (error.code == EISDIR) return describe(error) + " and no device: is --dev-root right?";
    return with_usb_advice(error, "input");
}

}  // namespace

void EvdevGamepad::Close::operator()(libevdev* device) const {
    const int file = libevdev_get_fd(device);
    libevdev_free(device);
    if (file >= 0) ::close(file);
}

double EvdevGamepad::Axis::at(int value) const {
    const double off = std::abs(value - middle), reach = value < middle ? middle - least : most - middle;
    // The middle of a range such as -32768 to 32767 lies between two values.
    if (off <= flat + 0.5 || reach <= flat) return 0;
    return std::min((off - flat) / (reach - flat), 1.0) * (value < middle ? -1 : 1);
}

EvdevGamepad::EvdevGamepad(const std::string& dev, const GamepadSettings& settings)
    : folder_(dev + "/input"),
      wanted_(under_dev(dev, settings.device)),
      dead_man_name_(settings.dead_man_button),
      stop_name_(settings.stop_button),
      dead_zone_(settings.dead_zone),
      centre_x_(settings.centre_x),
      centre_y_(settings.centre_y) {}

std::optional<GamepadState> EvdevGamepad::state() {
    if (hangs(clock_seconds())) {
        health_.lost(no_answer);
        return std::nullopt;
    }
    const std::lock_guard lock(mutex_);
    return state_;
}

std::vector<std::string> EvdevGamepad::take_faults() { return health_.take(); }

int EvdevGamepad::watched_file() const { return device_ ? libevdev_get_fd(device_.get()) : -1; }

tl::expected<EvdevGamepad::Device, std::string> EvdevGamepad::open(const std::string& node) const {
    const int file = ::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return tl::unexpected(with_gamepad_advice({node, errno}));
    libevdev* device = nullptr;
    if (const int error = libevdev_new_from_fd(file, &device); error < 0) {
        ::close(file);
        return tl::unexpected(with_gamepad_advice({node, -error}));
    }
    return Device(device);
}

tl::expected<unsigned, std::string> EvdevGamepad::button(const std::string& name) const {
    const int code = libevdev_event_code_from_name(EV_KEY, name.c_str());
    if (code >= 0 && libevdev_has_event_code(device_.get(), EV_KEY, static_cast<unsigned>(code)) == 1)
        return static_cast<unsigned>(code);
    std::vector<std::string_view> names;
    for (const unsigned each : buttons_) {
        if (const char* its_name = libevdev_event_code_get_name(EV_KEY, each)) names.emplace_back(its_name);
    }
    return tl::unexpected(fmt::format("{} ({}) is not used: it has no button '{}'; it has {}", node_,
                                      shown(libevdev_get_name(device_.get())), shown(name), fmt::join(names, ", ")));
}

tl::expected<void, std::string> EvdevGamepad::take(Device device, const std::string& node) {
    device_ = std::move(device);
    node_ = node;
    for (unsigned code = ABS_X; code < ABS_MT_SLOT; ++code) {
        const input_absinfo* range = libevdev_get_abs_info(device_.get(), code);
        if (range == nullptr) continue;
        const double reach = (range->maximum - range->minimum) / 2.0;
        // On Linux, the y axis points down.
        const double centre = code == ABS_X ? centre_x_ : code == ABS_Y ? -centre_y_ : 0;
        axes_.push_back({code, range->minimum, range->maximum,
                         dead_zone_ > 0    ? dead_zone_ * reach
                         : range->flat > 0 ? range->flat
                                           : usual_dead_zone * reach,
                         range->minimum + reach * (1 + centre)});
    }
    for (unsigned code = BTN_MISC; code <= KEY_MAX; ++code) {
        if (libevdev_has_event_code(device_.get(), EV_KEY, code) == 1) buttons_.push_back(code);
    }
    // A missing safety button must be noticed before it is needed.
    for (const auto& [name, code] : {std::pair(&dead_man_name_, &dead_man_), {&stop_name_, &stop_}}) {
        if (name->empty()) continue;
        const auto found = button(*name);
        if (!found) return tl::unexpected(found.error());
        *code = *found;
    }
    return {};
}

tl::expected<void, std::string> EvdevGamepad::find() {
    if (!wanted_.empty()) {
        auto device = open(wanted_);
        if (!device) return tl::unexpected(device.error());
        if (!is_gamepad(device->get()))
            return tl::unexpected(fmt::format("{} ({}) is not a gamepad: it has no stick or no buttons", wanted_,
                                              shown(libevdev_get_name(device->get()))));
        return take(std::move(*device), wanted_);
    }
    std::string why = fmt::format("none is connected: there is none in {}", folder_);
    for (const std::string& node : numbered_nodes(folder_, "event")) {
        auto device = open(node);
        if (!device) {
            why = device.error();
        } else if (is_gamepad(device->get())) {
            return take(std::move(*device), node);
        }
    }
    return tl::unexpected(why);
}

void EvdevGamepad::begin_anew() {
    device_.reset();
    axes_.clear();
    buttons_.clear();
    dead_man_.reset();
    stop_.reset();
    const std::lock_guard lock(mutex_);
    state_.reset();
}

tl::expected<void, std::string> EvdevGamepad::read_events() {
    unsigned flag = LIBEVDEV_READ_FLAG_NORMAL;
    for (;;) {
        input_event event{};
        const int status = libevdev_next_event(device_.get(), flag, &event);
        if (status == -EINTR) continue;
        if (status == -EAGAIN) {
            if (flag == LIBEVDEV_READ_FLAG_NORMAL) return {};
            flag = LIBEVDEV_READ_FLAG_NORMAL;  // synchronised again
            continue;
        }
        if (status < 0) return tl::unexpected(with_gamepad_advice({node_, -status}));
        // Events were lost: libevdev sends the changes as events.
        if (status == LIBEVDEV_READ_STATUS_SYNC) flag = LIBEVDEV_READ_FLAG_SYNC;
        if (stop_ && event.type == EV_KEY && event.code == *stop_ && event.value == 1) ++stops_;
    }
}

void EvdevGamepad::publish() {
    GamepadState now;
    const auto is_pressed = [this](unsigned code) {
        return libevdev_get_event_value(device_.get(), EV_KEY, code) != 0;
    };
    for (const Axis& axis : axes_) {
        const double at = axis.at(libevdev_get_event_value(device_.get(), EV_ABS, axis.code));
        if (axis.code == ABS_X) now.x = at;
        if (axis.code == ABS_Y) now.y = -at;  // on Linux, down is positive
        now.axes.push_back(static_cast<float>(at));
    }
    for (const unsigned code : buttons_) now.buttons.push_back(is_pressed(code));
    now.is_released = dead_man_ && !is_pressed(*dead_man_);
    now.is_stop_held = stop_ && is_pressed(*stop_);
    now.stops = stops_;
    const std::lock_guard lock(mutex_);
    state_ = std::move(now);
}

double EvdevGamepad::run() {
    auto ok = device_ ? tl::expected<void, std::string>() : find();
    if (ok) ok = read_events();
    if (!ok) {
        begin_anew();
        health_.lost(ok.error());
        return search_period;
    }
    publish();
    health_.works();
    return search_period;
}

namespace {

class WorkedGamepad final : public Gamepad {
public:
    explicit WorkedGamepad(std::unique_ptr<EvdevGamepad> gamepad) : gamepad_(std::move(gamepad)) {}
    std::optional<GamepadState> state() override { return gamepad_->state(); }
    std::vector<std::string> take_faults() override { return gamepad_->take_faults(); }

private:
    RunningJob<EvdevGamepad> gamepad_;
};

}  // namespace

std::unique_ptr<Gamepad> open_gamepad(const std::string& dev, const GamepadSettings& settings) {
    return std::make_unique<WorkedGamepad>(std::make_unique<EvdevGamepad>(dev, settings));
}

}  // namespace nezumi::hw
