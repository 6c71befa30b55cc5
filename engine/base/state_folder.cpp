// As in the XDG base directory specification.
#include "engine/base/state_folder.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

namespace nezumi {

std::filesystem::path state_folder() {
    const auto absolute = [](const char* text) { return text != nullptr && text[0] == '/'; };
    if (const char* state = std::getenv("XDG_STATE_HOME"); absolute(state))
        return std::filesystem::path(state) / "nezumi";
    const char* home = std::getenv("HOME");
    if (!absolute(home)) {
        const passwd* user = getpwuid(geteuid());  // NOLINT(concurrency-mt-unsafe): at the start
        home = user != nullptr ? user->pw_dir : nullptr;
    }
    return absolute(home) ? std::filesystem::path(home) / ".local/state/nezumi" : std::filesystem::path();
}

}  // namespace nezumi
