// A closed standard output is opened for reading only, so that writing to it still fails.
#include "bindings/cli/base/standard_files.hpp"

#include <fcntl.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace nezumi::cli {

void open_missing_standard_files() {
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(file, F_GETFD) >= 0 || errno != EBADF) continue;
        // open() returns the lowest free number: this is `file`, because all lower ones are open by now.
        static_cast<void>(open("/dev/null", file == STDERR_FILENO ? O_RDWR : O_RDONLY));
    }
}

std::string lost_output() {
    const bool was_lost = std::ferror(stdout) != 0;
    const bool flushed = std::fflush(stdout) == 0;
    const int problem = errno;
    if (flushed && !was_lost) return "";
    std::clearerr(stdout);
    __fpurge(stdout);
    std::string text = "standard output can't be written";
    if (!flushed) text += std::string(": ") + std::strerror(problem);
    return text;
}

}  // namespace nezumi::cli
