// The secret is written to a temporary file, which is then linked to its name. Only the first process can make this
// link, so all processes read the same secret.
#include "bindings/dds/user_secret.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "engine/base/state_folder.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::dds {
namespace {

Unexpected refused(const std::filesystem::path& file, std::string_view why) {
    return failure(
        fmt::format("no secret for the hosts of this user in '{}': {}; set `secret = FILE` (`nezumi network secret "
                    "FILE` makes one), or `open = true` to let every user of this computer drive",
                    visible(file.string()), why));
}

// Returns an errno, or 0 if the file exists now.
int make_file(const std::filesystem::path& file) {
    std::error_code none;
    std::filesystem::create_directories(file.parent_path().parent_path(), none);
    if (mkdir(file.parent_path().c_str(), 0700) != 0 && errno != EEXIST) return errno;
    std::string own = file.string() + ".XXXXXX";
    const int written = ::mkostemp(own.data(), O_CLOEXEC);  // readable only by its user
    if (written < 0) return errno;
    int problem = write_all(written, secret_text(make_secret()));
    ::close(written);
    if (problem == 0 && ::link(own.c_str(), file.c_str()) != 0 && errno != EEXIST) problem = errno;
    ::unlink(own.c_str());
    return problem;
}

}  // namespace

std::filesystem::path user_secret_file() {
    const std::filesystem::path folder = state_folder();
    return folder.empty() ? folder : folder / "network.secret";
}

Expected<Secret> user_secret(const std::filesystem::path& file) {
    if (file.empty()) return refused(file, "this user has no home");
    struct stat status {};
    if (lstat(file.c_str(), &status) != 0) {
        if (const int problem = make_file(file); problem != 0) return refused(file, std::strerror(problem));
        if (lstat(file.c_str(), &status) != 0) return refused(file, std::strerror(errno));
    }
    if (!S_ISREG(status.st_mode) || status.st_uid != geteuid()) return refused(file, "it is not a file of this user");
    return read_secret(file.string(), file.string());
}

}  // namespace nezumi::dds
