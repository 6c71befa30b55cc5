// Answers as the kernel's evdev: requests that a device does not know are refused, a device that has gone is ENODEV.
#include "tests/fakes/gamepad_nodes.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/time.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace nezumi::fakes {
namespace {

constexpr const char* keyboard = "input/event0";

const std::map<std::string, unsigned> axis_codes{{"ABS_X", ABS_X},         {"ABS_Y", ABS_Y},        {"ABS_Z", ABS_Z},
                                                 {"ABS_RX", ABS_RX},       {"ABS_RY", ABS_RY},      {"ABS_RZ", ABS_RZ},
                                                 {"ABS_HAT0X", ABS_HAT0X}, {"ABS_HAT0Y", ABS_HAT0Y}};
const std::map<std::string, unsigned> button_codes{
    {"BTN_SOUTH", BTN_SOUTH}, {"BTN_EAST", BTN_EAST},     {"BTN_NORTH", BTN_NORTH},   {"BTN_WEST", BTN_WEST},
    {"BTN_TL", BTN_TL},       {"BTN_TR", BTN_TR},         {"BTN_SELECT", BTN_SELECT}, {"BTN_START", BTN_START},
    {"BTN_MODE", BTN_MODE},   {"BTN_THUMBL", BTN_THUMBL}, {"BTN_THUMBR", BTN_THUMBR}};

input_event event(unsigned type, unsigned code, int value) {
    timeval now{};
    gettimeofday(&now, nullptr);
    input_event made{};
    made.input_event_sec = now.tv_sec;
    made.input_event_usec = now.tv_usec;
    made.type = static_cast<__u16>(type);
    made.code = static_cast<__u16>(code);
    made.value = value;
    return made;
}

// The bits of these codes, as many as there is room for; returns how many bytes.
int fill_bits(const std::vector<unsigned>& codes, void* data, std::size_t size) {
    std::memset(data, 0, size);
    for (const unsigned code : codes) {
        if (code / 8 < size)
            static_cast<unsigned char*>(data)[code / 8] |= static_cast<unsigned char>(1U << (code % 8));
    }
    return static_cast<int>(size);
}

template <class Map>
std::vector<unsigned> codes_of(const Map& map) {
    std::vector<unsigned> codes;
    for (const auto& [code, value] : map) codes.push_back(code);
    return codes;
}

}  // namespace

GamepadNodes::GamepadNodes() {
    for (const unsigned stick : {ABS_X, ABS_Y, ABS_RX, ABS_RY})
        axes_[stick] = {.value = 0, .minimum = -32768, .maximum = 32767, .fuzz = 16, .flat = 128, .resolution = 0};
    for (const unsigned trigger : {ABS_Z, ABS_RZ})
        axes_[trigger] = {.value = 0, .minimum = 0, .maximum = 255, .fuzz = 0, .flat = 0, .resolution = 0};
    for (const unsigned hat : {ABS_HAT0X, ABS_HAT0Y})
        axes_[hat] = {.value = 0, .minimum = -1, .maximum = 1, .fuzz = 0, .flat = 0, .resolution = 0};
    for (const auto& [name, code] : button_codes) buttons_[code] = false;
}

std::string GamepadNodes::gamepad() const { return fmt::format("input/event{}", 2 + plugged_in_); }

std::vector<std::string> GamepadNodes::names() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all{keyboard};
    if (is_there_) all.push_back(gamepad());
    return all;
}

int GamepadNodes::look(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return name == keyboard || (is_there_ && name == gamepad()) ? 0 : -ENOENT;
}

// Whether a call may go on, after what the fault makes of it: by the name of what is opened,
int GamepadNodes::enter(std::unique_lock<std::mutex>& lock, const std::string& name) {
    if (name == keyboard) return 0;
    changed_.wait(lock, [&] { return fault_ != "hang"; });
    if (!is_there_ || name != gamepad()) return -ENOENT;
    return fault_ == "denied" ? -EACCES : 0;
}

// and of what is open.
int GamepadNodes::enter(std::unique_lock<std::mutex>& lock, std::uint64_t handle) {
    const Reader& reader = readers_[handle];
    if (reader.is_keyboard) return 0;
    changed_.wait(lock, [&] { return fault_ != "hang"; });
    if (!is_there_ || reader.plugged_in != plugged_in_) return -ENODEV;
    return fault_ == "eio" ? -EIO : 0;
}

int GamepadNodes::open(const std::string& name, std::uint64_t& handle) {
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, name); error != 0) return error;
    handle = next_handle_++;
    readers_[handle] = {.is_keyboard = name == keyboard, .plugged_in = plugged_in_};
    return 0;
}

int GamepadNodes::read(const std::string& /*name*/, std::uint64_t /*handle*/, std::string& /*text*/) { return -EINVAL; }
int GamepadNodes::write(const std::string& /*name*/, std::uint64_t /*handle*/, std::string_view /*text*/) {
    return -EINVAL;
}

int GamepadNodes::read_on(const std::string& /*name*/, std::uint64_t handle, std::size_t most, std::string& text) {
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, handle); error != 0) return error;
    auto& events = readers_[handle].events;
    if (most < sizeof(input_event)) return -EINVAL;
    if (events.empty()) return -EAGAIN;
    while (!events.empty() && text.size() + sizeof(input_event) <= most) {
        text.append(reinterpret_cast<const char*>(&events.front()), sizeof(input_event));
        events.pop_front();
    }
    return 0;
}

