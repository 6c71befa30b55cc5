// The thread that writes sounds; text goes to the speaker's standard input, never through a shell.
#include "sim/sound_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <string_view>
#include <utility>

#include "engine/base/whole_file.hpp"

namespace nezumi::sim {
namespace {

constexpr int samples_a_second = 22'050;
constexpr double loudness = 0.3;  // of what 16 bits hold
constexpr double swell = 0.005;   // [s]
constexpr auto longest_synthesis = std::chrono::seconds(20);

// Appends the lowest bytes of a number, the lowest first.
void append(std::string& bytes, std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffu);
}

bool is_program(const std::filesystem::path& file) {
    std::error_code none;
    return access(file.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(file, none);
}

// Whether a program of this name could be run, as execvp looks for it.
bool can_run(const std::string& program) {
    if (program.find('/') != std::string::npos) return is_program(program);
    const char* path = std::getenv("PATH");
    std::string_view folders = path != nullptr ? path : "/usr/bin:/bin";
    while (true) {
        const auto colon = std::min(folders.find(':'), folders.size());
        const std::string folder(folders.substr(0, colon));
        if (is_program(std::filesystem::path(folder.empty() ? "." : folder) / program)) return true;
        if (colon == folders.size()) return false;
        folders.remove_prefix(colon + 1);
    }
}

// A file without a name that holds this text. A pipe would block while nobody reads and signal when nobody does.
int open_text(const std::string& text) {
    const int file = memfd_create("speech", MFD_CLOEXEC);
    if (file < 0) return -1;
    std::string_view rest = text;
    while (!rest.empty()) {
        const ssize_t written = ::write(file, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) break;
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(file, 0, SEEK_SET);
    return file;
}

// Runs a program without arguments' being looked at by a shell; "" when it did its work, else what went wrong.
std::string run_program(std::vector<std::string> words, int input) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // Ctrl-C is for nezumi, which lets the program finish.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int error = posix_spawnp(&child, pointers[0], &files, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) return std::strerror(error);

    const auto give_up = std::chrono::steady_clock::now() + longest_synthesis;
    int status = 0;
    for (auto nap = std::chrono::milliseconds(1);; nap = std::min(2 * nap, std::chrono::milliseconds(20))) {
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) break;
        if (ended < 0 && errno != EINTR) return std::strerror(errno);
        if (std::chrono::steady_clock::now() > give_up) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return fmt::format("it took more than {} s", longest_synthesis.count());
        }
        std::this_thread::sleep_for(nap);
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    return WIFEXITED(status) ? fmt::format("it ended with status {}", WEXITSTATUS(status))
                             : fmt::format("signal {} ended it", WTERMSIG(status));
}

}  // namespace

std::string tone_as_wav(double hertz, double seconds) {
    const auto count = static_cast<std::uint32_t>(std::lround(std::max(0.0, seconds) * samples_a_second));
    std::string bytes = "RIFF";
    append(bytes, 36 + 2 * count, 4);
    bytes += "WAVEfmt ";
    append(bytes, 16, 4);
    append(bytes, 1, 2);  // plain samples
    append(bytes, 1, 2);  // mono
    append(bytes, samples_a_second, 4);
    append(bytes, 2 * samples_a_second, 4);  // bytes a second
    append(bytes, 2, 2);                     // bytes a sample
    append(bytes, 16, 2);                    // bits a sample
    bytes += "data";
    append(bytes, 2 * count, 4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double at = static_cast<double>(i) / samples_a_second;
        const double left = static_cast<double>(count - i) / samples_a_second;
        const double level = loudness * std::min({1.0, at / swell, left / swell});
        const double sample = hertz > 0 ? level * std::sin(2 * std::numbers::pi * hertz * at) : 0;
        append(bytes, static_cast<std::uint32_t>(std::lround(sample * 32767)), 2);
    }
    return bytes;
}

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
            complaints_.emplace_back("sounds come faster than they can be written: some are left out");
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
    std::unique_lock lock(mutex_);
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
    const int input = open_text(text);
    if (input < 0) {
        complain(fmt::format("{}: {}", speaker_, std::strerror(errno)));
        return;
    }
    // -b 1: the text is UTF-8.
    const std::string problem = run_program({speaker_, "-b", "1", "--stdin", "-w", file.string()}, input);
    close(input);
    if (!problem.empty()) complain(fmt::format("{} did not write '{}': {}", speaker_, file.string(), problem));
}

}  // namespace nezumi::sim
