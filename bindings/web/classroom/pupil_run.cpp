// A thread waits for the end of the process. The process ends itself when our end of the socket closes, so no process
// is left behind.
#include "bindings/web/classroom/pupil_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi::web {

PupilRun::PupilRun(std::vector<std::string> words) {
    std::array<int, 2> ends{-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        has_ended_ = true;
        return;
    }
    socket_ = Descriptor(ends[0]);
    Descriptor theirs(ends[1]);
    fcntl(errors_.file(), F_SETFL, O_APPEND);
    try {
        thread_ = start_thread([this, words = std::move(words), theirs = theirs.get()] {
            const Descriptor closes(theirs);
            const auto end = run_program({.words = words,
                                          .input = theirs,
                                          .errors = errors_.file(),
                                          .longest = std::numeric_limits<double>::infinity(),
                                          .give_up = &give_up_,
                                          .process = &process_});
            if (end) status_ = end->status;
            has_ended_ = true;
        });
        theirs.release();
    } catch (const std::system_error&) {
        has_ended_ = true;
    }
}

PupilRun::~PupilRun() {
    end();
    const auto until = asked_.value_or(begin_) + longest_end;  // counted from `end`: many end in parallel
    while (!has_ended_ && Clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    give_up_ = true;
    if (thread_.joinable()) thread_.join();
}

void PupilRun::end() {
    if (!asked_) asked_ = Clock::now();
    if (socket_) shutdown(socket_.get(), SHUT_RDWR);
}

void PupilRun::hurry(Clock::time_point now) {
    if (asked_ && now - *asked_ > longest_end) give_up_ = true;
}

std::string PupilRun::said() const { return errors_.text(longest_said); }

std::size_t PupilRun::memory() const {
    std::ifstream file(fmt::format("/proc/{}/statm", process_.load()));
    std::size_t all = 0, resident = 0;
    if (!(file >> all >> resident)) return 0;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace nezumi::web
