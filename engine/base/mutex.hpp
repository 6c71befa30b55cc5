// A mutex for data that a real-time thread shares with other threads.
#pragma once

#include <pthread.h>

#include <mutex>

namespace nezumi {

/// A mutex whose holder inherits the priority of a waiting thread (PTHREAD_PRIO_INHERIT). Otherwise, on a busy machine,
/// the ticking thread of `--realtime` could wait for a thread that gets no processor. Without real-time priorities this
/// mutex is as fast as a std::mutex. Condition variables accept it, because it is a std::mutex.
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

/// The lock for condition variables.
using Lock = std::unique_lock<std::mutex>;

}  // namespace nezumi
