// One producer, one thread that writes, a queue between them.
#include "engine/base/file_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "engine/base/thread.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {

FileWriter::FileWriter(int file, std::size_t most_waiting) : most_waiting_(most_waiting), file_(file) {
    // Signals are for the thread that runs the loop: they end its waiting.
    thread_ = start_thread([this] { run(); });
}

FileWriter::~FileWriter() { close(); }

void FileWriter::put(std::string text) {
    if (text.empty()) return;
    const std::size_t bytes = text.size();
    put(bytes, [text = std::move(text)]() mutable { return std::move(text); });
}

void FileWriter::put(std::size_t bytes, std::function<std::string()> make) {
    {
        Lock lock(mutex_);
        space_.wait(lock, [this] { return waiting_bytes_ <= most_waiting_ || problem_ != 0; });
        if (problem_ != 0) return;
        waiting_bytes_ += bytes;
        waiting_.push_back({bytes, std::move(make)});
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

int FileWriter::close() {
    if (file_ < 0) return problem();
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    news_.notify_one();
    thread_.join();
    if (::close(std::exchange(file_, -1)) != 0 && problem_ == 0) problem_ = errno;
    return problem_;
}

void FileWriter::run() {
    Lock lock(mutex_);
    for (;;) {
        news_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Piece piece = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        const std::string text = piece.make();
        const int problem = write_all(file_, text);
        lock.lock();
        waiting_bytes_ -= piece.bytes;
        if (problem == 0) {
            last_whole_piece_ = std::exchange(written_, written_ + text.size());
        } else {
            problem_ = problem;
            waiting_.clear();
            waiting_bytes_ = 0;
        }
        space_.notify_one();
    }
}

}  // namespace nezumi
