// A mutex for data that a real-time thread shares with other threads.
#pragma once

#include <pthread.h>

#include <mutex>

namespace nezumi {

/// The thread that holds it inherits the priority of a waiting thread (PTHREAD_PRIO_INHERIT); otherwise, on a busy
/// machine, the ticking thread of `--realtime` could wait for a thread that gets no processor. Without real-time
/// priorities it is as fast as a std::mutex. It is a std::mutex, so condition variables accept it.
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
