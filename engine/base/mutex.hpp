// A mutex for what a thread that must be in time shares with threads that need not be.
#pragma once

#include <pthread.h>

#include <mutex>

namespace nezumi {

/// Who holds it inherits the priority of who waits for it (PTHREAD_PRIO_INHERIT), or a busy machine would keep the
/// ticking thread of `--realtime` waiting for one that does not get a processor. Without real-time priorities it costs
/// no more than a std::mutex, and is one: condition variables take it.
class Mutex : public std::mutex {
public:
    Mutex() {
        pthread_mutexattr_t attributes;
        pthread_mutexattr_init(&attributes);
        pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
        pthread_mutex_init(native_handle(), &attributes);
        pthread_mutexattr_destroy(&attributes);
    }
};

/// What condition variables wait with.
using Lock = std::unique_lock<std::mutex>;

}  // namespace nezumi
