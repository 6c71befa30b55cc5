// Runs other programs without a shell.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// Whether a program of this name can be run, as execvp searches for it.
bool can_run(const std::string& program);

/// A file without a name, for the input or output of a program. It is used instead of a pipe, because writing to a pipe
/// can block, and raises a signal if there is no reader any more.
class UnnamedFile {
public:
    /// The file contains `text`, and is read from its start.
    explicit UnnamedFile(std::string_view text = {});
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;

    /// -1 if it could not be made.
    int file() const { return file_; }
    /// The next reader reads from the start.
    void rewind() const;
    /// The whole content, or its last `most` bytes.
    std::string text(std::size_t most = std::string::npos) const;

private:
    int file_;
};

/// For the files of `ProgramRun`: no input, and output is dropped.
inline constexpr int no_file = -1;
/// For the files of `ProgramRun`: the same file as that of this program.
inline constexpr int own_file = -2;

struct ProgramRun {
    std::vector<std::string> words;  ///< the program's name and arguments; no shell interprets them
    int input = no_file;             ///< a descriptor, `no_file` or `own_file`; also for `output` and `errors`
    int output = no_file;
    int errors = no_file;
    bool keeps_output = false;                   ///< stores the output in `ProgramEnd::out`, and ignores `output`
    bool is_in_front = false;                    ///< the program may read from the terminal, and Ctrl-C also stops it
    double longest = 20;                         ///< [s] after this time the program is killed
    const std::atomic<bool>* give_up = nullptr;  ///< the program is killed as soon as this is true
    std::atomic<int>* process = nullptr;         ///< gets the process number of the running program, then 0
};

/// The end of a program.
struct ProgramEnd {
    int status = 0;   ///< exit status; after a signal 128 plus the number of the signal
    int signal = 0;   ///< the signal that ended the program; 0: none
    std::string out;  ///< the output, with `ProgramRun::keeps_output`
};

/// Runs a program and waits for its end. An error if the program can't be run or was killed.
Expected<ProgramEnd> run_program(const ProgramRun& run);

/// The error of a program: "" if it ended with status 0.
std::string problem_of(const Expected<ProgramEnd>& end);

}  // namespace nezumi
