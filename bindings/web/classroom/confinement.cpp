// Landlock for files (https://docs.kernel.org/userspace-api/landlock.html), and a seccomp filter that refuses sockets.
// The numbers of Landlock are written here, because the headers of Debian 12 are older than many kernels.
#include "bindings/web/classroom/confinement.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>

#include "engine/base/descriptor.hpp"
#include "engine/base/sanitizers.hpp"
#include "engine/project/folders.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;

// System call numbers, the same on all processors.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr unsigned get_version = 1;
constexpr int rule_of_path = 1;

struct Ruleset {
    std::uint64_t files = 0;
    std::uint64_t net = 0;
    std::uint64_t scoped = 0;
};
struct [[gnu::packed]] PathRule {
    std::uint64_t allowed = 0;
    std::int32_t parent = -1;
};

// Rights on files, as the bits of Landlock.
constexpr std::uint64_t execute = 1U << 0U, write_file = 1U << 1U, read_file = 1U << 2U, read_folder = 1U << 3U,
                        remove_folder = 1U << 4U, remove_file = 1U << 5U, make_folder = 1U << 7U, make_file = 1U << 8U,
                        move = 1U << 13U, truncate_file = 1U << 14U, control_device = 1U << 15U;
constexpr std::uint64_t for_reading = execute | read_file | read_folder;
constexpr std::uint64_t for_work =
    read_file | read_folder | write_file | remove_folder | remove_file | make_folder | make_file | move | truncate_file;
// The rights that a rule for a file may have; the others are for folders only.
constexpr std::uint64_t of_files = execute | write_file | read_file | truncate_file | control_device;
constexpr std::uint64_t for_devices = read_file | read_folder | write_file | truncate_file | control_device;

int version() {
#if defined(NEZUMI_ADDRESS_SANITIZER)
    return 0;  // the sanitizer looks for leaks in /proc, which Landlock would forbid
#else
    return static_cast<int>(syscall(create_ruleset, nullptr, 0, get_version));
#endif
}

// All rights that this version of Landlock can control. They are forbidden unless a rule allows them.
std::uint64_t known_rights(int version) {
    if (version >= 5) return (std::uint64_t{1} << 16U) - 1;
    if (version >= 3) return (std::uint64_t{1} << 15U) - 1;
    return (std::uint64_t{1} << (version == 2 ? 14U : 13U)) - 1;
}

std::string problem(const std::string& what) { return what + ": " + std::strerror(errno); }

Expected<void> allow(int ruleset, const fs::path& path, std::uint64_t rights) {
    const Descriptor opened(open(path.c_str(), O_PATH | O_CLOEXEC));
    if (!opened) return errno == ENOENT ? Expected<void>() : failure(problem(path.string()));
    struct stat status {};
    if (fstat(opened.get(), &status) != 0) return failure(problem(path.string()));
    const PathRule rule{.allowed = S_ISDIR(status.st_mode) ? rights : rights & of_files, .parent = opened.get()};
    if (syscall(add_rule, ruleset, rule_of_path, &rule, 0) != 0) return failure(problem(path.string()));
    return {};
}

Expected<void> confine_files(const Confinement& confinement) {
    const int known = version();
    if (known < 1)
        return failure("this kernel can't confine programs: it has no Landlock (Linux 5.13 or later has it)");
    const std::uint64_t rights = known_rights(known);
    // Also forbids TCP ports, and signals and abstract sockets of other programs, if this version can.
    const Ruleset all{.files = rights, .net = known >= 4 ? 3U : 0U, .scoped = known >= 6 ? 3U : 0U};
    const std::size_t size = known >= 6   ? sizeof(Ruleset)
                             : known >= 4 ? offsetof(Ruleset, scoped)
                                          : offsetof(Ruleset, net);
    const Descriptor ruleset(static_cast<int>(syscall(create_ruleset, &all, size, 0)));
    if (!ruleset) return failure(problem("Landlock"));
    if (auto ok = allow(ruleset.get(), confinement.work, for_work & rights); !ok) return ok;
    for (const fs::path& path : confinement.readable) {
        if (auto ok = allow(ruleset.get(), path, for_reading & rights); !ok) return ok;
    }
    for (const fs::path& path : confinement.devices) {
        if (auto ok = allow(ruleset.get(), path, for_devices & rights); !ok) return ok;
    }
    for (const char* device : {"/dev/null", "/dev/zero", "/dev/urandom"}) {
        if (auto ok = allow(ruleset.get(), device, (read_file | write_file) & rights); !ok) return ok;
    }
    if (syscall(restrict_self, ruleset.get(), 0) != 0) return failure(problem("Landlock"));
    return {};
}

