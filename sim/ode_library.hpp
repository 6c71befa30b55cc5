// ODE's library state and handles as RAII objects.
#pragma once

#include <ode/ode.h>

#include <functional>
#include <string>
#include <utility>

#include "engine/base/mutex.hpp"

namespace nezumi::sim {

/// Keeps ODE initialised while at least one instance exists, on any thread. Meanwhile ODE's messages go to the
/// `OdeMessages` of the thread instead of the terminal.
class OdeLibrary {
public:
    OdeLibrary();
    ~OdeLibrary();
    OdeLibrary(const OdeLibrary&) = delete;
    OdeLibrary& operator=(const OdeLibrary&) = delete;

    /// Must be called on a thread before the thread steps a world or collides shapes. Repeated calls cost almost
    /// nothing.
    static void use_on_this_thread();

    /// Keeps an object of a world that broke down within a step until the process ends, because ODE ends the process
    /// when such an object is destroyed.
    static void keep(void* object);

    /// ODE has one random generator per process. Runs `work` alone with the generator set to `seed` and stores its new
    /// state in `seed`. So each world has its own sequence of random numbers.
    template <class Work>
    static void with_random_numbers(unsigned long& seed, Work&& work) {
        const std::scoped_lock lock(random_numbers());
        dRandSetSeed(seed);
        work();
        seed = dRandGetSeed();
    }

private:
    static Mutex& random_numbers();
};

/// Thrown through ODE by an error after which ODE would end the process, while an `OdeMessages` exists on the thread.
/// The world must not be stepped again.
struct OdeFailure {
    std::string text;
};

/// Receives ODE's messages on this thread during its lifetime.
class OdeMessages {
public:
    using Sink = std::function<void(const std::string&)>;

    explicit OdeMessages(const Sink& sink);
    ~OdeMessages();
    OdeMessages(const OdeMessages&) = delete;
    OdeMessages& operator=(const OdeMessages&) = delete;

private:
    const Sink* before_;
};

/// Owns an ODE object.
template <class Id, void (*destroy)(Id)>
class OdeHandle {
public:
    OdeHandle() = default;
    explicit OdeHandle(Id id) : id_(id) {}
    OdeHandle(OdeHandle&& other) noexcept : id_(std::exchange(other.id_, nullptr)) {}
    OdeHandle& operator=(OdeHandle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~OdeHandle() {
        if (id_ != nullptr) destroy(id_);
    }

    Id get() const { return id_; }
    /// The caller becomes the owner.
    Id release() { return std::exchange(id_, nullptr); }
    explicit operator bool() const { return id_ != nullptr; }

private:
    Id id_ = nullptr;
};

using ThreadingHandle = OdeHandle<dThreadingImplementationID, dThreadingFreeImplementation>;
using WorldHandle = OdeHandle<dWorldID, dWorldDestroy>;
using JointGroupHandle = OdeHandle<dJointGroupID, dJointGroupDestroy>;
using JointHandle = OdeHandle<dJointID, dJointDestroy>;
using GeomHandle = OdeHandle<dGeomID, dGeomDestroy>;

}  // namespace nezumi::sim
