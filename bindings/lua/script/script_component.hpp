// A component written in Lua: one file is one component type.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/script/script.hpp"
#include "engine/components/component.hpp"

namespace nezumi {

class ScriptComponent final : public Component {
public:
    /// A component of this name from the text of its file; INACTIVE. `context.component` is set to the name.
    static Expected<std::unique_ptr<ScriptComponent>> load(std::string name, const SourceText& source,
                                                           ScriptContext context);

    int version() const override { return version_; }
    /// The first comment of its file, and what `about` says.
    ComponentAbout about() const override;
    Script& script() { return *script_; }
    const Script& script() const { return *script_; }

    const ScriptFile* script_file() const override { return &script_->file(); }
    int last_reload() const override { return past_.empty() ? 0 : past_.back().replaced_by; }
    std::span<const CommandDeclaration> commands() const override { return script_->commands(); }
    Expected<PlainData> call_command(std::string_view command, const PlainData& arguments, const Time& now) override;
    /// A copy of the script's `state`; what is no plain data is left out.
    Expected<PlainData> copy_state() const;
    Expected<PlainSnapshot> state_snapshot(const PlainLimit& limit) const override {
        return script_->state_snapshot(limit);
    }
    std::vector<TaskStatus> tasks() const override { return script_->tasks().status(now().seconds); }
    std::span<const Probe> probes() const override { return script_->probes().all(); }
    bool visit_member(std::string_view member, const LeafVisitor& visit) const override;
    /// What the script printed while it loaded is told first.
    void set_log(LogSink sink) override;

    std::int64_t trace_next() override {
        traces_next_ = true;
        return traces_ + 1;
    }
    std::int64_t traces() const override { return traces_; }
    TracedLines latest_trace() const override { return latest_trace_; }

    // The steps of a reload. None of them is of use alone: `Reloader` makes a transaction of them.

    /// Unread messages of an in-port for which a version's queue had no room.
    struct DroppedMessages {
        std::string port;
        std::vector<AnyMessage> messages;
    };

    /// A version that does not run (yet, or any more), with the ports that only it has.
    struct Version {
        std::unique_ptr<Script> script;
        int number = 0;
        Parameters parameters;
        std::vector<std::unique_ptr<InPortBase>> in_ports;
        std::vector<std::unique_ptr<OutPortBase>> out_ports;
        std::vector<DroppedMessages> dropped{};  ///< when another version came, of which the queues are shorter
        std::vector<std::string> warnings;       ///< what could not be taken over from the version before
        int replaced_by = 0;                     ///< number of the reload that replaced it
        std::string set{};                       ///< that was in use then; "": none
        std::uint64_t uses = 0;                  ///< of sets, until then
        int activation = 0;      ///< number of the activation it was active in: its tasks are of that one
        int probation_left = 0;  ///< executions that it was still on probation for
    };

    /// All that it takes to load another version of a component: a copy.
    struct Loading {
        SourceText source{};
        ScriptContext context;
        Parameters parameters{};  ///< of the version that runs, with what is staged
    };
    /// Of the next version, but for its text, and for where its modules and code are.
    Loading next_loading() const;
    /// Loads beside the ticks, in any thread. Null: its top level looks at what is of the tick, `state` or the time,
    /// and is to run in that of the commit. The modules that it required are added to `required`, also when it fails.
    static Expected<std::unique_ptr<Script>> load_beside(const Loading& loading, std::vector<ScriptFile>& required);

    /// Makes of what was loaded a version that takes over the state and the parameters of now. What is null, or was
    /// loaded with other parameters, is loaded here. Touches nothing.
    Expected<Version> prepare(const Loading& loading, std::unique_ptr<Script> loaded, const Time& now,
                              std::vector<ScriptFile>& required);
    /// Makes the ports that it needs and runs its `on_reload`. Touches nothing.
    Expected<void> adopt(Version& next, const Time& now);
    /// The ports that have no place in another version. They must be disconnected before it replaces this one.
    std::vector<Port*> ports_going(const Version& other) const;
    /// Replaces the version that runs, between two ticks; can't fail. Ports that fit stay the same objects with what
    /// they hold. The old version is kept to go back to.
    void commit(Version next, int reload);

    /// The version to go back to; null when there is none.
    const Version* version_before() const { return past_.empty() ? nullptr : &past_.back(); }
    /// Goes back to it as it was, state and what is left of its probation included. Parameters keep what was set from
    /// outside since; with `keep_settings` also what the component itself did. A set that the reload left is in use
    /// again, unless somebody has chosen another one since. Messages that a shorter queue dropped are back after
    /// a probation.
    void go_back(bool keep_settings);

    /// Executions for which a new version is on probation: when one fails, the version before takes its place.
    static constexpr int probation = 10;
    /// A failure on probation.
    struct Relapse {
        Error error;
        int version = 0;         ///< that failed
        int execution = 0;       ///< which of its executions failed, from 1
        int reload = 0;          ///< number of the reload that brought it
        bool went_back = false;  ///< the version before has run in its place already; else the component waits
    };
    /// From now on failures do not lead to ERROR.
    void begin_probation();
    bool on_probation() const { return probation_left_ > 0; }
    /// What happened, once: several where a version that came back failed in the same tick.
    std::vector<Relapse> take_relapses() { return std::exchange(relapses_, {}); }

protected:
    Expected<void> on_activated() override {
        ++activation_;
        return script_->call(Hook::on_activated);
    }
    Expected<void> on_execute() override {
        if (probation_left_ > 0) return execute_on_probation();
        return traces_next_ ? execute_traced() : script_->call(Hook::on_execute);
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

    /// The number that the next version will have.
    int next_version() const { return newest_ + 1; }
    Expected<void> execute_on_probation();
    Expected<void> execute_traced();
    void tell_early_log();
    void make_ports(Version& next) const;
    void fill_slots(Version& next) const;
    void set_queue(InPortBase& port, std::size_t queue, Version& old) const;
    void put_back(std::vector<DroppedMessages> dropped);
    Version replace(Version next);

    std::unique_ptr<Script> script_;
    int version_ = 0;
    int newest_ = 0;             // the highest number that a version had
    std::vector<Version> past_;  // oldest first
    int activation_ = 0;         // counts them
    int probation_left_ = 0;     // executions
    std::vector<Relapse> relapses_;
    bool traces_next_ = false;
    std::int64_t traces_ = 0;
    TracedLines latest_trace_{};
};

}  // namespace nezumi
