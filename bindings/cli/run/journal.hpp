// The journal that a run writes or replays, or neither.
#pragma once

#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/files/recorded_system.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/journal/journal.hpp"
#include "bindings/journal/replay.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

/// The journal in the folder of a failed scenario.
inline constexpr std::string_view failure_journal = "run.journal";
/// A file in the folder of a failed scenario that tested a recording: the path of the recording, and the start and tick
/// of the failure as "START TICK".
inline constexpr std::string_view failed_recording = "recording.txt";

class RunJournal final : public Attendant {
public:
    /// Loads the system from its file, or from the replayed journal. It is not active yet. If `recording` is
    /// not empty, it gets the journal as well.
    Expected<std::unique_ptr<RunningSystem>> load(const RunOptions& options, LiveOptions live, JournalSink recording);
    /// Messages to show before the run starts.
    const std::vector<std::string>& notes() const { return notes_; }
    /// The conditions of a failed scenario that is opened, one line for each.
    const std::vector<std::string>& conditions() const { return conditions_; }
    /// Runs the opened replay to its end; from then on this is a normal run. Stops early when `end` is not 0.
    Expected<void> go_to_end(const volatile std::sig_atomic_t& end);
    /// Follows the loop, which must outlive this object.
    void follow(RunLoop& loop);

    /// Called when the loop has ended, before the robots brake: later acts are not recorded.
    void stop();
    /// True if the results are those of the last tick of the run, not those after the robots have braked. A replay does
    /// as the replayed run; `here` is the answer for other runs.
    bool is_of_given_length(bool here) const;
    /// The error that ended the run: the journal can't be written, or differs from the run.
    const std::optional<Error>& error() const { return error_; }
    /// Writes the last line, or makes the last comparison of a replay.
    Expected<void> finish(bool of_given_length, std::uint64_t hash);
    /// Like `finish`, for a run that ended with an error.
    void give_up(const std::string& why);
    /// See `Journal::is_behind` and its `give_up`.
    bool is_behind() const { return journal_ && journal_->is_behind(); }
    void give_up_file() {
        if (journal_) journal_->give_up();
    }

    bool serve(Pacer::Clock::time_point until) override;

private:
    void before_tick();
    Expected<void> find_failure();
    Expected<void> find_failed_recording(const std::filesystem::path& note);
    Expected<std::unique_ptr<RunningSystem>> open_recorded(const LiveOptions& live);

    RunLoop* loop_ = nullptr;
    RunningSystem* live_ = nullptr;
    std::unique_ptr<Journal> journal_;
    std::unique_ptr<Replay> replay_;
    std::unique_ptr<Replay> opened_;            // a replay that was performed; the system uses its files
    std::unique_ptr<RecordedSystem> recorded_;  // an opened recording whose messages are played
    std::string file_;
    std::optional<Seek> failed_at_;  // the failure of a scenario that tested a recording
    std::vector<std::string> notes_, conditions_;
    ActTime stopped_;
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
