// A system: components, their wiring, and the tick that runs them.
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

/// [s] of the monotonic clock.
double monotonic_seconds();

class System;

/// Looks at what ports carry.
class PortObserver {
public:
    virtual ~PortObserver() = default;
    /// All ports have latched for the tick `system.now()`, and the world is still as it was sensed.
    virtual void latched(const System& system) = 0;
};

class System {
public:
    struct Settings {
        double rate = 100;            ///< [Hz] of the tick
        double physics_step = 0.005;  ///< [s]
        std::uint64_t seed = 0;
        int threads = 1;                    ///< that sense and execute; the result is the same with any number
        bool out_of_time_is_fatal = false;  ///< a script that ran out of time ends the run instead of going to ERROR
        /// Real robots are driven: time is that of `clock`, and a stall is seen by all. Else a tick lasts 1 / rate.
        bool real_time = false;
        std::function<double()> clock = monotonic_seconds;  ///< [s] since anything, never backwards
    };

    /// `settings` must have passed `steps_per_tick`.
    System(const Settings& settings, LogSink log);
    ~System();
    System(const System&) = delete;
    System& operator=(const System&) = delete;

    /// The world that robots live in and that a tick advances; given once, before any robot.
    void take_world(std::unique_ptr<World> world);
    World* world() { return world_.get(); }
    const World* world() const { return world_.get(); }

    /// What sees real robots from outside; given once, before any robot.
    void take_rig(Rig rig) { rig_ = std::move(rig); }
    /// nullptr when there is none.
    Rig* rig() { return rig_ ? &*rig_ : nullptr; }
    const Rig* rig() const { return rig_ ? &*rig_ : nullptr; }

    /// What reaches other hosts; given once, before any connection to them.
    void take_network(std::unique_ptr<Network> network);
    /// nullptr when there is none.
    Network* network() { return network_.get(); }
    const Network* network() const { return network_.get(); }

    /// Adds a component; an error when the name is taken or no name. It is INACTIVE until it is activated.
    Expected<Component*> add(std::unique_ptr<Component> component);
    /// Deactivates a component, lets its safe values through, disconnects and destroys it.
    Expected<void> remove(std::string_view name);

    // Whoever has a constant system can look at everything in it and change nothing.
    const std::vector<std::unique_ptr<Component>>& components() { return components_; }
    ConstView<Component> components() const { return ConstView(components_); }
    const std::vector<Robot*>& robots() { return robots_; }
    std::span<const Robot* const> robots() const { return robots_; }
    /// As a system file says them, without places: those between ports of this system.
    std::vector<ConnectionSpec> connections() const;
    /// Those with a port of another program at one end, in the order in which they were asked for. They are made and
    /// carried elsewhere, as long as that program is there.
    const std::vector<ConnectionSpec>& foreign_connections() const { return foreign_; }
    /// Says whether there can be such a connection.
    using ForeignCheck = std::function<Expected<void>(const System& system, const ConnectionSpec& connection)>;
    void take_foreign_check(ForeignCheck check) { foreign_check_ = std::move(check); }
    /// nullptr when there is none of this name.
    Component* find(std::string_view name) { return find_component(name); }
    const Component* find(std::string_view name) const { return find_component(name); }
    const Robot* find_robot(std::string_view name) const;
    /// The component of this name, or an error that names the nearest.
    Expected<Component*> component(std::string_view name) { return component_named(name); }
    Expected<const Component*> component(std::string_view name) const { return component_named(name); }
    /// The port "name.port", or an error that names the nearest.
    Expected<Port*> port(std::string_view path) { return port_named(path); }
    Expected<const Port*> port(std::string_view path) const { return port_named(path); }

