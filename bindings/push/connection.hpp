// The connection between the two sides of a push: a sequence of texts with any bytes, over two file descriptors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::push {

class PushConnection {
public:
    /// `longest_silence` [ms] is how long `take` waits for the next byte; -1: no limit. The descriptors are not closed.
    PushConnection(int from, int to, int longest_silence = -1)
        : from_(from), to_(to), longest_silence_(longest_silence) {}

    /// Fails if the other side is gone. SIGPIPE must be ignored.
    Expected<void> put(std::string_view text) const;
    Expected<void> put_number(std::size_t number) const;
    /// Fails if the other side is gone, is silent for too long, or sends an invalid text.
    Expected<std::string> take() const;
    Expected<std::size_t> take_number() const;
    /// Takes a line of plain text, as programs print it, without its line end. Fails if the other side ends before the
    /// end of the line.
    Expected<std::string> take_line() const;

private:
    Expected<std::string> take_bytes(std::size_t count) const;

    int from_, to_, longest_silence_;
};

}  // namespace nezumi::push
