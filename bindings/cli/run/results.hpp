// What a run leaves when it ends: its recording, its picture, its trace hash.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bindings/cli/run/options.hpp"
#include "bindings/cli/run/recorder.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/trajectories.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class RunResults {
public:
    /// Opens the files of `options` for a system that has been loaded, which must outlive all but `give_up` and
    /// `end_at_once`. The error says which can't be written.
    Expected<void> open(const RunOptions& options, RunningSystem& live);
    /// Follows the loop, which ends when the recording can't be written any more.
    void follow(RunLoop& loop);
    /// They are those of now. `title` is the picture's.
    void take(const std::string& title);
    std::uint64_t hash() const { return hash_; }
    /// Writes what was taken. The error says why not.
    Expected<void> write();
    /// The run is none, for this reason in one line: no file is left that could be taken for its result. Returns what
    /// is to be said of that; "" for nothing.
    std::string discard(const std::string& why);

    /// The recording takes less than comes.
    bool is_behind() const { return recorder_ && recorder_->is_behind(); }

    // From any thread:

    /// What is not written yet is not: `write` returns soon, with an error.
    void give_up() {
        if (recorder_) recorder_->give_up();
    }
    /// The recording is completed as it is, wherever the run is.
    void end_at_once() {
        if (recorder_) recorder_->end_here("the run was ended at once");
    }

private:
    void after_tick();

    RunningSystem* live_ = nullptr;
    RunLoop* loop_ = nullptr;
    std::string picture_file_;
    std::optional<Recorder> recorder_;
    draw::Trajectories trajectories_;
    int starts_ = 0;
    std::optional<draw::PictureOf> picture_;
    std::uint64_t hash_ = 0;
};

}  // namespace nezumi::cli
