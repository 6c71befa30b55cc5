// Both sides of a push without ssh: the robot's is a process of its own, whose system calls can be counted and cut.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "bindings/push/send.hpp"
#include "engine/base/error.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

namespace nezumi::push {

/// A system call of the robot's side that changes files, or waits until they are on the disk.
struct DiskCall {
    pid_t process;
    long number;       ///< SYS_...
    int descriptor;    ///< its first argument
    std::string path;  ///< of that descriptor
};

/// A home folder "home" of a robot, and a project "robots" beside it.
class TracedRobot {
public:
    TracedRobot();

    struct Cut {
        std::size_t at = 0;  ///< the robot's side is killed as it begins the disk call of this number, from 1; 0: never
        std::function<void(const DiskCall&, bool is_over)> watch{};  ///< sees each before it begins and when it is over
    };
    struct Result {
        Expected<Sent> sent;
        std::size_t calls = 0;  ///< disk calls that were begun
    };
    /// Pushes to `folder`, as seen from the home folder.
    Result push(const std::string& folder = "robots", bool only_shows = false) const {
        return push(folder, only_shows, {});
    }
    Result push_cut(const Cut& cut) const { return push("robots", false, cut); }
    /// The same with a limit on the size of the files that the robot's side writes [bytes].
    Result push_with_limit(std::size_t bytes) const;

    std::filesystem::path home() const { return scratch.path("home"); }
    std::filesystem::path there() const { return home() / "robots"; }
    std::filesystem::path project() const { return scratch.path("robots"); }

    Scratch scratch;

private:
    Result push(const std::string& folder, bool only_shows, const Cut& cut, std::size_t largest_file = 0) const;
};

/// Every file, folder ("/") and link ("-> target") below a folder but the push's own, with its content.
std::map<std::string, std::string> tree_of(const std::filesystem::path& folder);

}  // namespace nezumi::push
