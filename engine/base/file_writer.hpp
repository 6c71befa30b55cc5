// Writes a file on a thread of its own: a disk that is slow, or a pipe that is not read, delays no tick.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <thread>

#include "engine/base/mutex.hpp"

namespace nezumi {

class FileWriter {
public:
    /// Takes over an open file. What is put while more than `most_waiting` bytes wait already ends the writing.
    explicit FileWriter(int file, std::size_t most_waiting = std::size_t{64} << 20);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    /// Writes this after all that was put before, and waits for nothing. After an error nothing is written any more.
    void put(std::string text);
    /// The same for a text of about so many bytes that takes long to be made: its thread makes it.
    void put(std::size_t bytes, std::function<std::string()> make);
    /// More than half of `most_waiting` waits: who can wait with the next one, should.
    bool is_behind() const { return waiting_bytes_ > most_waiting_ / 2; }
    /// The error that ended the writing (an errno), 0 so far: ENOBUFS when too much waited, ECANCELED when it was given
    /// up.
    int problem() const;
    /// Where the last piece that was written whole begins, from the first one on [bytes].
    std::uint64_t last_whole_piece() const;
    /// What is not written yet is not: `close` returns soon. From any thread.
    void give_up() { given_up_ = true; }
    bool is_given_up() const { return given_up_; }
    /// Waits until everything is written, and closes the file; gives up after `patience`. Returns the error, or 0.
    /// Once.
    int close(std::chrono::milliseconds patience = forever);
    static constexpr std::chrono::milliseconds forever = std::chrono::hours(24 * 365);

private:
    struct Piece {
        std::size_t bytes;
        std::function<std::string()> make;
    };

    void run();
    int write(std::string_view text) const;

    mutable Mutex mutex_;           // of all below but file_ and the atomic ones
    std::condition_variable news_;  // for the thread
    std::condition_variable end_;   // of the thread
    std::deque<Piece> waiting_;
    std::atomic<std::size_t> waiting_bytes_ = 0;
    const std::size_t most_waiting_;
    int file_;
    std::uint64_t written_ = 0;           // [bytes] of whole pieces
    std::uint64_t last_whole_piece_ = 0;  // where it begins
    int problem_ = 0;
    bool ends_ = false;
    bool ended_ = false;
    std::atomic<bool> given_up_ = false;
    std::thread thread_;
};

/// What is told of an error that ended the writing: "No space left on device".
std::string why_not_written(int problem);

}  // namespace nezumi
