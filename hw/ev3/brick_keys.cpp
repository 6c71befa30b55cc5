// EVIOCGKEY of the keys' event device.
#include "hw/ev3/brick_keys.hpp"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "hw/ev3/device_class.hpp"

namespace nezumi::hw {
namespace {

constexpr std::array<unsigned, brick_keys.size()> codes{KEY_UP,    KEY_DOWN,  KEY_LEFT,
                                                        KEY_RIGHT, KEY_ENTER, KEY_BACKSPACE};

std::string why_not(const std::string& node, int code) {
    if (code == EACCES)
        return describe(NodeError{node, code}) + ": this user may not use it. Try: sudo adduser $USER input";
    return describe(NodeError{node, code}) + ": is this an EV3 brick with ev3dev?";
}

}  // namespace

BrickKeys::BrickKeys(const std::string& dev)
    : Sampler("keys", period),
      nodes_{dev + "/input/by-path/platform-gpio_keys-event", dev + "/input/by-path/platform-gpio-keys.0-event"} {}

BrickKeys::~BrickKeys() {
    if (file_ >= 0) close(file_);
}

tl::expected<void, std::string> BrickKeys::open() {
    std::string why;
    for (const std::string& node : nodes_) {
        file_ = ::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        if (file_ >= 0) {
            node_ = node;
            return {};
        }
        if (why.empty() || errno != ENOENT) why = why_not(node, errno);
    }
    return tl::unexpected(why);
}

tl::expected<std::optional<BrickKeyValues>, std::string> BrickKeys::sample(double /*now*/) {
    if (file_ < 0) {
        if (auto ok = open(); !ok) return tl::unexpected(ok.error());
    }
    std::array<unsigned char, KEY_MAX / 8 + 1> down{};
    if (ioctl(file_, EVIOCGKEY(sizeof down), down.data()) < 0) {
        const int code = errno;
        close(std::exchange(file_, -1));
        return tl::unexpected(why_not(node_, code));
    }
    BrickKeyValues pressed{};
    for (std::size_t i = 0; i < codes.size(); ++i) pressed[i] = (down[codes[i] / 8] >> (codes[i] % 8) & 1) != 0;
    return pressed;
}

}  // namespace nezumi::hw
