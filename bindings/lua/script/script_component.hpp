// A component written in Lua: one file is one component type.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/line_profile.hpp"
#include "bindings/lua/sandbox/line_trace.hpp"
#include "bindings/lua/script/script.hpp"
#include "engine/components/component.hpp"

namespace nezumi {

class ScriptComponent final : public Component {
public:
    /// Makes a component with this name from the text of its file. The component is INACTIVE. `context.component` is
    /// set to the name.
    static Expected<std::unique_ptr<ScriptComponent>> load(std::string name, const SourceText& source,
                                                           ScriptContext context);

    int version() const override { return version_; }
    /// The first comment of its file, and the values of `about`.
    ComponentAbout about() const override;
    Script& script() { return *script_; }
    const Script& script() const { return *script_; }

    const ScriptFile* script_file() const override { return &script_->file(); }
    int last_reload() const override { return past_.empty() ? 0 : past_.back().replaced_by; }
    std::span<const CommandDeclaration> commands() const override { return script_->commands(); }
    Expected<PlainData> call_command(std::string_view command, const PlainData& arguments, const Time& now) override;
    /// A copy of the script's `state`, without values that are not plain data.
    Expected<PlainData> copy_state() const;
    Expected<PlainSnapshot> state_snapshot(const PlainLimit& limit) const override {
        return script_->state_snapshot(limit);
    }
    std::vector<TaskStatus> tasks() const override { return script_->tasks().status(now().seconds); }
    std::span<const Probe> probes() const override { return script_->probes().all(); }
    bool visit_member(std::string_view member, const LeafVisitor& visit) const override;
    /// Sends what the script logged while it loaded, then all further lines.
    void set_log(LogSink sink) override;

    std::int64_t trace_next() override {
        traces_next_ = true;
        return traces_ + 1;
    }
    std::int64_t traces() const override { return traces_; }
    TracedLines latest_trace() const override { return latest_trace_; }

    // Observes executions without changing them. The caller that begins an observation must also end it.

    /// From now on, records each time that one of these lines runs (see `hits`), and a trace of each execution. An
    /// empty list ends this for the owner.
    void watch_lines(const void* owner, std::vector<LineTrace::Watched> lines) const;
    /// The watched lines in the execution of `latest_trace`.
    const std::vector<LineTrace::Hit>& hits() const { return hits_; }
    /// Measures each execution from now on. `profile` must exist until this is ended, by a call with null.
    void measure_with(ExecutionProfile* profile) const { profile_ = profile; }

    // The steps of a reload. They are only useful together: `Reloader` makes a transaction of them.

    /// Unread messages of an in-port for which a version's queue had no room.
    struct DroppedMessages {
        std::string port;
        std::vector<AnyMessage> messages;
    };

    /// A version that does not run now, with the ports that only this version has.
    struct Version {
        std::unique_ptr<Script> script;
        int number = 0;
        Parameters parameters;
        std::vector<std::unique_ptr<InPortBase>> in_ports;
        std::vector<std::unique_ptr<OutPortBase>> out_ports;
        std::vector<DroppedMessages> dropped{};  ///< when a version with shorter queues replaced this one
        std::vector<std::string> warnings;       ///< parts of the version before that could not be taken over
        int replaced_by = 0;                     ///< number of the reload that replaced it
        std::string set{};                       ///< the parameter set that was in use then; "": none
        std::uint64_t uses = 0;                  ///< how often a parameter set had been chosen until then
        int activation = 0;  ///< number of the activation in which it was active: its tasks belong to this activation
        int probation_left = 0;  ///< remaining executions of its probation
    };

    /// A copy of everything that is needed to load another version of a component.
    struct Loading {
        SourceText source{};
        ScriptContext context;
        Parameters parameters{};  ///< of the running version, with values that are set for the next tick
    };
    /// The context of the next version. The caller must add its text, the finders of modules and messages, and the code
    /// cache.
    Loading next_loading() const;
    /// Loads a version in any thread, while ticks go on. Null: its top level reads `state` or the time, so it must be
    /// loaded in the tick of the commit. `required` gets the files of modules and messages that were read, also after
    /// an error.
    static Expected<std::unique_ptr<Script>> load_beside(const Loading& loading, std::vector<ScriptFile>& required);