unsigned GamepadNodes::poll(const std::string& /*name*/, std::uint64_t handle, std::function<void()> again) {
    const std::lock_guard lock(mutex_);
    Reader& reader = readers_[handle];
    if (again) reader.waiting.push_back(std::move(again));
    if (reader.is_keyboard) return 0;
    if (!is_there_ || reader.plugged_in != plugged_in_) return POLLERR | POLLHUP;
    return fault_ == "eio" || fault_ == "hang" || !reader.events.empty() ? POLLIN | POLLRDNORM : 0;
}

void GamepadNodes::wake(Reader& reader) {
    for (const auto& again : std::exchange(reader.waiting, {})) again();
}

int GamepadNodes::control(const std::string& /*name*/, std::uint64_t handle, unsigned request, void* data) {
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, handle); error != 0) return error;
    if (_IOC_TYPE(request) != 'E') return -ENOTTY;
    const bool is_keyboard = readers_[handle].is_keyboard;
    const unsigned number = _IOC_NR(request);
    const std::size_t size = _IOC_SIZE(request);
    const std::vector<unsigned> axes = is_keyboard ? std::vector<unsigned>{} : codes_of(axes_);
    const std::vector<unsigned> keys = is_keyboard ? std::vector<unsigned>{KEY_A, KEY_B} : codes_of(buttons_);
    if (request == EVIOCGVERSION) {
        *static_cast<int*>(data) = EV_VERSION;
        return 0;
    }
    if (request == EVIOCGID) {
        *static_cast<input_id*>(data) = {.bustype = BUS_USB, .vendor = 0x045e, .product = 0x028e, .version = 0x110};
        return 0;
    }
    if (request == EVIOCSCLOCKID) return 0;
    if (number == _IOC_NR(EVIOCGNAME(0))) {
        const std::string name = is_keyboard ? "Plain Keyboard" : "Microsoft X-Box 360 pad";
        const std::size_t length = std::min(size, name.size() + 1);
        std::memcpy(data, name.c_str(), length);
        return static_cast<int>(length);
    }
    if (number == _IOC_NR(EVIOCGPHYS(0)) || number == _IOC_NR(EVIOCGUNIQ(0))) return -ENOENT;
    if (number == _IOC_NR(EVIOCGPROP(0)) || number == _IOC_NR(EVIOCGLED(0)) || number == _IOC_NR(EVIOCGSND(0)) ||
        number == _IOC_NR(EVIOCGSW(0)))
        return fill_bits({}, data, size);
    if (number == _IOC_NR(EVIOCGKEY(0))) {
        std::vector<unsigned> pressed;
        for (const auto& [code, is_pressed] : buttons_) {
            if (is_pressed && !is_keyboard) pressed.push_back(code);
        }
        return fill_bits(pressed, data, size);
    }
    if (number >= _IOC_NR(EVIOCGBIT(0, 0)) && number <= _IOC_NR(EVIOCGBIT(EV_MAX, 0))) {
        const unsigned type = number - static_cast<unsigned>(_IOC_NR(EVIOCGBIT(0, 0)));
        if (type == 0) {
            return fill_bits(
                is_keyboard ? std::vector<unsigned>{EV_SYN, EV_KEY} : std::vector<unsigned>{EV_SYN, EV_KEY, EV_ABS},
                data, size);
        }
        return fill_bits(type == EV_KEY ? keys : type == EV_ABS ? axes : std::vector<unsigned>{}, data, size);
    }
    if (number >= _IOC_NR(EVIOCGABS(0)) && number <= _IOC_NR(EVIOCGABS(ABS_MAX))) {
        const auto axis = axes_.find(number - static_cast<unsigned>(_IOC_NR(EVIOCGABS(0))));
        if (is_keyboard || axis == axes_.end() || size < sizeof(input_absinfo)) return -EINVAL;
        *static_cast<input_absinfo*>(data) = axis->second;
        return 0;
    }
    return -EINVAL;
}

bool GamepadNodes::change(const std::string& name, int value, bool is_seen) {
    const std::lock_guard lock(mutex_);
    const auto axis = axis_codes.find(name), button = button_codes.find(name);
    const bool is_axis = axis != axis_codes.end();
    if (!is_axis && button == button_codes.end()) return false;
    const input_event made = is_axis ? event(EV_ABS, axis->second, value) : event(EV_KEY, button->second, value);
    if (is_axis) {
        if (std::exchange(axes_[axis->second].value, value) == value) return true;
    } else {
        if (std::exchange(buttons_[button->second], value != 0) == (value != 0)) return true;
    }
    for (auto& [handle, reader] : readers_) {
        if (reader.is_keyboard || reader.plugged_in != plugged_in_) continue;
        reader.events.push_back(is_seen ? made : event(EV_SYN, SYN_DROPPED, 0));
        reader.events.push_back(event(EV_SYN, SYN_REPORT, 0));
        wake(reader);
    }
    return true;
}

bool GamepadNodes::set(const std::string& name, int value) { return change(name, value, true); }
bool GamepadNodes::set_unseen(const std::string& name, int value) { return change(name, value, false); }

void GamepadNodes::unplug() {
    const std::lock_guard lock(mutex_);
    is_there_ = false;
    for (auto& [handle, reader] : readers_) wake(reader);
}

void GamepadNodes::plug_in() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_there_, true)) return;
    ++plugged_in_;
    for (auto& [code, axis] : axes_) axis.value = 0;
    for (auto& [code, pressed] : buttons_) pressed = false;
}

bool GamepadNodes::set_fault(const std::string& fault) {
    const std::lock_guard lock(mutex_);
    if (fault != "none" && fault != "denied" && fault != "eio" && fault != "hang") return false;
    fault_ = fault;
    changed_.notify_all();
    for (auto& [handle, reader] : readers_) wake(reader);
    return true;
}

}  // namespace nezumi::fakes
