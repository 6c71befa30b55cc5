// ptrace stops the robot's side at each system call: killed there, it has done all before and nothing of this one.
#include "tests/unit/push/traced_robot.hpp"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <thread>

#include "bindings/push/connection.hpp"
#include "bindings/push/receive.hpp"
#include "bindings/push/scan.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::push {
namespace {

namespace fs = std::filesystem;

bool is_disk_call(const __ptrace_syscall_info& info, const std::string& path) {
    static const std::set<long> always{
        SYS_renameat, SYS_renameat2, SYS_unlinkat, SYS_mkdirat, SYS_symlinkat, SYS_fsync, SYS_syncfs,
#ifdef SYS_rename  // processors that have the older calls too
        SYS_rename,   SYS_mkdir,
#endif
    };
    const auto number = static_cast<long>(info.entry.nr);
    if (number == SYS_openat) return (info.entry.args[2] & O_CREAT) != 0;
    return number == SYS_write ? path.starts_with("/") : always.contains(number);
}

// Runs the traced process to its end, or to its cut.
std::size_t trace(pid_t process, const TracedRobot::Cut& cut) {
    std::size_t calls = 0;
    std::optional<DiskCall> begun;
    int status = 0;
    waitpid(process, &status, 0);  // for its SIGSTOP
    ptrace(PTRACE_SETOPTIONS, process, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
    while (ptrace(PTRACE_SYSCALL, process, nullptr, nullptr) == 0 && waitpid(process, &status, 0) == process &&
           WIFSTOPPED(status)) {
        __ptrace_syscall_info info{};
        if (WSTOPSIG(status) != (SIGTRAP | 0x80) || ptrace(PTRACE_GET_SYSCALL_INFO, process, sizeof info, &info) <= 0)
            continue;
        if (info.op == PTRACE_SYSCALL_INFO_EXIT && begun) {
            if (cut.watch) cut.watch(*begun, true);
            begun.reset();
        }
        if (info.op != PTRACE_SYSCALL_INFO_ENTRY) continue;
        const int descriptor = static_cast<int>(info.entry.args[0]);
        std::error_code none;
        const fs::path path =
            fs::read_symlink("/proc/" + std::to_string(process) + "/fd/" + std::to_string(descriptor), none);
        if (!is_disk_call(info, path.string())) continue;
        begun = DiskCall{process, static_cast<long>(info.entry.nr), descriptor, path.string()};
        if (cut.watch) cut.watch(*begun, false);
        if (++calls == cut.at) kill(process, SIGKILL);
    }
    return calls;
}

void add_to_tree(const fs::path& folder, const std::string& below, std::map<std::string, std::string>& tree) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string name = below + entry.path().filename().string();
        if (name == own_folder) continue;
        if (entry.is_symlink()) {
            tree[name] = "-> " + fs::read_symlink(entry.path()).string();
        } else if (entry.is_directory()) {
            tree[name] = "/";
            add_to_tree(entry.path(), name + "/", tree);
        } else {
            tree[name] = read_whole(entry.path(), name).value_or("unreadable");
        }
    }
}

}  // namespace

TracedRobot::TracedRobot() {
    fs::create_directory(home());
    fs::create_directory(project());
}

TracedRobot::Result TracedRobot::push(const std::string& folder, bool only_shows, const Cut& cut,
                                      std::size_t largest_file) const {
    const auto scan = scan_project(project());
    REQUIRE(scan);
    std::array<int, 2> there{}, back{};
    REQUIRE(pipe2(there.data(), O_CLOEXEC) == 0);
    REQUIRE(pipe2(back.data(), O_CLOEXEC) == 0);
    const bool is_traced = cut.at > 0 || cut.watch;
    const pid_t process = fork();
    if (process == 0) {
        close(there[1]);
        close(back[0]);
        if (chdir(home().c_str()) != 0 || setenv("HOME", home().c_str(), 1) != 0) _exit(2);
        std::signal(SIGPIPE, SIG_IGN);
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{largest_file, largest_file};
        if (largest_file > 0) setrlimit(RLIMIT_FSIZE, &limit);
        if (is_traced && (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0 || raise(SIGSTOP) != 0)) _exit(2);
        _exit(receive_project({there[0], back[1]}) ? 0 : 1);
    }
    close(there[0]);
    close(back[1]);
    const auto pipe_before = std::signal(SIGPIPE, SIG_IGN);
    Result result{.sent = failure("not begun")};
    std::thread sender([&] {
        result.sent = send_project({back[0], there[1]}, *scan, folder, only_shows);
        close(there[1]);
    });
    if (is_traced) {
        result.calls = trace(process, cut);
    } else {
        waitpid(process, nullptr, 0);
    }
    sender.join();
    std::signal(SIGPIPE, pipe_before);
    close(back[0]);
    return result;
}

TracedRobot::Result TracedRobot::push_with_limit(std::size_t bytes) const { return push("robots", false, {}, bytes); }

std::map<std::string, std::string> tree_of(const fs::path& folder) {
    std::map<std::string, std::string> tree;
    add_to_tree(folder, "", tree);
    return tree;
}

}  // namespace nezumi::push
