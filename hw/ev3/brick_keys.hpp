// The keys of the brick, read on their own thread.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hw/device/files.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {

/// The names for `port` in a robot file.
inline constexpr std::array<std::string_view, 6> brick_keys{"up", "down", "left", "right", "enter", "back"};

/// True for each pressed key, in the order of `brick_keys`.
using BrickKeyValues = std::array<bool, brick_keys.size()>;

/// Asks the event device which keys are down, instead of reading events. So a key is also noticed if it was pressed
/// before the device was opened.
class BrickKeys final : public Sampler<BrickKeyValues> {
public:
    /// `dev` is /dev or the folder that replaces it.
    explicit BrickKeys(const DevicePath& dev);

    static constexpr double period = 0.03;  ///< [s] between readings

protected:
    tl::expected<std::optional<BrickKeyValues>, std::string> sample(double now) override;

private:
    tl::expected<void, std::string> open();

    const std::array<DevicePath, 2> nodes_;  // paths on newer and on older systems
    std::string node_;                       // the open one
    std::unique_ptr<OpenFile> file_;
};

}  // namespace nezumi::hw
