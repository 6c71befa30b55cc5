// Messages before the first tick are skipped; several of one tick are published in their order.
#include "bindings/journal/recorded_device.hpp"

namespace nezumi {

void RecordedDevice::add(const std::string& port, const DrivePort& recorded) {
    out_ports_.push_back(make_out_port(recorded.type, port, ""));
    tracks_.push_back({out_ports_.back().get(), &recorded.messages});
}

void RecordedDevice::sense(const Time& now) {
    for (Track& track : tracks_) {
        for (; track.next < track.messages->size() && (*track.messages)[track.next].first <= now.tick; ++track.next) {
            const auto& [tick, message] = (*track.messages)[track.next];
            if (tick < now.tick) continue;
            track.port->write_any(message.data);
            track.port->stamp(message.tm);
        }
    }
}

}  // namespace nezumi