    /// Connects "name.port" to "name.port", or says why not. One of them may be another host's, "host/name.port", or
    /// another program's, "rtm:NAME.port".
    Expected<void> connect(std::string_view from, std::string_view to);
    Expected<void> disconnect(std::string_view from, std::string_view to);
    /// "name.port" of the ports at the other ends.
    std::vector<std::string> peers(const Port& port) const { return wiring_.peers(port); }
    /// The same with those of other programs, "rtm:NAME.port".
    std::vector<std::string> peers(const Component& component, const Port& port) const;
    /// A connection that has been dropped.
    struct Dropped {
        std::string from, to;      ///< "name.port"
        std::uint64_t number = 0;  ///< its place among all
    };
    /// Drops every connection of a port, which is about to go.
    std::vector<Dropped> disconnect_all(const Port& port);
    /// Ends all connections with other programs of one end, "name.port" or "rtm:NAME.port". Returns whether there were
    /// any.
    bool disconnect_foreign(std::string_view end);
    /// Makes it again, in its former place among the connections.
    Expected<void> connect_again(const Dropped& dropped);

    /// Who holds the port "name.port", or has it dropped or frozen; nullptr for nobody.
    const Actor* holder(std::string_view path) const;
    void set_holder(std::string_view path, const Actor& who) { holders_.insert_or_assign(std::string(path), who); }
    /// The ports that this one holds, drops or freezes, sorted.
    std::vector<std::string> held_by(const Actor& who) const;

    /// Every robot brakes as hard as it can; then its motors have no power. Behaviours go on, their commands to robots
    /// are ignored.
    void emergency_stop();
    /// Robots obey again what comes from now on. An error when nothing was stopped, or while a robot still moves.
    Expected<void> rearm();
    bool is_stopped() const { return stopped_; }

    /// One tick.
    void tick();
    /// At rest only devices have their turns in a tick, and robots brake and stand: what a pause of real robots is.
    void set_at_rest(bool at_rest);
    /// The tick that comes next: what conditions and the console call now.
    const Time& now() const { return now_; }
    /// The tick that came last; as `now` before the first.
    const Time& last_tick() const { return last_tick_; }
    const Settings& settings() const { return settings_; }
    /// Deactivates everything, last first, and lets the robots brake: `brake_ticks` ticks in which only devices act.
    void stop(int brake_ticks);
    /// What ended the run, when something did.
    const std::optional<Error>& fatal_error() const { return fatal_error_; }
    /// Ends the run with this error, where none has ended it.
    void fail(const Error& why) {
        if (!fatal_error_) fatal_error_ = why;
    }

    /// Tells an observer of every tick from now on, in the order of these calls. It must outlive the system or be
    /// removed.
    void observe(PortObserver& observer) { observers_.push_back(&observer); }
    void stop_observing(PortObserver& observer) { std::erase(observers_, &observer); }

    /// Changes whenever a component or a port comes or goes: tells a cache that it is out of date.
    std::uint64_t layout() const { return layout_; }
    /// To be called before ports of a component change.
    void change_layout() { ++layout_; }

    void log(LogLevel level, std::string text) const;

private:
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
    std::unique_ptr<World> world_;  // before the components: robots' bodies must not outlive it
    std::optional<Rig> rig_;
    std::unique_ptr<Network> network_;  // before the components: those of other hosts are its
    std::vector<std::unique_ptr<Component>> components_;
    std::unordered_map<std::string_view, Component*> by_name_;
    std::vector<Robot*> robots_;  // in the order of components_
    Wiring wiring_;
    std::vector<ConnectionSpec> foreign_;
    ForeignCheck foreign_check_;
    std::vector<Group> groups_;
    std::uint64_t layout_ = 0;
    bool grouped_ = false;                               // whether groups_ are those of components_ and wiring_
    std::map<std::string, Actor, std::less<>> holders_;  // by "name.port"; of one that nothing is put on: whose it was
    bool stopped_ = false;
    std::atomic<bool> out_of_time_ = false;
    std::vector<PortObserver*> observers_;
    std::unique_ptr<WorkerPool> workers_;
    mutable std::vector<std::vector<LogLine>> worker_logs_;
    std::optional<Error> fatal_error_;
};

}  // namespace nezumi
