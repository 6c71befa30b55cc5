// A device that publishes recorded messages in the ticks in which they arrived.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/components/component.hpp"
#include "engine/ports/port.hpp"

namespace nezumi {

/// The messages of one port, in the order of their ticks.
struct DrivePort {
    const MessageType* type = nullptr;
    std::vector<std::pair<std::int64_t, AnyMessage>> messages{};
};

class RecordedDevice final : public Device {
public:
    /// The name of this type of component.
    static constexpr std::string_view type_name = "Recording";

    explicit RecordedDevice(std::string name) : Device(std::move(name), std::string(type_name)) {}

    /// Adds an out-port for these messages, which must outlive the device.
    void add(const std::string& port, const DrivePort& recorded);

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

private:
    struct Track {
        OutPortBase* port;
        const std::vector<std::pair<std::int64_t, AnyMessage>>* messages;
        std::size_t next = 0;
    };
    std::vector<Track> tracks_;
};

}  // namespace nezumi
