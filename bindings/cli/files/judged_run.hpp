// A behaviour and the recorded run that it is judged by, for the command `judge` and for scenarios.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/files/recorded_drive.hpp"
#include "bindings/journal/drive.hpp"
#include "bindings/journal/replay.hpp"
#include "bindings/scenario/recordings.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The recorded run is read once; each call of `judge` reads only the behaviour's file again.
class JudgedRun {
public:
    /// Reads the run, and finds the behaviour's file. Errors name the options of the command.
    static Expected<JudgedRun> read(const JudgeRequest& request);

    /// The behaviour's file.
    const std::filesystem::path& behavior() const { return behavior_; }
    /// Runs the behaviour, as its file is now, with the recorded messages. `log` gets the log lines of the behaviour;
    /// `curves`, if not null, gets all numbers.
    Expected<Judgement> judge(double tolerance, LogSink log, JudgedCurves* curves = nullptr) const;
    /// A judgement as text: whether it is equal, the first difference, the lines that were executed differently, and
    /// the fields that differ.
    std::vector<std::string> text_of(const Judgement& judged) const;

private:
    static Expected<JudgedRun> from_journal(const std::string& text, const JudgeRequest& request,
                                            std::filesystem::path behavior);
    static Expected<JudgedRun> from_topics(const record::McapFile& recording, const JudgeRequest& request,
                                           const std::filesystem::path& behavior);
    void add_lines(std::vector<std::string>& lines, const Judgement& judged) const;

    std::unique_ptr<Replay> replay_;  // declared first: its files must outlive the system
    std::unique_ptr<RunningSystem> then_;
    RecordedDrive drive_;
    std::filesystem::path behavior_;
};

}  // namespace nezumi::cli
