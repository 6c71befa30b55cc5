// Sounds are written to unnamed WAV files, which are the standard input of ALSA's player.
#include "hw/sound/speaker.hpp"

#include <fmt/format.h>

#include "engine/base/program.hpp"
#include "engine/world/tone.hpp"
#include "hw/device/sampler.hpp"

namespace nezumi::hw {
namespace {

constexpr const char* player = "aplay";
constexpr double longest_sound = 120;  // [s]

// The first installed speech program; "" if there is none.
std::string speech_program() {
    for (const char* program : {"espeak-ng", "espeak"}) {
        if (can_run(program)) return program;
    }
    return "";
}

std::string device_of(const RobotSpec& spec) {
    for (const ActuatorSpec& actuator : spec.actuators) {
        if (actuator.kind == ActuatorSpec::Kind::speaker) return actuator.port;
    }
    return "";
}

}  // namespace

void Speaker::play(const Sound& sound) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < most_waiting) {
        waiting_.push_back(sound);
        queue_health_.works();
    } else {
        queue_health_.lost("sounds come faster than they can be played: some are dropped");
    }
}

void Speaker::silence() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    is_silenced_ = true;
}

void Speaker::silence_for_good() {
    silence();
    has_ended_ = true;
}

std::vector<std::string> Speaker::take_faults() {
    std::vector<std::string> all = queue_health_.take();
    append(all, player_health_.take());
    append(all, speech_health_.take());
    return all;
}

// Speaks `text` into the WAV file `output`. Returns the reason of a failure, or "".
std::string Speaker::synthesize(const std::string& text, int output) {
    const std::string program = speech_program();
    if (program.empty()) return "espeak-ng is not installed: sudo apt install espeak-ng";
    const UnnamedFile input(text);
    // -b 1: the text is UTF-8.
    const std::string problem = problem_of(run_program({.words = {program, "-b", "1", "--stdin", "--stdout"},
                                                        .input = input.file(),
                                                        .output = output,
                                                        .longest = longest_sound,
                                                        .give_up = &is_silenced_}));
    return problem.empty() ? "" : fmt::format("{}: {}", program, problem);
}

std::string Speaker::play_wav(int wav) {
    if (!can_run(player)) return fmt::format("{} is not installed: sudo apt install alsa-utils", player);
    std::vector<std::string> words{player, "-q"};
    if (!device_.empty()) words.insert(words.end(), {"-D", device_});
    const std::string problem =
        problem_of(run_program({.words = words, .input = wav, .longest = longest_sound, .give_up = &is_silenced_}));
    if (problem.empty()) return "";
    return fmt::format("{}: {}: is there a sound card (aplay -l), and is this user in group audio?", player, problem);
}

double Speaker::run() {
    constexpr double idle = 1;  // [s]; a new sound wakes it earlier
    std::optional<Sound> sound;
    {
        const std::lock_guard lock(mutex_);
        if (!waiting_.empty()) {
            sound = std::move(waiting_.front());
            waiting_.pop_front();
            is_silenced_ = has_ended_.load();  // `silence` ends only sounds that were played before it
        }
    }
    if (!sound) return idle;
    const bool is_speech = sound->kind == Sound::Kind::speech;
    const UnnamedFile wav(is_speech ? "" : tone_as_wav(sound->hertz, sound->seconds));
    const auto tell = [this](Health& health, const std::string& problem) {
        if (is_silenced_) return;
        if (problem.empty()) {
            health.works();
        } else {
            health.lost(problem);
        }
    };
    if (is_speech) {
        const std::string problem = synthesize(sound->text, wav.file());
        tell(speech_health_, problem);
        if (!problem.empty() || is_silenced_) return 0;
        wav.rewind();
    }
    tell(player_health_, play_wav(wav.file()));
    return 0;
}

Loudspeaker::Loudspeaker(const RobotSpec& spec) : device_(device_of(spec)) {}

Loudspeaker::~Loudspeaker() {
    if (speaker_) (*speaker_)->silence_for_good();
}

void Loudspeaker::play(const Sound& sound) {
    if (!speaker_) speaker_.emplace(std::make_unique<Speaker>(device_));
    (*speaker_)->play(sound);
    speaker_->wake();
}

void Loudspeaker::silence() {
    if (speaker_) (*speaker_)->silence();
}

std::vector<std::string> Loudspeaker::take_faults() {
    return speaker_ ? (*speaker_)->take_faults() : std::vector<std::string>{};
}

}  // namespace nezumi::hw
