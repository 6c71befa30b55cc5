// The events of a run and of its branches, from which each of their moments can be computed again.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/components/component.hpp"
#include "engine/project/project_files.hpp"
#include "engine/system/act.hpp"
#include "engine/system/actor.hpp"

namespace nezumi {

/// The time of an act: the start, the next tick, and its number among all acts.
struct ActTime {
    int start = 1;
    std::int64_t tick = 0;
    std::int64_t sequence = 0;
    bool operator==(const ActTime&) const = default;
};

/// Whether `a` is at an earlier tick than `b`.
constexpr bool is_earlier(const ActTime& a, const ActTime& b) {
    return a.start != b.start ? a.start < b.start : a.tick < b.tick;
}

/// True if the run can't be computed again without this act: it succeeded, or it ran a script's hook or command.
bool is_of_history(const Act& act, bool succeeded);

/// An act, and the files that it read. Never changed after it was made, because journals write it later.
struct PastAct {
    Act act;
    Actor who;
    bool failed = false;
    FilesSeen files{};
};
/// A call into a script that ran out of time.
struct PastCall {
    std::string component;
    Component::OutOfTime call;
};
/// The trace hash at this tick.
struct PastHash {
    std::uint64_t hash = 0;
};
struct PastEvent {
    ActTime when;
    std::variant<std::shared_ptr<const PastAct>, std::shared_ptr<const PastCall>, PastHash> what;
};

class RunHistory {
public:
    /// One branch of the run. It has the first events of its parent, and then its own.
    struct Branch {
        std::string name;           ///< "main", "branch 1", ...
        std::size_t parent = 0;     ///< index of the branch from which it split off; itself for the first one
        std::size_t inherited = 0;  ///< number of events of the parent that are also its own
        ActTime left{};             ///< when it split off
        ActTime end{};              ///< how far it has come
        double seconds = 0;         ///< [s] time of the end, since its start
        std::deque<PastEvent> own{};

        std::size_t size() const { return inherited + own.size(); }
    };

    /// Begins the history of a run that has read these files at its start.
    void begin(FilesSeen files);
    /// For a run that can't go back: of the latest acts, only the kind and the actor remain, and nothing of the others.
    void cut();
    /// The files that the run has read at its start.
    const FilesSeen& files() const { return files_; }

    /// Memory for the events [bytes]: nearly all of it is for messages that come from outside. The past can be computed
    /// only with all of them. If they need more, the history is cut, and the run can't go back any more.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;
    /// The number of events that a branch of a history that was cut keeps.
    static constexpr std::size_t most_latest = 1000;

    /// Adds an event of the present. If the present is a past moment whose future is known, a new branch starts here.
    void add(PastEvent event);
    /// Whether events were dropped, so that no past can be computed any more.
    bool is_cut() const { return is_cut_; }
    /// Sets how far the present has come.
    void reach(const ActTime& now, double seconds);
    /// Leaves the present for a moment of a branch at which its first `events` have happened.
    void go_to(std::size_t branch, std::size_t events) { current_ = branch, position_ = events; }

    /// Whether the present is a past moment whose future is known: `now` is before the end of the branch.
    bool is_past(const ActTime& now) const;
    /// The next known event if it is due at this tick, or null.
    const PastEvent* due(const ActTime& now) const;
    /// Marks the due event as happened.
    void pass() { ++position_; }

    /// The number of events of the present branch that have happened.
    std::size_t position() const { return position_; }
    /// One branch with all its inherited events, as a separate history at its start.
    RunHistory course(std::size_t branch) const;

    /// Event `index` of a branch, in the order in which they happened.
    const PastEvent& event(std::size_t branch, std::size_t index) const;
    const std::vector<Branch>& branches() const { return branches_; }
    std::size_t current() const { return current_; }
    std::optional<std::size_t> find(std::string_view name) const;
    /// The tick at which `restart()` ended a start of a branch; nothing if it did not.
    std::optional<std::int64_t> end_of_start(int start, std::size_t branch) const;

private:
    FilesSeen files_;
    std::vector<Branch> branches_{{.name = "main"}};
    std::size_t current_ = 0;
    std::size_t position_ = 0;  // number of events of the current branch that have happened
    std::size_t bytes_ = 0;     // of all events
    bool is_cut_ = false;
};

}  // namespace nezumi
