// The thread that writes sound files. Text goes to the speaker's standard input, never through a shell.
#include "sim/sound_files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/program.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/world/tone.hpp"

namespace nezumi::sim {

SoundFiles::SoundFiles(std::filesystem::path folder, Warn warn, std::string speaker)
    : folder_(std::move(folder)), warn_(std::move(warn)), speaker_(std::move(speaker)) {}

SoundFiles::~SoundFiles() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
    tell();
}

void SoundFiles::play(const std::string& robot, const Sound& sound) {
    if (sound.kind == Sound::Kind::speech && !std::exchange(has_looked_for_speaker_, true)) {
        can_speak_ = can_run(speaker_);
        if (!can_speak_) {
            warn_(fmt::format("{} is not installed: speech becomes text files only (sudo apt install espeak-ng)",
                              speaker_));
        }
    }
    const std::string stem = fmt::format("{}-{:04}", robot, ++counts_[robot]);
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() >= most_waiting) {
            complaints_.emplace_back("sounds come faster than they can be written: some are dropped");
            return;
        }
        waiting_.push_back({stem, sound});
        if (!thread_.joinable()) thread_ = std::thread([this] { serve(); });
    }
    changed_.notify_all();
}

void SoundFiles::tell() {
    std::vector<std::string> complaints;
    {
        const std::lock_guard lock(mutex_);
        complaints.swap(complaints_);
    }
    for (const std::string& complaint : complaints) warn_(complaint);
}

void SoundFiles::complain(std::string why) {
    const std::lock_guard lock(mutex_);
    complaints_.push_back(std::move(why));
}

void SoundFiles::serve() {
    Lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return quit_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Job job = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        write(job);
        lock.lock();
    }
}

void SoundFiles::write(const Job& job) {
    const std::filesystem::path wav = folder_ / (job.stem + ".wav");
    if (job.sound.kind == Sound::Kind::tone) {
        if (!write_whole(wav, tone_as_wav(job.sound.hertz, job.sound.seconds)))
            complain(fmt::format("'{}' can't be written", wav.string()));
        return;
    }
    const std::filesystem::path text = folder_ / (job.stem + ".txt");
    if (!write_whole(text, job.sound.text)) complain(fmt::format("'{}' can't be written", text.string()));
    if (can_speak_) speak(job.sound.text, wav);
}

void SoundFiles::speak(const std::string& text, const std::filesystem::path& file) {
    const UnnamedFile input(text);
    if (input.file() < 0) {
        complain(fmt::format("{}: {}", speaker_, std::strerror(errno)));
        return;
    }
    // -b 1: the text is UTF-8.
    const std::string problem = problem_of(
        run_program({.words = {speaker_, "-b", "1", "--stdin", "-w", file.string()}, .input = input.file()}));
    if (!problem.empty()) complain(fmt::format("{} did not write '{}': {}", speaker_, file.string(), problem));
}

}  // namespace nezumi::sim
