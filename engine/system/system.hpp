// A system: components, their connections, and the tick that runs them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/base/const_view.hpp"
#include "engine/components/component.hpp"
#include "engine/robot/robot.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/groups.hpp"
#include "engine/system/rig.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/system/wiring.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Network;
class WorkerPool;

/// The time of the monotonic clock [s].
double monotonic_seconds();

class System;

/// Observes the messages of ports.
class PortObserver {
public:
    virtual ~PortObserver() = default;
    /// Called after all ports have latched in the tick `system.now()`. The world has not advanced since the sensors
    /// were read.
    virtual void latched(const System& system) = 0;
};

class System {
public:
    struct Settings {
        double rate = 100;            ///< [Hz] of the tick
        double physics_step = 0.005;  ///< [s]
        std::uint64_t seed = 0;
        int threads = 1;                    ///< threads that sense and execute; the result does not depend on it
        bool out_of_time_is_fatal = false;  ///< a script that runs out of time ends the run, instead of going to ERROR
        /// True with real robots: time is that of `clock`, so a stall is visible. Otherwise a tick lasts 1 / rate.
        bool real_time = false;
        std::function<double()> clock = monotonic_seconds;  ///< [s] any origin, never goes back
    };

    /// `settings` must have been accepted by `steps_per_tick`.
    System(const Settings& settings, LogSink log);
    ~System();
    System(const System&) = delete;
    System& operator=(const System&) = delete;

    /// Sets the world of the robots, which advances with each tick. Call it once, before any robot is added.
    void take_world(std::unique_ptr<World> world);
    World* world() { return world_.get(); }
    const World* world() const { return world_.get(); }

    /// Sets the test rig for real robots. Call it once, before any robot is added.
    void take_rig(Rig rig) { rig_ = std::move(rig); }
    /// nullptr if there is none.
    Rig* rig() { return rig_ ? &*rig_ : nullptr; }
    const Rig* rig() const { return rig_ ? &*rig_ : nullptr; }

    /// Sets the network. Call it once, before any connection to other hosts.
    void take_network(std::unique_ptr<Network> network);
    /// nullptr if there is none.
    Network* network() { return network_.get(); }
    const Network* network() const { return network_.get(); }

    /// Adds a component, which is INACTIVE at first. An error if the name is taken or invalid.
    Expected<Component*> add(std::unique_ptr<Component> component);
    /// Deactivates a component, publishes its safe values, disconnects and destroys it.
    Expected<void> remove(std::string_view name);

    // With a constant system, everything can be read but not changed.
    const std::vector<std::unique_ptr<Component>>& components() { return components_; }
    ConstView<Component> components() const { return ConstView(components_); }
    const std::vector<Robot*>& robots() { return robots_; }
    std::span<const Robot* const> robots() const { return robots_; }
    /// The connections between ports of this system, as in a system file but without locations.
    std::vector<ConnectionSpec> connections() const;
    /// The connections with a port of another program, in the order of the requests. The library for that kind of
    /// program makes them, while the program is there.
    const std::vector<ConnectionSpec>& foreign_connections() const { return foreign_; }
    /// Checks whether a connection with a port of another program is possible.
    using ForeignCheck = std::function<Expected<void>(const System& system, const ConnectionSpec& connection)>;
    void take_foreign_check(ForeignCheck check) { foreign_check_ = std::move(check); }
    /// nullptr if there is none with this name.
    Component* find(std::string_view name) { return find_component(name); }
    const Component* find(std::string_view name) const { return find_component(name); }
    const Robot* find_robot(std::string_view name) const;
    /// The component with this name, or an error with the nearest name.
    Expected<Component*> component(std::string_view name) { return component_named(name); }
    Expected<const Component*> component(std::string_view name) const { return component_named(name); }
    /// The port "name.port", or an error with the nearest name.
    Expected<Port*> port(std::string_view path) { return port_named(path); }
    Expected<const Port*> port(std::string_view path) const { return port_named(path); }

    /// Connects "name.port" to "name.port"; the error has the reason. One of them may be another host's,
    /// "host/name.port", or another program's, "WORD:NAME.port".
    Expected<void> connect(std::string_view from, std::string_view to);
    Expected<void> disconnect(std::string_view from, std::string_view to);
    /// "name.port" of the ports at the other ends.
    std::vector<std::string> peers(const Port& port) const { return wiring_.peers(port); }
    /// Like `peers(port)`, and also the ports of other programs, "WORD:NAME.port".
    std::vector<std::string> peers(const Component& component, const Port& port) const;
    /// A connection that has been dropped.
    struct Dropped {
        std::string from, to;      ///< "name.port"
        std::uint64_t number = 0;  ///< number of the connection, for its position among all
    };
    /// Removes all connections of a port that will be destroyed.
    std::vector<Dropped> disconnect_all(const Port& port);
    /// Ends all connections of a port with other programs: "name.port", or another program's "WORD:NAME.port". Returns
    /// whether there were any.
    bool disconnect_foreign(std::string_view end);
    /// Makes a dropped connection again, at its former place among the connections.
    Expected<void> connect_again(const Dropped& dropped);

