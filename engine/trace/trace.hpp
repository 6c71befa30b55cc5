// Records the values of a system for recordings, plots and goldens, when the ports of a tick have latched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/trace/channel.hpp"
#include "engine/trace/series.hpp"

namespace nezumi {

/// Follows channels of a system, also across restarts. Ports that are not followed take no time. A reader of every
/// message reads the channels once a tick, after the tick; remembered numbers stay available for a while.
class Trace final : public PortObserver {
public:
    /// In a system with more ports, only requested channels are remembered.
    static constexpr std::size_t most_ports = 400;

    /// Memory for all remembered numbers [bytes]. If they need more, the oldest are dropped.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;

    /// Keeps the last `samples` of each channel, instead of `Series::usual_samples`; fewer if all need more than `most`
    /// bytes.
    void keep(std::size_t samples, std::size_t most = most_bytes);

    /// Switches to the channels of this system, which has just been built and must outlive this object. Followed
    /// channels stay; remembered numbers are dropped.
    void start(System& system);

    /// The channels that a trace remembers, and its limits.
    struct Memory {
        std::vector<std::string> names{};
        bool ports = false;
        std::size_t most_samples = 0;
        std::size_t most_bytes = 0;
    };
    Memory memory() const;
    /// Remembers from now on the channels in `memory` that this system has, with the limits in `memory`.
    void remember(const Memory& memory);
    /// Switches to the system of the other trace, and takes over its values of the channels that this trace remembers.
    /// A trace that follows nothing takes over all channels that the other one remembers.
    void take_over(Trace& other);

    /// Follows the channel with this name from now on. The channel lives as long as this object. The error names what
    /// does not exist.
    Expected<const Channel*> follow(std::string_view name);
    /// The number of followed channels.
    std::size_t followed() const { return followed_.size(); }
    /// Follows the channel with this name and keeps its numbers from now on. The series lives as long as the system has
    /// the channel.
    Expected<const Series*> remember(std::string_view name);
    /// The numbers for this name, which may be a part of a port ("controller.out.vx") whose whole value is remembered.
    struct Remembered {
        const Series* series;
        std::string name;    ///< the name of the series: `whole`, or the name of the part
        std::string whole;   ///< the name of the whole value: "controller.out"
        std::string part;    ///< selects the labels within this; "" for all
        bool holds = false;  ///< as `Channel::holds`
    };
    Expected<Remembered> remember_part(std::string_view name);
    /// The series that is remembered under this name already; null if there is none.
    const Series* remembered(std::string_view name) const;
    /// Whether all values under this name since this time [s] of the last start are kept; false if some were dropped,
    /// or if the name was remembered only later.
    bool has_since(std::string_view name, double seconds) const;
    /// Remembers all ports, also later ones, except those of pictures. No effect in a system of more than `most_ports`
    /// ports.
    void remember_ports();

    void latched(const System& system) override;

private:
    struct Followed {
        Channel channel;
        Series series{};
        double since = 0;  // [s] when it began to be remembered; 0: as long as the system has had it
        bool remembered = false;
        bool kept = false;  // a reader uses it: keep it even if the system has it no more
    };

    Expected<Followed*> find(std::string_view name);
    std::size_t bytes() const;
    void follow_layout(double since);

    System* system_ = nullptr;
    std::uint64_t layout_ = 0;  // of the system at the last resolution of channels
    bool remembers_ports_ = false;
    std::size_t most_samples_ = Series::usual_samples;
    std::size_t most_bytes_ = most_bytes;
    std::int64_t measured_ = 0;                              // number of ticks since the memory was measured
    std::map<std::string, Followed, std::less<>> followed_;  // by name
};

}  // namespace nezumi
