// Builds a running system from its description, or returns the error.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/system/network.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Facts about the system for the factories of components.
struct MakerContext {
    std::uint64_t seed = 0;  ///< of the run
    double tick_rate = 100;  ///< [Hz]
};

/// Makes the body of a real robot.
using BodyMaker = std::function<Expected<std::unique_ptr<RobotBody>>(const RobotEntry& entry, const RobotSpec& spec)>;
/// Makes a native component.
using ComponentMaker = std::function<Expected<std::unique_ptr<Component>>(const ComponentEntry& entry, System& system)>;

/// Makers of one kind by backend: a simulation, or the driver of a real device.
template <class Maker>
using ByBackend = std::map<std::string, Maker, std::less<>>;

/// The functions that make components. The program provides them, so that the engine knows neither Lua nor ODE.
struct Makers {
    /// Makes bodies of backend "sim". May be empty: a system without simulated robots needs no world.
    WorldFactory world;
    RigMaker rig;
    NetworkMaker network;  ///< may be empty: then a system of several hosts is refused
    /// Bodies of all other backends. They are in no world: real and simulated robots do not see each other.
    ByBackend<BodyMaker> bodies;
    /// The drivers that robot files may name, also in simulation; empty: any name.
    std::vector<std::string> drivers{};
    std::function<Expected<std::unique_ptr<Component>>(const BehaviorEntry& entry, const MakerContext& context)>
        behavior;
    /// Native components by type, then by backend.
    std::map<std::string, ByBackend<ComponentMaker>, std::less<>> components;
    PeerWords peer_words{};  ///< they check connections with other programs
};

struct BuildOptions {
    std::uint64_t seed = 0;  ///< used if the system file has no seed
    bool seed_wins = false;  ///< the seed replaces the one of the file
    int threads = 1;
    bool out_of_time_is_fatal = false;
    bool real_time = false;                             ///< as in `System::Settings`: for systems with a real robot
    std::function<double()> clock = monotonic_seconds;  ///< [s] for `real_time`
    bool keep_going = false;  ///< a behaviour that can't be made is omitted with its connections, and logged
    LogSink log;
};

/// The context that a system with this description and these options gives to its factories.
MakerContext context_of(const SystemSpec& spec, const BuildOptions& options);

/// Builds the world, every entry in order and the connections, and sets parameters. Nothing is activated. `spec` must
/// outlive the system. Errors have the location of the wrong line.
Expected<std::unique_ptr<System>> build_system(const SystemSpec& spec, const Makers& makers,
                                               const BuildOptions& options);

/// Adds one entry to an existing system without activating it (for scenarios that add while they run).
Expected<Component*> add_entry(System& system, const Entry& entry, const SystemSpec& spec, const Makers& makers);

/// Tells the words of peers that `who` has added a component.
void note_added(System& system, SystemSpec& spec, std::string_view component, const Actor& who, const Makers& makers);

/// Activates all components in order, except those that the file keeps inactive. A component that can't be activated
/// goes to ERROR; the others continue.
void activate_all(System& system, const SystemSpec& spec);

}  // namespace nezumi
