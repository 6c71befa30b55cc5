// Writes a file in a separate thread, so that a slow disk or a pipe without a reader delays no tick.
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
    /// Takes ownership of an open file. If more than `most_waiting` bytes already wait, the next text ends the writing
    /// (ENOBUFS).
    explicit FileWriter(int file, std::size_t most_waiting = std::size_t{64} << 20);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    /// Adds a text to the end of the queue and returns at once. After an error nothing is written.
    void put(std::string text);
    /// Like `put`, for a text of about `bytes` that takes long to make: the writing thread calls `make`.
    void put(std::size_t bytes, std::function<std::string()> make);
    /// Writes a text over everything that `put` wrote since the previous `put_over`. The file must be on a disk.
    void put_over(std::size_t bytes, std::function<std::string()> make);
    /// Whether more bytes than half of `most_waiting` wait. Then callers that can wait should do so.
    bool is_behind() const { return waiting_bytes_ > most_waiting_ / 2; }
    /// The error that ended the writing (an errno); 0 if there is none. ENOBUFS: too much waited; ECANCELED: the
    /// writing was given up.
    int problem() const;
    /// The position [bytes] of the start of the last text that was written completely.
    std::uint64_t last_whole_piece() const;
    /// The number of bytes at the start of the file that were written completely.
    std::uint64_t whole() const;
    /// Drops everything that is not written yet, so that `close` returns soon. Can be called from any thread.
    void give_up() { given_up_ = true; }
    bool is_given_up() const { return given_up_; }
    /// Waits until everything is written, and closes the file. Gives up after `patience`. Returns the error, or 0. Call
    /// it once.
    int close(std::chrono::milliseconds patience = forever);
    static constexpr std::chrono::milliseconds forever = std::chrono::hours(24 * 365);

private:
    struct Piece {
        std::size_t bytes;
        std::function<std::string()> make;
        bool goes_over = false;  // a piece of `put_over`
    };

    void put(Piece piece);
    void run();
    int write(std::string_view text) const;
    int write_over(std::string_view text) const;

    mutable Mutex mutex_;           // protects all members below except file_ and the atomic ones
    std::condition_variable news_;  // notifies the writing thread
    std::condition_variable end_;   // notifies `close` that the thread has ended
    std::deque<Piece> waiting_;
    std::atomic<std::size_t> waiting_bytes_ = 0;
    const std::size_t most_waiting_;
    int file_;
    std::uint64_t written_ = 0;           // [bytes] of complete pieces
    std::uint64_t last_whole_piece_ = 0;  // [bytes] the start of the last complete piece
    std::uint64_t kept_ = 0;              // [bytes] up to the end of the last piece of `put_over`
    int problem_ = 0;
    bool ends_ = false;
    bool ended_ = false;
    std::atomic<bool> given_up_ = false;
    std::thread thread_;
};

/// The message about an error that ended the writing: "No space left on device".
std::string why_not_written(int problem);

}  // namespace nezumi
