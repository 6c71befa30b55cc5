// A component: ports, parameters and OpenRTM's life cycle, the same for C++ and for scripts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/const_view.hpp"
#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/components/inside.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/port.hpp"
#include "engine/project/script_source.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// The states of OpenRTM's life cycle.
enum class LifeState : unsigned char { inactive, active, error };

/// "INACTIVE", "ACTIVE", "ERROR".
std::string_view to_text(LifeState state);

/// The callback of the life cycle that is running.
enum class Hook : unsigned char {
    none,
    on_activated,
    on_execute,
    on_deactivated,
    on_aborting,
    on_error,
    on_reset,
    on_reload,
    command
};

/// The names of callbacks in scripts; Hook::none and Hook::command have none.
std::string_view to_text(Hook hook);
/// All these names, in the order of `Hook`.
const std::vector<std::string_view>& hook_names();

/// The component's description of itself; "" for missing parts.
struct ComponentAbout {
    std::string description{}, version{}, vendor{}, category{};
};

class Component {
public:
    Component(std::string name, std::string type) : name_(std::move(name)), type_(std::move(type)) {}
    Component(const Component&) = delete;
    Component& operator=(const Component&) = delete;
    virtual ~Component() = default;

    const std::string& name() const { return name_; }
    /// The component type, for example "RobotController".
    const std::string& type() const { return type_; }
    LifeState state() const { return state_; }
    /// The number of the running version of a script, from 1; 1 for a native component.
    virtual int version() const { return 1; }
    virtual ComponentAbout about() const { return {}; }
    /// The latest error that led to ERROR, or that made a reset fail.
    const Error& last_error() const { return last_error_; }
    /// [s] The time of `last_error`.
    double failed_at() const { return failed_at_; }
    /// [s] The time of the last execution since the component was activated; negative: none.
    double executed_at() const { return executed_at_; }
    /// The error of the latest callback or command that ran out of time; none if all were in time. After such an error,
    /// the results depend on the speed of the machine. A reload that runs out of time is refused and does not count.
    const std::optional<Error>& out_of_time() const { return out_of_time_; }

    /// The component's `state` after a call that ran out of time.
    struct LeftState {
        std::optional<PlainData> data{};
        std::string lost{};  ///< which part of the state is not in `data`, and why; "" if nothing is missing
    };
    /// A call of a callback or command, counted from 1, that ran out of its time. Calls of `on_reload` do not count.
    struct OutOfTime {
        std::int64_t call = 0;
        Error error;
        LeftState left{};
    };
    /// The calls that ran out of time since this function was last called; only the first 16.
    std::vector<OutOfTime> take_out_of_time() { return std::exchange(new_out_of_time_, {}); }
    bool has_new_out_of_time() const { return !new_out_of_time_.empty(); }
    /// For a replay, which must not use the clock: the call with this number will end with this error and leave this
    /// state, however long it takes.
    void run_out_of_time_at(OutOfTime call) { foreseen_.push_back(std::move(call)); }
    /// Executions since the start.
    std::int64_t executions() const { return executions_; }

    Parameters& parameters() { return parameters_; }
    const Parameters& parameters() const { return parameters_; }
    /// The name that means "no parameter set". No set can have this name.
    static constexpr std::string_view no_set = "default";
    /// Switches to a parameter set, or to none, completely or not at all. Call it between ticks.
    Expected<void> use(std::string_view set);
    /// The parameter set in use; "" if there is none.
    const std::string& set_in_use() const { return set_in_use_; }
    /// The value of a parameter that was not set at run time: from the set in use, otherwise from the system file,
    /// otherwise the default.
    Value configured_value(const ParameterSpec& spec) const;
    /// Counts the successful calls of `use`.
    std::uint64_t uses() const { return uses_; }

    // With a constant component, ports can be read but not written.
    const std::vector<std::unique_ptr<InPortBase>>& in_ports() { return in_ports_; }
    const std::vector<std::unique_ptr<OutPortBase>>& out_ports() { return out_ports_; }
    ConstView<InPortBase> in_ports() const { return ConstView(in_ports_); }
    ConstView<OutPortBase> out_ports() const { return ConstView(out_ports_); }
    /// nullptr if there is no port with this name and direction.
    const InPortBase* find_in_port(std::string_view name) const;
    const OutPortBase* find_out_port(std::string_view name) const;
    InPortBase* find_in_port(std::string_view name) {
        return const_cast<InPortBase*>(std::as_const(*this).find_in_port(name));
    }
    OutPortBase* find_out_port(std::string_view name) {
        return const_cast<OutPortBase*>(std::as_const(*this).find_out_port(name));
    }
    /// nullptr if there is no port with this name.
    const Port* find_port(std::string_view name) const;
    Port* find_port(std::string_view name) { return const_cast<Port*>(std::as_const(*this).find_port(name)); }