#if defined(__x86_64__)
constexpr std::uint32_t processor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t processor = AUDIT_ARCH_AARCH64;
#elif defined(__arm__)
constexpr std::uint32_t processor = AUDIT_ARCH_ARM;
#elif defined(__riscv)
constexpr std::uint32_t processor = AUDIT_ARCH_RISCV64;
#else
constexpr std::uint32_t processor = 0;  // every call is refused
#endif

// Refuses socket(), and calls that could replace it. socketpair() stays allowed. If `but_local`, local sockets are
// allowed too: a program reserves a robot with one.
Expected<void> refuse_sockets(bool but_local) {
    constexpr std::uint32_t refused = SECCOMP_RET_ERRNO | EACCES;
    constexpr std::uint32_t x32_bit = 0x40000000;
    // The lower half of the first argument of socket(), which is its domain.
    constexpr std::uint32_t domain = offsetof(seccomp_data, args) + (std::endian::native == std::endian::big ? 4 : 0);
    const std::uint32_t local = but_local ? SECCOMP_RET_ALLOW : refused;
    std::array<sock_filter, 13> filter{{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, processor, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, refused),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, x32_bit, 7, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_socket, 3, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_io_uring_setup, 5, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_ptrace, 4, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, domain),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_UNIX, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, local),
        BPF_STMT(BPF_RET | BPF_K, refused),
    }};
    const sock_fprog program{.len = static_cast<unsigned short>(filter.size()), .filter = filter.data()};
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) return failure(problem("seccomp"));
    return {};
}

void set_bounds(bool lowers_priority) {
    const auto at_most = [](auto resource, rlim_t most) {
        rlimit limit{};
        if (getrlimit(resource, &limit) != 0) return;
        limit.rlim_max = std::min(limit.rlim_max, most);
        limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
        setrlimit(resource, &limit);
    };
#if !defined(NEZUMI_ADDRESS_SANITIZER) && !defined(NEZUMI_THREAD_SANITIZER)  // these reserve terabytes at the start
    at_most(RLIMIT_DATA, most_memory);
#endif
    at_most(RLIMIT_FSIZE, longest_pupil_file);
    at_most(RLIMIT_NOFILE, most_open_files);
    at_most(RLIMIT_CORE, 0);
    errno = 0;
    [[maybe_unused]] const int now = lowers_priority ? nice(lower_priority) : 0;
}

}  // namespace

bool can_confine() { return version() >= 1; }

Expected<void> confine(const Confinement& confinement) {
    set_bounds(confinement.devices.empty());  // real robots need regular ticks
    if (!confinement.by_kernel) return {};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return failure(problem("new privileges can't be refused"));
    if (auto ok = confine_files(confinement); !ok) return ok;
    return refuse_sockets(!confinement.devices.empty());
}

std::vector<fs::path> readable_parts(const fs::path& program, const std::vector<fs::path>& installed) {
    std::vector<fs::path> parts{"/lib",
                                "/lib32",
                                "/lib64",
                                "/bin",
                                "/etc/ld.so.cache",
                                "/etc/localtime",
                                "/usr/share/zoneinfo",
                                program.parent_path(),
                                program.parent_path().parent_path() / "lib"};
    const auto add_all_in = [&](const fs::path& folder, const fs::path& except) {
        std::error_code none;
        for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none)) {
            if (entry->path().filename() != except) parts.push_back(entry->path());
        }
    };
    add_all_in("/usr", "share");
    for (const fs::path& folder : installed) {
        const fs::path exercises = folder / exercises_folder;
        add_all_in(exercises.parent_path(), exercises.filename());
        parts.push_back(folder / "engine/robots");
    }
    return parts;
}

}  // namespace nezumi::web
