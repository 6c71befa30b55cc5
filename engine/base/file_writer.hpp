// Writes a file on a thread of its own, so that a slow disk delays whoever has something to write by nothing.
#pragma once

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
    /// Takes over an open file. When more than `most_waiting` bytes wait to be written, `put` waits for the disk.
    explicit FileWriter(int file, std::size_t most_waiting = std::size_t{64} << 20);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    /// Writes this after all that was put before. After an error nothing is written any more.
    void put(std::string text);
    /// The same for a text of about so many bytes that takes long to be made: its thread makes it.
    void put(std::size_t bytes, std::function<std::string()> make);
    /// The error that ended the writing (an errno), 0 so far.
    int problem() const;
    /// Where the last piece that was written whole begins, from the first one on [bytes].
    std::uint64_t last_whole_piece() const;
    /// Waits until everything is written, and closes the file. Returns the error, or 0. Once.
    int close();

private:
    void run();

    mutable Mutex mutex_;
    std::condition_variable news_;   // for the thread
    std::condition_variable space_;  // for who puts
    struct Piece {
        std::size_t bytes;
        std::function<std::string()> make;
    };
    std::deque<Piece> waiting_;
    std::size_t waiting_bytes_ = 0;
    const std::size_t most_waiting_;
    int file_;
    std::uint64_t written_ = 0;           // [bytes] of whole pieces
    std::uint64_t last_whole_piece_ = 0;  // where it begins
    int problem_ = 0;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi
