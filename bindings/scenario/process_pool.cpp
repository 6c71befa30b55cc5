// Uses fork, a pipe for each answer, and poll.
#include "bindings/scenario/process_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace nezumi {
namespace {

struct Running {
    std::size_t task;
    pid_t process;
    int pipe;
    std::string answer;
};

// During its lifetime, SIGINT, SIGTERM and SIGHUP can be read from a file descriptor. If there is no free file
// descriptor, these signals end the program and its children as usual.
class StopSignals {
public:
    StopSignals() {
        sigset_t stops;
        sigemptyset(&stops);
        sigaddset(&stops, SIGINT);
        sigaddset(&stops, SIGTERM);
        if (!is_ignored(SIGHUP)) sigaddset(&stops, SIGHUP);
        sigprocmask(SIG_BLOCK, &stops, &before_);
        file_ = signalfd(-1, &stops, SFD_CLOEXEC | SFD_NONBLOCK);
        if (file_ < 0) restore();
    }
    ~StopSignals() {
        if (file_ >= 0) close(file_);
        restore();
    }
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    int file() const { return file_; }
    // Removes the signals that wait, because they would arrive as soon as they are unblocked.
    void take() const {
        signalfd_siginfo signal{};
        while (read(file_, &signal, sizeof signal) > 0) {
        }
    }
    void restore() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

private:
    // An ignored signal, as with nohup, must not be blocked: it could then be read, and would end the runs.
    static bool is_ignored(int signal) {
        struct sigaction action {};
        return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
    }

    sigset_t before_{};
    int file_ = -1;
};

bool write_all(int file, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t wrote = write(file, bytes.data() + at, bytes.size() - at);
        if (wrote < 0 && errno != EINTR) return false;
        if (wrote > 0) at += static_cast<std::size_t>(wrote);
    }
    return true;
}

[[noreturn]] void be_the_child(const PoolTasks& tasks, std::size_t task, int pipe, const StopSignals& signals) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGPIPE, SIG_DFL);
    signals.restore();
    int status = 0;
    try {
        if (!write_all(pipe, tasks.run(task))) status = 1;
    } catch (const std::exception& error) {
        std::fputs(fmt::format("{}\n", error.what()).c_str(), stderr);
        status = 1;
    }
    _exit(status);  // skips the clean-up of what the parent has begun
}

Expected<Running> start(const PoolTasks& tasks, std::size_t task, const StopSignals& signals) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return failure(fmt::format("can't make a pipe: {}", std::strerror(errno)));
    std::fflush(nullptr);
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        be_the_child(tasks, task, ends[1], signals);
    }
    const int problem = errno;
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return failure(fmt::format("no process could be started: {}", std::strerror(problem)));
    }
    return Running{task, process, ends[0], {}};
}

Expected<std::string> collect(Running& running) {
    close(running.pipe);
    int status = 0;
    while (waitpid(running.process, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) {
        return failure(
            fmt::format("its process was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status))));
    }
    if (WEXITSTATUS(status) != 0) return failure(fmt::format("its process ended with status {}", WEXITSTATUS(status)));
    return std::move(running.answer);
}

// Reads what is available. Returns false at the end of the answer.
bool read_some(Running& running) {
    std::array<char, 65536> buffer{};
    const ssize_t got = read(running.pipe, buffer.data(), buffer.size());
    if (got > 0) running.answer.append(buffer.data(), static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);
}

// Ends a process. Returns its answer if it had finished, else an error.
Expected<std::string> stop(Running& running) {
    kill(running.process, SIGKILL);
    siginfo_t ended{};
    while (waitid(P_PID, static_cast<id_t>(running.process), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    // Reads what is left in the pipe. Does not wait for other processes that may have the pipe open.
    fcntl(running.pipe, F_SETFL, O_NONBLOCK);
    while (read_some(running)) {
    }
    return collect(running);
}

}  // namespace

PoolEnd run_in_processes(const PoolTasks& tasks, std::size_t jobs) {
    const StopSignals signals;
    std::vector<Running> running;
    std::map<std::size_t, Expected<std::string>> done;  // answers that wait for those of earlier tasks
    std::size_t next = 0;
    std::size_t taken = 0;
    std::size_t over = 0;
    const auto tell_progress = [&] {
        ++over;
        if (tasks.progress) tasks.progress(over);
    };
    while (taken < tasks.count) {
        while (running.size() < jobs && next < tasks.count) {
            auto started = start(tasks, next, signals);
            if (started) {
                running.push_back(std::move(*started));
            } else {
                done.emplace(next, Unexpected(started.error()));
                tell_progress();
            }
            ++next;
        }
        if (!running.empty()) {
            std::vector<pollfd> files{{signals.file(), POLLIN, 0}};
            for (const Running& each : running) files.push_back({each.pipe, POLLIN, 0});
            if (poll(files.data(), files.size(), -1) < 0 && errno != EINTR) continue;
            if ((files.front().revents & POLLIN) != 0) {
                signals.take();
                for (Running& each : running) {
                    if (auto answer = stop(each)) done.emplace(each.task, std::move(answer));
                }
                for (auto& [task, answer] : done) tasks.take(task, std::move(answer));
                return PoolEnd::interrupted;
            }
            for (std::size_t i = running.size(); i-- > 0;) {
                if (files[i + 1].revents == 0 || read_some(running[i])) continue;
                done.emplace(running[i].task, collect(running[i]));
                running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
                tell_progress();
            }
        }
        for (auto first = done.find(taken); first != done.end(); first = done.find(taken)) {
            tasks.take(taken, std::move(first->second));
            done.erase(first);
            ++taken;
        }
    }
    return PoolEnd::done;
}

}  // namespace nezumi
