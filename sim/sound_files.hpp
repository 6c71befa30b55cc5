// What simulated robots say, as WAV files: tones are computed, speech comes from espeak-ng.
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

/// Writes `ROBOT-0001.wav`, `ROBOT-0002.wav`, ... into a folder, and beside each speech its text as `ROBOT-0001.txt`.
/// Works on a thread of its own, which begins with the first sound; nobody waits for it but the destructor, which lets
/// it write what is left.
class SoundFiles {
public:
    using Warn = std::function<void(const std::string&)>;
    static constexpr std::size_t most_waiting = 64;  ///< sounds; what comes while so many wait is left out

    /// The folder must exist. `speaker` is the program that turns standard input into speech as espeak-ng does.
    /// `warn` is called in `play`, `tell` and the destructor only.
    SoundFiles(std::filesystem::path folder, Warn warn, std::string speaker = "espeak-ng");
    SoundFiles(const SoundFiles&) = delete;
    SoundFiles& operator=(const SoundFiles&) = delete;
    ~SoundFiles();

    void play(const std::string& robot, const Sound& sound);
    /// Tells what went wrong meanwhile.
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
    std::map<std::string, int> counts_;  // of sounds, by robot
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