    /// The actor that holds, drops or freezes the port "name.port"; nullptr if there is none.
    const Actor* holder(std::string_view path) const;
    void set_holder(std::string_view path, const Actor& who) { holders_.insert_or_assign(std::string(path), who); }
    /// The ports that this actor holds, drops or freezes, sorted.
    std::vector<std::string> held_by(const Actor& who) const;

    /// Every robot brakes as hard as it can; then its motors are switched off. Behaviours continue, but their commands
    /// to robots are ignored.
    void emergency_stop();
    /// Robots obey new commands again. An error without an emergency stop, or while a robot still moves.
    Expected<void> rearm();
    bool is_stopped() const { return stopped_; }
    const Wiring& wiring() const { return wiring_; }

    /// One tick.
    void tick();
    /// At rest only devices run in a tick, and robots brake and stand. Used to pause real robots.
    void set_at_rest(bool at_rest);
    bool is_at_rest() const { return at_rest_; }
    /// The time of the next tick, which is the present time for conditions and the console.
    const Time& now() const { return now_; }
    /// The time of the last tick; before the first, as `now`.
    const Time& last_tick() const { return last_tick_; }
    const Settings& settings() const { return settings_; }
    /// Deactivates everything, last first, and lets robots brake: in `brake_ticks` ticks only devices run.
    void stop(int brake_ticks);
    /// The error that ended the run, if there is one.
    const std::optional<Error>& fatal_error() const { return fatal_error_; }
    /// Ends the run with this error, unless the run already has a fatal error.
    void fail(const Error& why) {
        if (!fatal_error_) fatal_error_ = why;
    }

    /// Adds an observer for all further ticks; observers are called in this order. The observer must outlive the system
    /// or be removed.
    void observe(PortObserver& observer) { observers_.push_back(&observer); }
    void stop_observing(PortObserver& observer) { std::erase(observers_, &observer); }

    /// A number that changes when a component or a port is added or removed, for caches. No two systems have the same
    /// number.
    std::uint64_t layout() const { return layout_; }
    /// Call this before ports of a component change.
    void change_layout() { layout_ = new_layout(); }

    void log(LogLevel level, std::string text) const;

private:
    static std::uint64_t new_layout();
    double seconds_at(std::int64_t tick) const;
    void pass_left_out_ticks();
    bool is_due(const Component& component) const;
    Expected<void> reach(std::string_view from, std::string_view to);
    Expected<void> connect_foreign(ConnectionSpec wanted);
    template <class ForEach>
    void run_phases(const Group& group, const ForEach& for_each);
    void run_groups();
    template <class Action>
    void share_out(std::size_t count, const Action& action);
    void flush_logs();
    Expected<Connection> wire(std::string_view from, std::string_view to, std::optional<std::uint64_t> number);
    void end_when_out_of_time();
    void step(World* world);
    Component* find_component(std::string_view name) const;
    Expected<Component*> component_named(std::string_view name) const;
    Expected<Port*> port_named(std::string_view path) const;
    Expected<std::pair<Component*, std::string>> split(std::string_view path) const;

    Settings settings_;
    int steps_per_tick_;
    LogSink log_;
    double started_at_;  // [s] by the clock
    bool at_rest_ = false;
    Time now_;
    Time last_tick_;
    std::unique_ptr<World> world_;  // before the components: the bodies of robots must not outlive it
    std::optional<Rig> rig_;
    std::unique_ptr<Network> network_;  // before the components: components of other hosts belong to it
    std::vector<std::unique_ptr<Component>> components_;
    std::unordered_map<std::string_view, Component*> by_name_;
    std::vector<Robot*> robots_;  // in the order of components_
    Wiring wiring_;
    std::vector<ConnectionSpec> foreign_;
    ForeignCheck foreign_check_;
    std::vector<Group> groups_;
    std::uint64_t layout_ = new_layout();
    bool grouped_ = false;                               // whether groups_ is up to date with components_ and wiring_
    std::map<std::string, Actor, std::less<>> holders_;  // by "name.port"; of a port without override: its last holder
    bool stopped_ = false;
    std::atomic<bool> out_of_time_ = false;
    std::vector<PortObserver*> observers_;
    std::unique_ptr<WorkerPool> workers_;
    mutable std::vector<std::vector<LogLine>> worker_logs_;
    std::optional<Error> fatal_error_;
};

}  // namespace nezumi
