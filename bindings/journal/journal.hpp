// Writes a journal: a file with one JSON object a line, from which the run can be performed again.
//
//   {"journal":1,"version":"0.1.0","hardware":false,"system":"systems/x.lua","working_folder":...,"installed":[...],
//    "seed":1,"seed_wins":true,"files":{...}}           first: what it takes to begin, whole; files as in
//    files_json.hpp
//   {"at":[START,TICK,SEQUENCE],"who":"console","do":"SetParameter","with":{...}}   an act, before that tick
//      "failed":true   it was refused, but a script's hook or command has run
//      "files":{...}   what it found of files
//   {"at":...,"out_of_time":{"component":"x","call":12,...}}   the clock ended that call into a script
//      "state":{...}   the plain data that it left;  "lost":"..."   what else was there
//   {"at":...,"hash":"..."}                 20 times a second: how far it came, and the trace hash there
//   {"at":...,"end":"duration","hash":...}  last: how it ended, and the hash that the run printed
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

/// How a run ended.
enum class RunEnd {
    duration,  ///< at a time set by --duration or commands
    stopped,   ///< by a person or a signal: then the robots braked
    error,     ///< by an error
};

/// Takes lines of a journal, about `bytes` of text, and makes their text when it writes them. Each call continues the
/// one before. `make` may be called in another thread.
using JournalSink = std::function<void(std::size_t bytes, std::function<std::string()> make)>;

class Journal final : public ActObserver {
public:
    /// The longest time before a line is written, and the interval of hashes: a crash loses at most 0.1 s, which is
    /// this and the time to write.
    static constexpr std::chrono::milliseconds period{50};

    /// Starts a file; an older one of the same name is renamed. The system to follow may end before the journal, but
    /// not act then.
    static Expected<std::unique_ptr<Journal>> create(const std::filesystem::path& file);
    /// Starts a journal without a file of its own.
    static std::unique_ptr<Journal> of_sink(JournalSink sink);
    /// Gives all lines to this sink as well. Call it before `begin`.
    void add_sink(JournalSink sink) { sink_ = std::move(sink); }
    /// Without a last line the journal is dropped, and the older file is restored.
    ~Journal() override;
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Writes the first line, for a loaded system that is not active yet, and follows it from now on.
    void begin(RunningSystem& live, const std::string& version, bool hardware);
    /// Called between two ticks: writes lines that have waited long enough.
    void serve();
    /// Records the present hash.
    void mark();
    /// Writes the last line and all pending lines, removes the older file, and stops observing the system.
    void end(RunEnd how, const std::string& message, const ActTime& when, std::uint64_t hash);
    /// The error of writing, if any.
    const std::optional<Error>& error() const { return error_; }
    /// The file is slower than the run: a run without a clock should wait.
    bool is_behind() const { return own_ && own_->writer.is_behind(); }
    /// Drops what is not written yet, so that `end` returns soon, with an error. Any thread may call it.
    void give_up() {
        if (own_) own_->writer.give_up();
    }

    void acted(const ActTime& when, std::shared_ptr<const PastAct> act, const Expected<ActResult>& result) override;
    void ran_out_of_time(const ActTime& when, const std::string& component, const Component::OutOfTime& call) override;

private:
    using Clock = std::chrono::steady_clock;

    // Its own file.
    struct OwnFile {
        std::string name;
        ResultFile file;
        FileWriter writer;

        OwnFile(std::string called, ResultFile opened)
            : name(std::move(called)), file(std::move(opened)), writer(file.descriptor()) {}
    };

    Journal() = default;
    // Without files that never existed.
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

/// Returns "9f86d081884c7d65".
std::string hash_text(std::uint64_t hash);

}  // namespace nezumi
