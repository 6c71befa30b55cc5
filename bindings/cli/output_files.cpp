// A file is tried without leaving a trace.
#include "bindings/cli/output_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace nezumi::cli {

bool is_picture_name(std::string_view name) {
    return name.size() > 4 && (name.ends_with(".png") || name.ends_with(".svg"));
}

Expected<void> check_can_write(const std::string& file) {
    // Opening is the only test that all file systems answer truly; what it made goes again.
    const bool was_there = access(file.c_str(), F_OK) == 0;
    const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (fd < 0 && errno == ENXIO)
        return failure("is a pipe that nobody reads: start its reader first, or give a file", {file});
    if (fd < 0) return failure(fmt::format("can't be written: {}", std::strerror(errno)), {file});
    close(fd);
    if (!was_there) unlink(file.c_str());
    return {};
}

}  // namespace nezumi::cli
