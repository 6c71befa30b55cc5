// What a system carried: the one place that recordings, plots and goldens read, fed when the ports of a tick have
// latched.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "engine/trace/channel.hpp"
#include "engine/trace/series.hpp"

namespace nezumi {

/// Follows channels of a system, and of those that take its place. A port that nobody follows costs nothing. Whoever
/// wants every message reads the channels once a tick, after it; the numbers of what is remembered stay for a while.
class Trace final : public PortObserver {
public:
    /// A system with more ports is remembered only where somebody asks.
    static constexpr std::size_t most_ports = 400;

    /// From now on its channels are those of this system, which is at its start and which this must outlive. What is
    /// followed stays so, what is remembered is forgotten: it belongs to another time.
    void start(System& system);

    /// The channel of this name, followed from now on. It lives as long as this. An error says what is not there.
    Expected<const Channel*> follow(std::string_view name);
    /// How many are followed.
    std::size_t followed() const { return followed_.size(); }
    /// Keeps its numbers from now on as well. The series lives as long as the system has the channel.
    Expected<const Series*> remember(std::string_view name);
    /// What it has of this name, which may be a part of a port ("controller.out.vx") that is remembered as a whole.
    struct Remembered {
        const Series* series;
        std::string whole;   ///< of what the series is: "controller.out"
        std::string part;    ///< labels within this are meant; "" for all
        bool holds = false;  ///< as `Channel::holds`
    };
    Expected<Remembered> remember_part(std::string_view name);
    /// Does so for every port that carries no pictures, also for those to come, in a system of at most `most_ports`.
    void remember_ports();

    void latched(const System& system) override;

private:
    struct Followed {
        Channel channel;
        Series series{};
        bool remembered = false;
        bool kept = false;  // somebody has it, whether the system does or not
    };

    Expected<Followed*> find(std::string_view name);
    void follow_layout();

    System* system_ = nullptr;
    std::uint64_t layout_ = 0;  // of the system when the channels were resolved
    bool remembers_ports_ = false;
    std::map<std::string, Followed, std::less<>> followed_;  // by name
};

}  // namespace nezumi
