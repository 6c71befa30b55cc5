// The journal that a run writes, or the one that it performs again; or neither.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/run/options.hpp"
#include "bindings/journal/journal.hpp"
#include "bindings/journal/replay.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class RunJournal final : public Attendant {
public:
    /// Loads the system from its file, or from the journal that is replayed; it is not active yet.
    Expected<std::unique_ptr<RunningSystem>> load(const RunOptions& options, LiveOptions live);
    /// What the run should say before it begins.
    const std::vector<std::string>& notes() const { return notes_; }
    /// Follows the loop, which must outlive this.
    void follow(RunLoop& loop);

    /// The loop has ended, and the robots are about to brake: no act counts from now on.
    void stop();
    /// Whether results are those of the last tick, and not of when the robots stand: as it is here, or as it was there.
    bool is_of_given_length(bool here) const;
    /// What kept the run from going on: the journal can't be written, or tells of another run.
    const std::optional<Error>& error() const { return error_; }
    /// The last line; of a replay the last comparison.
    Expected<void> finish(bool of_given_length, std::uint64_t hash);
    /// The same for a run that ended by an error.
    void give_up(const std::string& why);
    /// `Journal::is_behind`, and its `give_up`.
    bool is_behind() const { return journal_ && journal_->is_behind(); }
    void give_up_file() {
        if (journal_) journal_->give_up();
    }

    bool serve(Pacer::Clock::time_point until) override;

private:
    void before_tick();

    RunLoop* loop_ = nullptr;
    RunningSystem* live_ = nullptr;
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<Replay> replay_;
    std::string file_;
    std::vector<std::string> notes_;
    ActTime stopped_;
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
