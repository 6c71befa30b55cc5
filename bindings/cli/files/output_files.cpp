// Tests whether a file can be written, without changing it.
#include "bindings/cli/files/output_files.hpp"

#include <unistd.h>

#include "engine/base/whole_file.hpp"

namespace nezumi::cli {

bool is_picture_name(std::string_view name) {
    return name.size() > 4 && (name.ends_with(".png") || name.ends_with(".svg"));
}

Expected<void> check_can_write(const std::string& file) {
    // Only opening a file is a reliable test on all file systems; a file that is created by this test is removed again.
    const bool was_there = access(file.c_str(), F_OK) == 0;
    const auto opened = open_to_write(file);
    if (!opened) return Unexpected(opened.error());
    close(*opened);
    if (!was_there) unlink(file.c_str());
    return {};
}

}  // namespace nezumi::cli
