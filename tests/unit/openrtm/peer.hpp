// A program of its own that is told lines and says lines: an RTC, or a name service.
#pragma once

#include <poll.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nezumi {

class Peer {
public:
    explicit Peer(std::vector<std::string> words) {
        std::signal(SIGPIPE, SIG_IGN);  // one that was killed takes nothing more
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        int to[2];
        int from[2];
        if (pipe(to) != 0 || pipe(from) != 0) return;
        child_ = fork();
        if (child_ == 0) {
            dup2(to[0], STDIN_FILENO);
            dup2(from[1], STDOUT_FILENO);
            dup2(from[1], STDERR_FILENO);
            for (const int fd : {to[0], to[1], from[0], from[1]}) close(fd);
            execvp(pointers[0], pointers.data());
            _exit(127);
        }
        close(to[0]);
        close(from[1]);
        to_ = to[1];
        from_ = from[0];
    }
    ~Peer() {
        kill();
        for (const int fd : {to_, from_}) {
            if (fd >= 0) close(fd);
        }
    }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void say(const std::string& line) const {
        const std::string whole = line + "\n";
        if (write(to_, whole.data(), whole.size()) < 0) return;  // it is gone: nothing will be heard
    }
    /// Waits for the next line that begins so, and returns it; "" when none comes. `meanwhile` is called again and
    /// again.
    std::string heard(const std::string& begin, const std::function<void()>& meanwhile = {}, double seconds = 60) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end) {
            const std::size_t line_end = text_.find('\n', at_);
            if (line_end != std::string::npos) {
                const std::string line = text_.substr(at_, line_end - at_);
                at_ = line_end + 1;
                if (line.starts_with(begin)) return line;
                continue;
            }
            if (meanwhile) meanwhile();
            read_some(5);
        }
        return "";
    }
    /// All that it has said.
    const std::string& text() {
        while (read_some(0)) {
        }
        return text_;
    }
    /// From now on it does nothing, and is there.
    void halt() const { ::kill(child_, SIGSTOP); }
    void kill() {
        if (child_ <= 0) return;
        ::kill(child_, SIGKILL);
        waitpid(std::exchange(child_, -1), nullptr, 0);
    }

private:
    bool read_some(int milliseconds) {
        pollfd polled{from_, POLLIN, 0};
        if (poll(&polled, 1, milliseconds) <= 0) return false;
        char buffer[65536];
        const ssize_t count = read(from_, buffer, sizeof buffer);
        if (count > 0) text_.append(buffer, static_cast<std::size_t>(count));
        return count > 0;
    }

    pid_t child_ = -1;
    int to_ = -1, from_ = -1;
    std::string text_;
    std::size_t at_ = 0;
};

}  // namespace nezumi
