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

    /// [bytes] of all remembered numbers. When they are more, the oldest are dropped.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;

    /// Keeps the last `samples` of each channel, instead of `Series::usual_samples`, as far as `most` bytes go.
    void keep(std::size_t samples, std::size_t most = most_bytes);

    /// Switches to the channels of this system, which is at its start, and which must outlive this object. Followed
    /// channels stay; remembered numbers are dropped.
    void start(System& system);

    /// What a trace remembers.
    struct Memory {
        std::vector<std::string> names{};
        bool ports = false;
        std::size_t most_samples = 0;
        std::size_t most_bytes = 0;
    };
    Memory memory() const;
    /// From now on remembers what the trace of the same system at another time remembers, as far as it exists.
    void remember(const Memory& memory);
    /// Switches to the system of the other trace, with the values that this one remembers too. One that follows nothing
    /// remembers what the other did.
    void take_over(Trace& other);

    /// Follows the channel with this name from now on. It lives as long as this object. The error names what does not
    /// exist.
    Expected<const Channel*> follow(std::string_view name);
    /// How many are followed.
    std::size_t followed() const { return followed_.size(); }
    /// Keeps its numbers from now on as well. The series lives as long as the system has the channel.
    Expected<const Series*> remember(std::string_view name);
    /// The numbers for this name, which may be a part of a port ("controller.out.vx") whose whole value is remembered.
    struct Remembered {
        const Series* series;
        std::string name;    ///< under which it is remembered: `whole`, or that of the part
        std::string whole;   ///< of what the series is: "controller.out"
        std::string part;    ///< selects the labels within this; "" for all
        bool holds = false;  ///< as `Channel::holds`
    };
    Expected<Remembered> remember_part(std::string_view name);
    /// What is remembered under this name already; null without.
    const Series* remembered(std::string_view name) const;
    /// Whether it has all values under this name since this time [s] of the last start; false where older ones were
    /// dropped, or where it was not remembered yet.
    bool has_since(std::string_view name, double seconds) const;
    /// Remembers every port except those of pictures, also later ones, in a system of at most `most_ports`.
    void remember_ports();

    void latched(const System& system) override;

private:
    struct Followed {
        Channel channel;
        Series series{};
        double since = 0;  // [s] when it began to be remembered; 0: as long as the system has had it
        bool remembered = false;
        bool kept = false;  // a reader has it, whether the system has it or not
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