    /// Visits the numbers, booleans and texts of a member that is neither port nor parameter, such as a script's
    /// "state". Returns whether the component has this member.
    virtual bool visit_member(std::string_view /*member*/, const LeafVisitor& /*visit*/) const { return false; }

    /// The file of a behaviour, which can be reloaded; null for other components.
    virtual const ScriptFile* script_file() const { return nullptr; }
    /// The number of the reload that brought the running version, if a rollback can revert it; otherwise 0.
    virtual int last_reload() const { return 0; }
    /// The commands for `call_command`.
    virtual std::span<const CommandDeclaration> commands() const { return {}; }
    virtual std::vector<TaskStatus> tasks() const { return {}; }
    /// The probes, in the order of their first use.
    virtual std::span<const Probe> probes() const { return {}; }
    /// A copy of the component's `state`, up to a limit.
    virtual Expected<PlainSnapshot> state_snapshot(const PlainLimit& /*limit*/) const {
        return PlainSnapshot{PlainData::empty_table(), 1};
    }
    /// Requests a line trace of the next execution after probation. Returns the number of this trace; 0 if the
    /// component is not a script.
    virtual std::int64_t trace_next() { return 0; }
    /// The number of the latest trace, and the trace itself.
    virtual std::int64_t traces() const { return 0; }
    virtual TracedLines latest_trace() const { return {}; }

    /// From now on, adds the run time of this component in each tick to `costs`, which must exist until then; null ends
    /// the measurement.
    void measure_ticks(TickCosts* costs) const { tick_costs_ = costs; }
    TickCosts* tick_costs() const { return tick_costs_; }

    /// Whether the component has requested an emergency stop (by a button of a gamepad) since the last call of this
    /// function.
    virtual bool take_stop() { return false; }

    /// INACTIVE to ACTIVE. In-ports start empty. An error if the component is in ERROR, or if `on_activated` failed.
    Expected<void> activate(const Time& now);
    /// ACTIVE to INACTIVE; safe values are written.
    Expected<void> deactivate(const Time& now);
    /// ERROR to INACTIVE.
    Expected<void> reset(const Time& now);
    /// Runs a command between two ticks. An error if there is no command with this name, or if the command failed; then
    /// nothing that it wrote is published.
    virtual Expected<PlainData> call_command(std::string_view command, const PlainData& arguments, const Time& now);
    /// One execution if ACTIVE, `on_error` if in ERROR. An error sends the component to ERROR.
    void execute(const Time& now);
    /// Makes staged parameter values effective, and lets the in-ports take the messages that have arrived.
    void latch_inputs(const Time& now);
    /// Publishes the messages that were written to the out-ports.
    void latch_outputs(const Time& now) {
        for (const auto& port : out_ports_) port->latch(now);
    }
    /// ACTIVE to ERROR with this error: nothing of the execution is published, `on_aborting` runs, safe values are
    /// written.
    void abort(Error error);

    /// The tick of the running callback, or of the last one.
    const Time& now() const { return now_; }
    /// [s] Time from the last execution to this one; at the first one, the period of the component's rate.
    double dt() const { return dt_; }
    /// The callback that runs now; `Hook::none` if there is none.
    Hook hook() const { return hook_; }

    /// Sets the function for log lines. A system does this when it takes the component, and adds the time of its tick.
    virtual void set_log(LogSink sink) { log_ = std::move(sink); }
    void log(LogLevel level, std::string text) const;
    /// Sets the tick rate [Hz]. The system of the component calls this.
    void set_tick_rate(double hertz) { tick_rate_ = hertz; }
    double tick_rate() const { return tick_rate_; }

protected:
    virtual Expected<void> on_activated() { return {}; }
    virtual Expected<void> on_execute() { return {}; }
    virtual Expected<void> on_deactivated() { return {}; }
    virtual Expected<void> on_aborting() { return {}; }
    virtual Expected<void> on_error() { return {}; }
    virtual Expected<void> on_reset() { return {}; }
    /// The state after a call that ran out of time. In a replay, `restore` sets the recorded state instead.
    virtual LeftState left_state() { return {}; }
    virtual void restore(const PlainData& /*left*/) {}
    /// What failed if `on_aborting` returned an error, for the log line "... failed: ERROR".
    virtual std::string_view failed_at_aborting() const { return to_text(Hook::on_aborting); }

