// A robot's loudspeaker: tones by ALSA's player, speech by espeak-ng, one after the other on its own thread.
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

/// The job of playing sounds. The player and the speech program run without a shell and read their standard input. If a
/// program is missing, this is reported once, and its sounds are not played.
class Speaker final : public DeviceJob {
public:
    /// `device`: ALSA's name ("plughw:1"); "" is ALSA's default.
    explicit Speaker(std::string device = "") : device_(std::move(device)) {}

    /// Longest queue; further sounds are dropped.
    static constexpr std::size_t most_waiting = 16;

    /// Called by the control loop: plays the sound after the earlier ones.
    void play(const Sound& sound);
    /// Ends the present sound and drops the waiting ones. Any thread may call it.
    void silence();
    /// Silences the speaker for ever: no further sound is played.
    void silence_for_good();
    std::vector<std::string> take_faults();

    double run() override;

private:
    std::string synthesize(const std::string& text, int output);
    std::string play_wav(int wav);

    const std::string device_;
    Health player_health_{"loudspeaker"}, speech_health_{"speech"}, queue_health_{"loudspeaker"};
    std::atomic<bool> is_silenced_ = false, has_ended_ = false;
    Mutex mutex_;  // held only for a copy
    std::deque<Sound> waiting_;
};

/// The loudspeaker of a robot with its thread, which starts with the first sound.
class Loudspeaker {
public:
    /// Uses the `port` of the spec's first speaker as ALSA's device.
    explicit Loudspeaker(const RobotSpec& spec);
    /// Ends the present sound.
    ~Loudspeaker();
    Loudspeaker(const Loudspeaker&) = delete;
    Loudspeaker& operator=(const Loudspeaker&) = delete;

    void play(const Sound& sound);
    /// Ends the present sound and drops the waiting ones.
    void silence();
    std::vector<std::string> take_faults();

private:
    const std::string device_;
    std::optional<RunningJob<Speaker>> speaker_;  // none before the first sound
};

}  // namespace nezumi::hw
