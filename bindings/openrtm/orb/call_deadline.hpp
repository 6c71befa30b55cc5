// One deadline that all CORBA calls of a thread share.
#pragma once

#include <omniORB4/CORBA.h>
#include <omnithread.h>

#include <chrono>

namespace nezumi::openrtm {

/// During the lifetime of this object, CORBA calls of this thread fail, as if the peer hung, if they are not answered
/// before the deadline.
class CallDeadline {
public:
    explicit CallDeadline(std::chrono::milliseconds from_now) {
        unsigned long seconds = 0, nanoseconds = 0;
        omni_thread::get_time(&seconds, &nanoseconds, static_cast<unsigned long>(from_now.count() / 1000),
                              static_cast<unsigned long>(from_now.count() % 1000 * 1'000'000));
        omniORB::setClientThreadCallDeadline(seconds, nanoseconds);
    }
    ~CallDeadline() { omniORB::setClientThreadCallDeadline(0, 0); }
    CallDeadline(const CallDeadline&) = delete;
    CallDeadline& operator=(const CallDeadline&) = delete;

private:
    omni_thread::ensure_self self_;  // first: only threads known to omniORB have one
};

}  // namespace nezumi::openrtm
