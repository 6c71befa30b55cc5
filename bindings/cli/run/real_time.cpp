// SCHED_FIFO for one thread, and locked memory.
#include "bindings/cli/run/real_time.hpp"

#include <fmt/format.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace nezumi::cli {
namespace {

int schedule(int priority) {
    const sched_param parameters{.sched_priority = priority};
    const int policy = priority > 0 ? SCHED_FIFO | SCHED_RESET_ON_FORK : SCHED_OTHER;
    return sched_setscheduler(0, policy, &parameters) == 0 ? 0 : errno;
}

bool may_lock_everything() {
    __user_cap_header_struct version{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> own{};
    return syscall(SYS_capget, &version, own.data()) == 0 && (own[0].effective & (1U << CAP_IPC_LOCK)) != 0;
}

int lock_memory() {
    // With a limit on locked memory, later allocations could fail.
    rlimit limit{};
    const bool limited = getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
    if (limited && !may_lock_everything()) return EPERM;
    // Present memory is locked now, later memory when it is first used: a thread's stack is 8 MB.
    if (mlockall(MCL_CURRENT) != 0 || mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) return errno;
    return 0;
}

}  // namespace

Kernel the_kernel() { return {schedule, lock_memory}; }

RealTime::RealTime(Kernel kernel) : kernel_(std::move(kernel)) {
    const int unlocked = kernel_.lock_memory();
    const int unscheduled = kernel_.schedule(priority);
    scheduled_ = unscheduled == 0;
    told_ = scheduled_ ? fmt::format("--realtime: SCHED_FIFO with priority {}", priority)
                       : fmt::format("--realtime: no SCHED_FIFO ({})", std::strerror(unscheduled));
    told_ += unlocked == 0 ? ", memory is locked" : fmt::format(", memory is not locked ({})", std::strerror(unlocked));
    if (unscheduled != 0 || unlocked != 0) {
        told_ += fmt::format(
            "; to allow it, write '* - rtprio {}' and '* - memlock unlimited' on two lines of "
            "/etc/security/limits.d/nezumi.conf and log in again",
            priority);
    }
}

RealTime::~RealTime() {
    if (scheduled_) kernel_.schedule(0);
}

}  // namespace nezumi::cli
