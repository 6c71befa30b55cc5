// Writes a journal: a file with one JSON object per line, from which the run can be performed again.
//
//   {"journal":1,"version":"0.1.0","hardware":false,"system":"systems/x.lua","working_folder":...,"installed":[...],
//    "seed":1,"seed_wins":true,"files":{...}}           first line: all that a replay needs to start; files as in
//    files_json.hpp
//   {"at":[START,TICK,SEQUENCE],"who":"console","do":"SetParameter","with":{...}}   an act, before that tick
//      "failed":true   the act was refused, but a script's hook or command has run
//      "files":{...}   the files that the act has read
//   {"at":...,"out_of_time":{"component":"x","call":12,...}}   that call into a script ran out of time
//      "state":{...}   the plain data that the call left;  "lost":"..."   the other data that it left
//   {"at":...,"hash":"..."}                 20 times a second: the time, and the trace hash at this time
//   {"at":...,"end":"duration","hash":...}  last line: how the run ended, and the hash that it printed
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/file_writer.hpp"
#include "engine/base/result_file.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// The version of the lines of a journal, in its first line.
inline constexpr int journal_format = 1;

/// How a run ended.
enum class RunEnd {
    duration,  ///< at a time set by --duration or commands
    stopped,   ///< by the user or a signal; the robots braked after it
    error,     ///< by an error
};

/// Takes lines of a journal, about `bytes` of text, and calls `make` for the text when it writes them. The lines of
/// each call follow those of the call before. `make` may be called in another thread.
using JournalSink = std::function<void(std::size_t bytes, std::function<std::string()> make)>;

class Journal final : public ActObserver {
public:
    /// The longest time before a line is written, and the interval of hashes. With the time to write, a crash loses at
    /// most the last 0.1 s.
    static constexpr std::chrono::milliseconds period{50};

    /// Creates the file; an older one with the same name is renamed. The observed system may be destroyed before the
    /// journal, but must perform no act after the journal is destroyed.
    static Expected<std::unique_ptr<Journal>> create(const std::filesystem::path& file);
    /// Starts a journal that only gives its lines to this sink.
    static std::unique_ptr<Journal> of_sink(JournalSink sink);
    /// Gives all lines to this sink as well. Call this before `begin`.
    void add_sink(JournalSink sink) { sink_ = std::move(sink); }
    /// Without a call of `end` the journal is dropped, and the older file is restored.
    ~Journal() override;
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Writes the first line, for a loaded system that is not active yet, and observes the system from now on.
    void begin(RunningSystem& live, const std::string& version, bool hardware);
    /// Called between two ticks: writes lines that have waited long enough.
    void serve();
    /// Records the present hash.
    void mark();
    /// Writes the last line and all pending lines, removes the older file, and stops observing the system.
    void end(RunEnd how, const std::string& message, const ActTime& when, std::uint64_t hash);
    /// The error of writing, if any.
    const std::optional<Error>& error() const { return error_; }
    /// Whether the file is slower than the run: a run without a clock should wait.
    bool is_behind() const { return own_ && own_->writer.is_behind(); }
    /// Drops the lines that are not written yet, so that `end` returns soon; `error` is set then. Any thread may call
    /// this.
    void give_up() {
        if (own_) own_->writer.give_up();
    }

    void acted(const ActTime& when, std::shared_ptr<const PastAct> act, const Expected<ActResult>& result) override;
    void ran_out_of_time(const ActTime& when, const std::string& component, const Component::OutOfTime& call) override;

private:
    using Clock = std::chrono::steady_clock;

    // The journal's own file.
    struct OwnFile {
        std::string name;
        ResultFile file;
        FileWriter writer;

        OwnFile(std::string called, ResultFile opened)
            : name(std::move(called)), file(std::move(opened)), writer(file.descriptor()) {}
    };

    Journal() = default;
    // Removes the files that never existed.
    FilesSeen known(FilesSeen files);
    using Line = std::function<std::string()>;
    void add(Line line) { waiting_.push_back(std::move(line)); }
    void flush();
    void fail_with(int problem);

    std::optional<OwnFile> own_;
    JournalSink sink_;
    std::set<std::filesystem::path> known_;  // files that existed
    RunningSystem* live_ = nullptr;
    std::vector<Line> waiting_;  // converted outside the ticks: an act may contain a picture or a million numbers
    Clock::time_point marked_{};
    ActTime last_mark_;
    bool ended_ = false;
    std::optional<Error> error_;
};

/// The hash as 16 hexadecimal digits: "9f86d081884c7d65".
std::string hash_text(std::uint64_t hash);

}  // namespace nezumi
