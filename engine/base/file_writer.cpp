// A queue between one producer and one writing thread. Files that are not on a disk are written without blocking,
// because they may never accept data and the thread must still end.
#include "engine/base/file_writer.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi {
namespace {

// [bytes] per write. The writing can be given up only between two writes.
constexpr std::size_t portion = std::size_t{1} << 18;
// Time [ms] to wait for a pipe before the next check.
constexpr int glance = 20;

}  // namespace

FileWriter::FileWriter(int file, std::size_t most_waiting) : most_waiting_(most_waiting), file_(file) {
    struct stat status {};
    if (fstat(file_, &status) == 0 && !S_ISREG(status.st_mode))
        fcntl(file_, F_SETFL, fcntl(file_, F_GETFL) | O_NONBLOCK);
    // The writing thread blocks signals: they must reach the thread of the tick loop, because they end its waiting.
    thread_ = start_thread([this] { run(); });
}

FileWriter::~FileWriter() { close(); }

void FileWriter::put(std::string text) {
    if (text.empty()) return;
    const std::size_t bytes = text.size();
    put(bytes, [text = std::move(text)]() mutable { return std::move(text); });
}

void FileWriter::put(std::size_t bytes, std::function<std::string()> make) { put(Piece{bytes, std::move(make)}); }

void FileWriter::put_over(std::size_t bytes, std::function<std::string()> make) {
    put(Piece{bytes, std::move(make), true});
}

void FileWriter::put(Piece piece) {
    {
        const std::lock_guard lock(mutex_);
        if (problem_ == 0 && waiting_bytes_ > most_waiting_) {
            problem_ = ENOBUFS;
            give_up();
        }
        if (problem_ != 0) return;
        waiting_bytes_ += piece.bytes;
        waiting_.push_back(std::move(piece));
    }
    news_.notify_one();
}

int FileWriter::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

std::uint64_t FileWriter::last_whole_piece() const {
    const std::lock_guard lock(mutex_);
    return last_whole_piece_;
}

std::uint64_t FileWriter::whole() const {
    const std::lock_guard lock(mutex_);
    return written_;
}

int FileWriter::close(std::chrono::milliseconds patience) {
    if (file_ < 0) return problem();
    {
        Lock lock(mutex_);
        ends_ = true;
        news_.notify_one();
        if (!end_.wait_for(lock, patience, [this] { return ended_; })) give_up();
    }
    thread_.join();
    if (::close(std::exchange(file_, -1)) != 0 && problem_ == 0) problem_ = errno;
    return problem_;
}

// Returns 0 when everything is written, or an errno.
int FileWriter::write(std::string_view text) const {
    while (!text.empty()) {
        if (given_up_) return ECANCELED;
        const ssize_t written = ::write(file_, text.data(), std::min(text.size(), portion));
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
        if (written >= 0 || errno == EINTR) continue;
        if (errno != EAGAIN) return errno;
        pollfd full{.fd = file_, .events = POLLOUT, .revents = 0};
        poll(&full, 1, glance);
    }
    return 0;
}

// Writes a text at the position `kept_` and removes everything after the text.
int FileWriter::write_over(std::string_view text) const {
    const auto at = static_cast<off_t>(kept_);
    if (lseek(file_, at, SEEK_SET) < 0) return errno;
    if (const int problem = write(text); problem != 0) return problem;
    return ftruncate(file_, at + static_cast<off_t>(text.size())) == 0 ? 0 : errno;
}

void FileWriter::run() {
    Lock lock(mutex_);
    for (;;) {
        news_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
        if (waiting_.empty()) break;
        const Piece piece = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        const std::string text = piece.make();
        const int problem = piece.goes_over ? write_over(text) : write(text);
        lock.lock();
        waiting_bytes_ -= piece.bytes;
        if (piece.goes_over) written_ = kept_;
        if (problem == 0) {
            last_whole_piece_ = std::exchange(written_, written_ + text.size());
            if (piece.goes_over) kept_ = written_;
        } else if (problem_ == 0) {
            problem_ = problem;
        }
        if (problem_ != 0) {
            waiting_.clear();
            waiting_bytes_ = 0;
        }
    }
    ended_ = true;
    end_.notify_all();
}

std::string why_not_written(int problem) {
    if (problem == ENOBUFS) return "it accepts data too slowly, and too much is waiting";
    if (problem == ECANCELED) return "it did not accept all data in time";
    return std::strerror(problem);
}

}  // namespace nezumi