    /// Makes a version that takes over the present state and parameters. Loads the script itself if `loaded` is null,
    /// or was loaded with other parameters. Does not change the running version.
    Expected<Version> prepare(const Loading& loading, std::unique_ptr<Script> loaded, const Time& now,
                              std::vector<ScriptFile>& required);
    /// Makes the ports that `next` needs and calls its `on_reload`. Does not change the running version.
    Expected<void> adopt(Version& next, const Time& now);
    /// The ports that do not exist in another version. They must be disconnected before that version replaces this one.
    std::vector<Port*> ports_going(const Version& other) const;
    /// Replaces the running version between two ticks; can't fail. Ports that fit stay the same objects and keep their
    /// messages. The old version is kept.
    void commit(Version next, int reload);

    /// The version before; null if there is none.
    const Version* version_before() const { return past_.empty() ? nullptr : &past_.back(); }
    /// Goes back to the version before, with its state and the rest of its probation. Parameters keep values that were
    /// set from outside since then; with `keep_settings` also values that the component set. A parameter set that the
    /// reload left is in use again, unless another one was chosen since. If this version is on probation, messages that
    /// its shorter queues dropped are put back.
    void go_back(bool keep_settings);

    /// Number of executions in the probation of a new version: if one fails, the version before replaces it.
    static constexpr int probation = 10;
    /// A failure during probation.
    struct Relapse {
        Error error;
        int version = 0;         ///< the number of the failed version
        int execution = 0;       ///< number of the failed execution, from 1
        int reload = 0;          ///< number of the reload that brought the version
        bool went_back = false;  ///< the version before has already run in this tick; otherwise the component waits
    };
    /// During the next `probation` executions, an error leads back to the version before, and not to ERROR.
    void begin_probation();
    bool on_probation() const { return probation_left_ > 0; }
    /// The failures since the last call of this function. There are several if a version that came back failed in the
    /// same tick.
    std::vector<Relapse> take_relapses() { return std::exchange(relapses_, {}); }

protected:
    Expected<void> on_activated() override {
        ++activation_;
        return script_->call(Hook::on_activated);
    }
    Expected<void> on_execute() override {
        if (profile_ != nullptr) return execute_measured();
        if ((++executions_ & (measured_executions - 1)) == 0) return execute_checked();
        return execute_once();
    }
    Expected<void> on_deactivated() override { return script_->call(Hook::on_deactivated); }
    Expected<void> on_aborting() override { return script_->call(Hook::on_aborting); }
    Expected<void> on_error() override { return script_->call(Hook::on_error); }
    Expected<void> on_reset() override { return script_->call(Hook::on_reset); }
    LeftState left_state() override;
    void restore(const PlainData& left) override;
    std::string_view failed_at_aborting() const override {
        return script_->tasks().ends() ? "the end of its tasks" : Component::failed_at_aborting();
    }

private:
    ScriptComponent(std::string name, std::string type) : Component(std::move(name), std::move(type)) {}

    /// The number of the next version.
    int next_version() const { return newest_ + 1; }
    // One of this many executions is measured for a hint; a power of 2.
    static constexpr std::uint32_t measured_executions = 64;

    Expected<void> execute_once() {
        if (probation_left_ > 0) return execute_on_probation();
        return traces_next_ || !watched_.empty() ? execute_traced() : script_->call(Hook::on_execute);
    }
    Expected<void> execute_on_probation();
    Expected<void> execute_traced();
    Expected<void> execute_measured();
    Expected<void> execute_checked();
    void tell_early_log();
    void make_ports(Version& next) const;
    void fill_slots(Version& next) const;
    void set_queue(InPortBase& port, std::size_t queue, Version& old) const;
    void put_back(std::vector<DroppedMessages> dropped);
    Version replace(Version next);

    std::unique_ptr<Script> script_;
    int version_ = 0;
    int newest_ = 0;             // the highest number of a version
    std::vector<Version> past_;  // oldest first
    int activation_ = 0;         // number of activations
    int probation_left_ = 0;     // remaining executions
    std::vector<Relapse> relapses_;
    bool traces_next_ = false;
    std::int64_t traces_ = 0;
    TracedLines latest_trace_{};
    mutable std::map<const void*, std::vector<LineTrace::Watched>> watched_{};  // by owner
    std::vector<LineTrace::Hit> hits_{};
    mutable ExecutionProfile* profile_ = nullptr;
    std::uint32_t executions_ = 0;
    int slow_executions_ = 0;  // consecutive slow ones of the measured executions; -1: already reported
};

}  // namespace nezumi
