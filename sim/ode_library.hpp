// ODE's library state and handles, tied to scopes.
#pragma once

#include <ode/ode.h>

#include <functional>
#include <string>
#include <utility>

#include "engine/base/mutex.hpp"

namespace nezumi::sim {

/// Keeps ODE initialised as long as one of these lives; any number may, on any thread. While one does, what ODE has to
/// say goes to the `OdeMessages` of the thread instead of the terminal.
class OdeLibrary {
public:
    OdeLibrary();
    ~OdeLibrary();
    OdeLibrary(const OdeLibrary&) = delete;
    OdeLibrary& operator=(const OdeLibrary&) = delete;

    /// To be called on a thread before it steps or collides; costs next to nothing when it was called before.
    static void use_on_this_thread();

    /// Keeps an object of a world that broke down in the middle of a step until the process ends: ODE ends the process
    /// when such an object is destroyed.
    static void keep(void* object);

    /// ODE draws from one generator for the whole process. Runs `work` with the generator set to `seed`, alone, and
    /// leaves in `seed` where it has got to: each world draws its own numbers, whoever else runs.
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

/// Thrown through ODE by an error after which it would end the process, while an `OdeMessages` lives on the thread. The
/// world at hand must not be stepped again.
struct OdeFailure {
    std::string text;
};

/// Where ODE's messages on this thread go, for the lifetime of this object.
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

/// Owns one of ODE's objects.
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
    /// From now on the caller owns it.
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
