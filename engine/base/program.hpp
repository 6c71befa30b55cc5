// Other programs, run without a shell.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// Whether a program of this name could be run, as execvp looks for it.
bool can_run(const std::string& program);

/// A file without a name, for what a program reads or writes. A pipe would block while nobody reads and signal when
/// nobody does.
class UnnamedFile {
public:
    /// Holds this text, and is read from its beginning.
    explicit UnnamedFile(std::string_view text = {});
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;

    /// -1 when there could be none.
    int file() const { return file_; }
    /// Whoever reads it next begins at its beginning.
    void rewind() const;

private:
    int file_;
};

struct ProgramRun {
    std::vector<std::string> words;              ///< its name, and what it is told: no shell looks at them
    int input = -1;                              ///< a file; -1: there is nothing to read
    int output = -1;                             ///< a file; -1: nobody listens
    double longest = 20;                         ///< [s] after which it is killed
    const std::atomic<bool>* give_up = nullptr;  ///< it is killed as soon as this is true
};

/// Runs a program, and waits for its end. "" when its status was 0, else what went wrong. Ctrl-C is not for it.
std::string run_program(const ProgramRun& run);

}  // namespace nezumi