    /// Adds a port. The reference is valid as long as the component has the port.
    template <Payload T>
    InPort<T>& add_in_port(std::string name, std::string doc = "", std::size_t queue = 0) {
        auto port = std::make_unique<InPort<T>>(std::move(name), std::move(doc), queue);
        InPort<T>& reference = *port;
        in_ports_.push_back(std::move(port));
        return reference;
    }
    template <Payload T>
    OutPort<T>& add_out_port(std::string name, std::string doc = "") {
        auto port = std::make_unique<OutPort<T>>(std::move(name), std::move(doc));
        OutPort<T>& reference = *port;
        out_ports_.push_back(std::move(port));
        return reference;
    }

    /// Sets the name of the parameter set in use. For reloads and rollbacks, which add or remove the values themselves.
    void note_set_in_use(std::string set) { set_in_use_ = std::move(set); }
    /// Sets `now` between ticks, for code that is not part of the life cycle.
    void set_now(const Time& now) { now_ = now; }
    /// Runs a function as the callback `hook`. Calls may be nested; each has its own time limit.
    template <class Function>
    auto run(Hook hook, Function&& function) {
        const Hook before = std::exchange(hook_, hook);
        const std::int64_t call = hook == Hook::on_reload ? 0 : ++calls_;
        auto result = function();
        hook_ = before;
        if (call == 0) return result;
        if (!foreseen_.empty()) take_foreseen(call, [&](const Error& error) { result = Unexpected(error); });
        if (!result && result.error().kind == Error::Kind::out_of_time)
            note_out_of_time({call, result.error(), left_state()});
        return result;
    }

private:
    void note_out_of_time(OutOfTime ended);
    template <class End>
    void take_foreseen(std::int64_t call, const End& end) {
        const auto is_due = [call](const OutOfTime& each) { return each.call == call; };
        const auto found = std::find_if(foreseen_.begin(), foreseen_.end(), is_due);
        if (found == foreseen_.end()) return;
        end(found->error);
        if (found->left.data) restore(*found->left.data);
        foreseen_.erase(found);
    }
    /// Discards velocities that `hook` wrote, but no earlier ones.
    Expected<void> run_without_velocities(Hook hook);

    std::string name_;
    std::string type_;
    std::string set_in_use_;
    std::uint64_t uses_ = 0;
    LogSink log_;
    Error last_error_;
    double failed_at_ = 0;

public:
    /// The component's location in the system file.
    Place place;
    /// Parameter sets of the system file.
    std::map<std::string, ParameterValues, std::less<>> sets;
    /// Values of the system file, for parameters to which the set in use gives no value.
    ParameterValues configured;

private:
    std::vector<OutOfTime> new_out_of_time_;
    std::optional<Error> out_of_time_;
    // The members below are used in every tick.
    std::vector<OutOfTime> foreseen_;
    std::int64_t calls_ = 0;
    Time now_;
    double dt_ = 0;
    double tick_rate_ = 100;
    double executed_at_ = -1;
    std::int64_t executions_ = 0;
    mutable TickCosts* tick_costs_ = nullptr;
    LifeState state_ = LifeState::inactive;
    Hook hook_ = Hook::none;
    bool error_hook_failed_ = false;

public:
    /// Executions per second [Hz], at most the rate of ticks; 0: one in every tick.
    double rate = 0;

protected:
    std::vector<std::unique_ptr<InPortBase>> in_ports_;
    std::vector<std::unique_ptr<OutPortBase>> out_ports_;
    Parameters parameters_;
};

/// A component with a connection to the outside: it senses before the behaviours of a tick and acts after them.
class Device : public Component {
public:
    using Component::Component;
    /// Writes the out-ports from the outside. Called in every tick and every state.
    virtual void sense(const Time& now) = 0;
    /// Acts on the values of the in-ports. Called in every tick and every state; the device must not move unless it is
    /// ACTIVE.
    virtual void actuate(const Time& now) = 0;
};

}  // namespace nezumi
