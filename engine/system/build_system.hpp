// From a system as data to a system that runs, or the one message that says why not.
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

/// What the makers of components may know about the system they are for.
struct MakerContext {
    std::uint64_t seed = 0;  ///< of the run
    double tick_rate = 100;  ///< [Hz]
};

/// The backend of what is simulated, and of what no file gives another one.
inline constexpr std::string_view simulated = "sim";

/// Makes the body of a real robot.
using BodyMaker = std::function<Expected<std::unique_ptr<RobotBody>>(const RobotEntry& entry, const RobotSpec& spec)>;
/// Makes a native component.
using ComponentMaker = std::function<Expected<std::unique_ptr<Component>>(const ComponentEntry& entry, System& system)>;

/// Makers of the same thing by backend: what simulates it, or the driver of a real one.
template <class Maker>
using ByBackend = std::map<std::string, Maker, std::less<>>;

/// How components come into being: given by the composition root, so that the engine knows neither Lua nor ODE.
struct Makers {
    /// Makes the bodies of backend "sim". May be empty: a system without simulated robots needs no world.
    WorldFactory world;
    RigMaker rig;
    NetworkMaker network;  ///< may be empty: then a system of several hosts is refused
    /// Bodies of all other backends. They are in no world: neither kind of robot sees the other.
    ByBackend<BodyMaker> bodies;
    /// Names of all drivers that robots may name, also where nothing is real; empty: any.
    std::vector<std::string> drivers{};
    std::function<Expected<std::unique_ptr<Component>>(const BehaviorEntry& entry, const MakerContext& context)>
        behavior;
    /// Native components by type, then by backend.
    std::map<std::string, ByBackend<ComponentMaker>, std::less<>> components;
};

struct BuildOptions {
    std::uint64_t seed = 0;  ///< used when the system file gives none
    bool seed_wins = false;  ///< the seed counts even when the file gives one
    int threads = 1;
    bool out_of_time_is_fatal = false;
    bool real_time = false;   ///< as in `System::Settings`: for systems with a real robot
    bool keep_going = false;  ///< a behaviour that can't be made is left out, and logged, with its connections
    LogSink log;
};

/// What a system that is built so gives its makers.
MakerContext context_of(const SystemSpec& spec, const BuildOptions& options);

/// Builds the world, every entry in order and the connections, and gives parameters their values. Nothing is activated.
/// `spec` must outlive the system. Errors carry the place of the line that is wrong.
Expected<std::unique_ptr<System>> build_system(const SystemSpec& spec, const Makers& makers,
                                               const BuildOptions& options);

/// Adds one entry to a system that exists, without activating it (scenarios add while they run).
Expected<Component*> add_entry(System& system, const Entry& entry, const SystemSpec& spec, const Makers& makers);

/// Activates every component that the file does not keep inactive, in order. A component that can't be activated is in
/// ERROR; the others go on.
void activate_all(System& system, const SystemSpec& spec);

}  // namespace nezumi
