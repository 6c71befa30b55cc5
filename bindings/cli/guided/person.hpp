// The person beside the robot: told what to do, asked what was measured.
#pragma once

#include <csignal>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

class Person {
public:
    /// `end`: a signal that has come while it waits ends the waiting. With `is_sure` nothing is confirmed, and numbers
    /// come from wherever standard input does.
    Person(const volatile std::sig_atomic_t& end, bool is_sure) : end_(end), is_sure_(is_sure) {}

    /// An error where nobody is there who could be asked.
    Expected<void> is_there() const;
    void tell(const std::string& text) const;
    /// Waits for Enter.
    Expected<void> confirm(const std::string& text);
    /// Asks until the answer is so many numbers.
    Expected<std::vector<double>> numbers(const std::string& question, std::size_t count);

private:
    Expected<std::string> line();

    const volatile std::sig_atomic_t& end_;
    bool is_sure_;
};

}  // namespace nezumi::cli
