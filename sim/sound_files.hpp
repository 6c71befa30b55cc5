// The sounds of simulated robots as WAV files: tones are computed, speech comes from espeak-ng.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/world/sound.hpp"

namespace nezumi::sim {

/// Writes `ROBOT-0001.wav`, `ROBOT-0002.wav`, ... into a folder, and the text of each speech as `ROBOT-0001.txt`. Works
/// on its own thread, which starts with the first sound. Only the destructor waits for the remaining files.
class SoundFiles {
public:
    using Warn = std::function<void(const std::string&)>;
    static constexpr std::size_t most_waiting = 64;  ///< longest queue; further sounds are dropped

    /// The folder must exist. `speaker` is a program that turns standard input into speech as espeak-ng does. `warn` is
    /// called only within `play`, `tell` and the destructor.
    SoundFiles(std::filesystem::path folder, Warn warn, std::string speaker = "espeak-ng");
    SoundFiles(const SoundFiles&) = delete;
    SoundFiles& operator=(const SoundFiles&) = delete;
    ~SoundFiles();

    void play(const std::string& robot, const Sound& sound);
    /// Reports the errors since the last call.
    void tell();

private:
    struct Job {
        std::string stem;  // of the file's name
        Sound sound;
    };

    void serve();
    void write(const Job& job);
    void speak(const std::string& text, const std::filesystem::path& file);
    void complain(std::string why);

    std::filesystem::path folder_;
    Warn warn_;
    std::string speaker_;
    std::map<std::string, int> counts_;  // number of sounds, by robot
    bool has_looked_for_speaker_ = false;
    bool can_speak_ = false;

    Mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    std::vector<std::string> complaints_;
    bool quit_ = false;
    std::thread thread_;
};

}  // namespace nezumi::sim
