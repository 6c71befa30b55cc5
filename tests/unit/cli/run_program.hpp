// Runs the real executable, as a person or a script would, and keeps what it said.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nezumi {

/// Where the executable of this build lies: beside the test that runs.
inline std::string nezumi_program() {
    std::string path(4096, '\0');
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size());
    path.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return path.substr(0, path.rfind('/') + 1) + "nezumi";
}

/// Waits for the end of a child, which is -1 then, for at most so many seconds. Returns its exit status, or minus the
/// signal that ended it; nothing when it goes on.
inline std::optional<int> end_within(pid_t& child, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > end) return std::nullopt;
        usleep(5000);
    }
    child = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Files in place of the pipes that take what a program says: "" closes it from the beginning.
struct ProgramFiles {
    std::optional<std::string> out{};
    std::optional<std::string> error{};
};

/// A program that runs, with its standard output and error in pipes and a file, or nothing, as standard input.
class Program {
public:
    explicit Program(std::vector<std::string> words, const std::string& folder = "", const std::string& input = "",
                     const ProgramFiles& files = {}) {
        words.insert(words.begin(), nezumi_program());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        int out_pipe[2];
        int error_pipe[2];
        if (pipe(out_pipe) != 0 || pipe(error_pipe) != 0) return;
        child_ = fork();
        if (child_ == 0) {
            // From here to exec only what may follow a fork.
            if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(126);
            close(STDIN_FILENO);
            if (!input.empty() && open(input.c_str(), O_RDONLY) != STDIN_FILENO) _exit(126);
            dup2(out_pipe[1], STDOUT_FILENO);
            dup2(error_pipe[1], STDERR_FILENO);
            for (const int fd : {out_pipe[0], out_pipe[1], error_pipe[0], error_pipe[1]}) close(fd);
            if (files.out) redirect(STDOUT_FILENO, *files.out);
            if (files.error) redirect(STDERR_FILENO, *files.error);
            execv(pointers[0], pointers.data());
            _exit(127);
        }
        close(out_pipe[1]);
        close(error_pipe[1]);
        files_[0] = out_pipe[0];
        files_[1] = error_pipe[0];
    }
    ~Program() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
        for (const int fd : files_) {
            if (fd >= 0) close(fd);
        }
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) const { kill(child_, signal); }
    pid_t process() const { return child_; }

    /// Waits until `text` has been said on standard error; false when the program ends or `seconds` pass before.
    bool wait_for_error(const std::string& text, double seconds = 30) { return wait_for(error, text, seconds); }
    /// The same for standard output.
    bool wait_for_output(const std::string& text, double seconds = 30) { return wait_for(out, text, seconds); }

    /// Waits for the end. Returns the exit status, or minus the signal that ended it.
    int wait() {
        while (read_some(1000)) {
        }
        int status = 0;
        waitpid(std::exchange(child_, -1), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    /// The same for at most so many seconds, and nothing is taken of what it says; nothing when it goes on.
    std::optional<int> wait_unread(double seconds) { return end_within(child_, seconds); }
    /// Takes what it says for so long.
    void listen(double seconds) { wait_for_error("\xff", seconds); }

    std::string out;    ///< what it has said so far
    std::string error;  ///< on standard error

private:
    bool wait_for(const std::string& said, const std::string& text, double seconds) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (said.find(text) == std::string::npos) {
            if (std::chrono::steady_clock::now() > end || !read_some(100)) return said.find(text) != std::string::npos;
        }
        return true;
    }

    static void redirect(int fd, const std::string& file) {
        close(fd);
        if (file.empty()) return;
        const int opened = open(file.c_str(), O_WRONLY);
        if (opened < 0 || dup2(opened, fd) < 0) _exit(126);
        if (opened != fd) close(opened);
    }

    // Takes what there is, after at most so long; false when both ends are closed.
    bool read_some(int milliseconds) {
        pollfd polled[2] = {{files_[0], POLLIN, 0}, {files_[1], POLLIN, 0}};
        poll(polled, 2, milliseconds);
        for (int i = 0; i < 2; ++i) {
            if (files_[i] < 0 || polled[i].revents == 0) continue;
            char buffer[65536];
            const ssize_t count = read(files_[i], buffer, sizeof buffer);
            if (count > 0) {
                (i == 0 ? out : error).append(buffer, static_cast<std::size_t>(count));
            } else {
                close(std::exchange(files_[i], -1));
            }
        }
        return files_[0] >= 0 || files_[1] >= 0;
    }

    pid_t child_ = -1;
    int files_[2] = {-1, -1};
};

/// What a program has said and how it ended.
struct Outcome {
    int status = 0;     ///< exit status, or minus the signal that ended it
    std::string out;    ///< standard output
    std::string error;  ///< standard error
};

/// Runs `nezumi WORDS...` to its end, in `folder` or the tests' own (the project's root), with the file `input` as
/// its standard input.
inline Outcome run_nezumi(std::vector<std::string> words, const std::string& folder = "",
                          const std::string& input = "") {
    Program program(std::move(words), folder, input);
    const int status = program.wait();
    return {status, program.out, program.error};
}

/// The same with its standard output in a file, or closed when that is "".
inline Outcome run_with_output(const std::string& file, std::vector<std::string> words, const std::string& folder = "",
                               const std::string& input = "") {
    Program program(std::move(words), folder, input, {.out = file});
    const int status = program.wait();
    return {status, program.out, program.error};
}

/// The same with its standard error in a file, or closed when that is "".
inline Outcome run_with_error(const std::string& file, std::vector<std::string> words, const std::string& folder = "",
                              const std::string& input = "") {
    Program program(std::move(words), folder, input, {.error = file});
    const int status = program.wait();
    return {status, program.out, program.error};
}

}  // namespace nezumi
