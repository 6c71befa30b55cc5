// The keys of the brick, read on a thread of their own.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hw/device/files.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {

/// As a robot file's `port` calls them.
inline constexpr std::array<std::string_view, 6> brick_keys{"up", "down", "left", "right", "enter", "back"};

/// Whether each is pressed, in the order of `brick_keys`.
using BrickKeyValues = std::array<bool, brick_keys.size()>;

/// Asks the event device which keys are down: what happened before it was opened, or while nobody read, is not missed.
class BrickKeys final : public Sampler<BrickKeyValues> {
public:
    /// `dev` stands for /dev.
    explicit BrickKeys(const DevicePath& dev);

    static constexpr double period = 0.03;  ///< [s] between readings

protected:
    tl::expected<std::optional<BrickKeyValues>, std::string> sample(double now) override;

private:
    tl::expected<void, std::string> open();

    const std::array<DevicePath, 2> nodes_;  // of newer systems and of older ones
    std::string node_;                       // the one that is open
    std::unique_ptr<OpenFile> file_;
};

}  // namespace nezumi::hw
