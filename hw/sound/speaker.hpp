// A robot's loudspeaker: tones by ALSA's player, speech by espeak-ng, one after the other beside the loop.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/sound.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"

namespace nezumi::hw {

/// A job. Both programs are run without a shell, and get what they are for as their input. Where one is missing it is
/// told once, and the robot is silent.
class Speaker final : public DeviceJob {
public:
    /// `device` as ALSA calls it ("plughw:1"); "": its default.
    explicit Speaker(std::string device = "") : device_(std::move(device)) {}

    /// Sounds that may wait; what comes while so many do is left out.
    static constexpr std::size_t most_waiting = 16;

    /// From the control loop: plays it after those that came before.
    void play(const Sound& sound);
    /// From any thread: what plays ends at once, and what waits is left out.
    void silence();
    /// The same, and nothing is played any more.
    void silence_for_good();
    std::vector<std::string> take_faults();

    double run() override;

private:
    std::string synthesize(const std::string& text, int output);
    std::string play_wav(int wav);

    const std::string device_;
    Health player_health_{"loudspeaker"}, speech_health_{"speech"}, queue_health_{"loudspeaker"};
    std::atomic<bool> is_silenced_ = false, has_ended_ = false;
    Mutex mutex_;  // held for a copy at most
    std::deque<Sound> waiting_;
};

/// The loudspeaker of a robot, with its thread: that begins with the first sound.
class Loudspeaker {
public:
    /// Its device is the `port` of the spec's first speaker.
    explicit Loudspeaker(const RobotSpec& spec);
    /// What plays ends.
    ~Loudspeaker();
    Loudspeaker(const Loudspeaker&) = delete;
    Loudspeaker& operator=(const Loudspeaker&) = delete;

    void play(const Sound& sound);
    /// What plays ends, and what waits is left out.
    void silence();
    std::vector<std::string> take_faults();

private:
    const std::string device_;
    std::optional<RunningJob<Speaker>> speaker_;  // none before the first sound
};

}  // namespace nezumi::hw
