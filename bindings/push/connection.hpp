// What the two sides of a push say to each other: texts of any bytes, one after the other, over two descriptors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::push {

class PushConnection {
public:
    /// `longest_silence` [ms] is how long `take` waits for the next byte; -1: for ever. The descriptors stay the
    /// caller's.
    PushConnection(int from, int to, int longest_silence = -1)
        : from_(from), to_(to), longest_silence_(longest_silence) {}

    /// An error when the other side is gone. SIGPIPE must be ignored.
    Expected<void> put(std::string_view text) const;
    Expected<void> put_number(std::size_t number) const;
    /// An error when the other side is gone, silent for too long, or says what can't be meant.
    Expected<std::string> take() const;
    Expected<std::size_t> take_number() const;
    /// A line of plain text, without its end, as programs print it. An error when the other side is gone before its
    /// end.
    Expected<std::string> take_line() const;

private:
    Expected<std::string> take_bytes(std::size_t count) const;

    int from_, to_, longest_silence_;
};

}  // namespace nezumi::push
