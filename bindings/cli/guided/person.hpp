// The person beside the robot: gets instructions and answers questions.
#pragma once

#include <csignal>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

class Person {
public:
    /// `end` becomes nonzero when a signal ends the waiting. With `is_sure`, no confirmation is needed, and numbers are
    /// read from standard input even if it is no terminal.
    Person(const volatile std::sig_atomic_t& end, bool is_sure) : end_(end), is_sure_(is_sure) {}

    /// Fails if no person can be asked.
    Expected<void> is_there() const;
    void tell(const std::string& text) const;
    /// Waits for Enter.
    Expected<void> confirm(const std::string& text);
    /// Asks until the answer consists of `count` numbers.
    Expected<std::vector<double>> numbers(const std::string& question, std::size_t count);

private:
    Expected<std::string> line();

    const volatile std::sig_atomic_t& end_;
    bool is_sure_;
};

}  // namespace nezumi::cli
