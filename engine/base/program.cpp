// Runs programs by posix_spawn with a time limit.
#include "engine/base/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>

namespace nezumi {
namespace {

bool is_program(const std::filesystem::path& file) {
    std::error_code none;
    return access(file.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(file, none);
}

}  // namespace

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

UnnamedFile::UnnamedFile(std::string_view text) : file_(memfd_create("nezumi", MFD_CLOEXEC)) {
    while (file_ >= 0 && !text.empty()) {
        const ssize_t written = ::write(file_, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) break;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    rewind();
}

UnnamedFile::~UnnamedFile() {
    if (file_ >= 0) close(file_);
}

void UnnamedFile::rewind() const {
    if (file_ >= 0) lseek(file_, 0, SEEK_SET);
}

std::string UnnamedFile::text(std::size_t most) const {
    std::string text;
    std::array<char, 4096> buffer{};
    struct stat status {};
    const std::size_t size = fstat(file_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
    const std::size_t begin = size - std::min(size, most);
    for (;;) {
        const ssize_t length =
            file_ < 0 ? 0 : pread(file_, buffer.data(), buffer.size(), static_cast<off_t>(begin + text.size()));
        if (length < 0 && errno == EINTR) continue;
        if (length <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(length));
    }
}

namespace {

// Starts the program. Returns its process, or an errno.
tl::expected<pid_t, int> start(const ProgramRun& run, int output) {
    std::vector<std::string> words = run.words;
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto give = [&](int file, int as, int flags) {
        if (file >= 0)
            posix_spawn_file_actions_adddup2(&files, file, as);
        else if (file == no_file)
            posix_spawn_file_actions_addopen(&files, as, "/dev/null", flags, 0);
    };
    give(run.input, STDIN_FILENO, O_RDONLY);
    give(output, STDOUT_FILENO, O_WRONLY);
    give(run.errors, STDERR_FILENO, O_WRONLY);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // Ctrl-C must reach only nezumi, which lets the program finish. Our threads block signals; the program must not.
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    const int group = run.is_in_front ? 0 : POSIX_SPAWN_SETPGROUP;
    posix_spawnattr_setflags(&attributes, static_cast<short>(POSIX_SPAWN_SETSIGMASK | group));
    pid_t child = 0;
    const int error = posix_spawnp(&child, pointers[0], &files, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) return tl::unexpected(error);
    return child;
}

// Waits for the end of a process that was started.
Expected<ProgramEnd> wait_for(pid_t child, const ProgramRun& run) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const auto give_up = [&] { return run.give_up != nullptr && *run.give_up; };
    const auto is_too_long = [&] { return std::chrono::duration<double>(Clock::now() - begin).count() > run.longest; };
    int status = 0;
    for (auto nap = std::chrono::milliseconds(1);; nap = std::min(2 * nap, std::chrono::milliseconds(20))) {
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) break;
        if (ended < 0 && errno != EINTR) return failure(std::strerror(errno));
        if (give_up() || is_too_long()) {
            kill(run.is_in_front ? child : -child, SIGKILL);  // including its child processes
            waitpid(child, &status, 0);
            return failure(give_up() ? "it was stopped early" : fmt::format("it took more than {} s", run.longest));
        }
        std::this_thread::sleep_for(nap);
    }
    ProgramEnd end{.signal = WIFEXITED(status) ? 0 : WTERMSIG(status)};
    end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + end.signal;
    return end;
}

}  // namespace

Expected<ProgramEnd> run_program(const ProgramRun& run) {
    std::optional<UnnamedFile> kept;
    if (run.keeps_output) kept.emplace();
    const auto child = start(run, kept ? kept->file() : run.output);
    if (!child) return failure(std::strerror(child.error()));
    if (run.process != nullptr) *run.process = *child;
    auto end = wait_for(*child, run);
    if (run.process != nullptr) *run.process = 0;
    if (end && kept) end->out = kept->text();
    return end;
}

std::string problem_of(const Expected<ProgramEnd>& end) {
    if (!end) return end.error().message;
    if (end->signal != 0) return fmt::format("signal {} ended it", end->signal);
    return end->status == 0 ? "" : fmt::format("it ended with status {}", end->status);
}

}  // namespace nezumi
