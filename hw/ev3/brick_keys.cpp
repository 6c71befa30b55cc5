// Reads the keys with EVIOCGKEY.
#include "hw/ev3/brick_keys.hpp"

#include <linux/input-event-codes.h>

#include <cerrno>
#include <utility>

#include "hw/device/node.hpp"

namespace nezumi::hw {
namespace {

constexpr std::array<unsigned, brick_keys.size()> codes{KEY_UP,    KEY_DOWN,  KEY_LEFT,
                                                        KEY_RIGHT, KEY_ENTER, KEY_BACKSPACE};

std::string why_not(const std::string& node, int code) {
    if (code == EACCES)
        return describe(NodeError{node, code}) +
               ": this user has no permission to use it. Try: sudo adduser $USER input";
    return describe(NodeError{node, code}) + ": is this an EV3 brick with ev3dev?";
}

}  // namespace

BrickKeys::BrickKeys(const DevicePath& dev)
    : Sampler("keys", period),
      nodes_{dev + "/input/by-path/platform-gpio_keys-event", dev + "/input/by-path/platform-gpio-keys.0-event"} {}

tl::expected<void, std::string> BrickKeys::open() {
    std::string why;
    for (const DevicePath& node : nodes_) {
        auto file = node.files().open(node.text(), Access::read);
        if (file) {
            file_ = std::move(*file);
            node_ = node.text();
            return {};
        }
        if (why.empty() || file.error() != ENOENT) why = why_not(node.text(), file.error());
    }
    return tl::unexpected(why);
}

tl::expected<std::optional<BrickKeyValues>, std::string> BrickKeys::sample(double /*now*/) {
    if (!file_) {
        if (auto ok = open(); !ok) return tl::unexpected(ok.error());
    }
    std::array<char, KEY_MAX / 8 + 1> down{};
    if (const auto length = file_->keys(down); !length) {
        file_.reset();
        return tl::unexpected(why_not(node_, length.error()));
    }
    BrickKeyValues pressed{};
    for (std::size_t i = 0; i < codes.size(); ++i)
        pressed[i] = (static_cast<unsigned char>(down[codes[i] / 8]) >> (codes[i] % 8) & 1) != 0;
    return pressed;
}

}  // namespace nezumi::hw
