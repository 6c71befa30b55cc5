// The results of a run: its recording, its picture, its trace hash.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bindings/cli/run/mcap_recorder.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/run_recording.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/trajectories.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class RunResults {
public:
    /// Opens an MCAP recording before the system is loaded, because it gets the journal too. An error says why the file
    /// can't be written.
    Expected<void> prepare(const RunOptions& options);
    /// The function that takes the journal for this recording; empty if there is none.
    JournalSink journal_sink();
    /// Adds a line of the log to the recording.
    void log(const LogLine& line) {
        if (recorder_) recorder_->log(line);
    }
    /// Opens the files of `options` for a loaded system, which must outlive all calls except `give_up` and
    /// `end_at_once`. An error says which file can't be written.
    Expected<void> open(const RunOptions& options, RunningSystem& live);
    /// Follows the loop and ends it when the recording can't be written.
    void follow(RunLoop& loop);
    /// Takes the results as they are now; later ticks do not change them. `title` is the title of the picture.
    void take(const std::string& title);
    std::uint64_t hash() const { return hash_; }
    /// Writes the results. An error gives the reason.
    Expected<void> write();
    /// For a run that failed: completes the recording, with the reason `why` at its end. Returns a text about the older
    /// file that is kept, or "".
    std::string discard(const std::string& why);

    /// True if the recording is slower than the run.
    bool is_behind() const { return recorder_ && recorder_->is_behind(); }

    // Any thread may call:

    /// Drops what is not written yet, so that `write` returns soon, with an error.
    void give_up() {
        if (recorder_) recorder_->give_up();
    }
    /// Completes the recording with the data so far.
    void end_at_once() {
        if (recorder_) recorder_->end_here("the run was ended immediately");
    }

private:
    void after_tick();

    RunningSystem* live_ = nullptr;
    RunLoop* loop_ = nullptr;
    std::string picture_file_;
    std::unique_ptr<RunRecording> recorder_;
    McapRecorder* mcap_ = nullptr;  // `recorder_`, if it records MCAP
    draw::Trajectories trajectories_;
    int starts_ = 0;
    std::optional<draw::PictureOf> picture_;
    std::uint64_t hash_ = 0;
};

}  // namespace nezumi::cli
