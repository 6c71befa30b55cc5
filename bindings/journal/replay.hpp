// Reads a journal and replays it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/journal/journal.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"
#include "engine/time/recorded_files.hpp"

namespace nezumi {

class Replay {
public:
    /// Reads a journal, also of another version of nezumi: then the run may differ, and each error names both versions.
    /// The error has the file, the line and the problem, or the reason why the journal can't be replayed. An incomplete
    /// last line is ignored.
    static Expected<std::unique_ptr<Replay>> read(const std::filesystem::path& file, const std::string& version);
    /// Reads a journal from its text; `file` is the name for errors.
    static Expected<std::unique_ptr<Replay>> of_text(std::string_view text, const std::filesystem::path& file,
                                                     const std::string& version);
    /// Reads also the journal of a run on hardware, which can't be repeated: for `spec` and `acts_on` only.
    static Expected<std::unique_ptr<Replay>> of_record(std::string_view text, const std::filesystem::path& file,
                                                       const std::string& version);
    /// The largest size of a journal [bytes].
    static constexpr std::size_t largest = std::size_t{4} << 30;
    ~Replay();
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    /// An error if this is not a journal of that system file. Only the names of the files are compared, because their
    /// folders may have changed.
    Expected<void> check_system(const std::filesystem::path& file) const;
    /// Builds the recorded system only from the journal, with the factories of worlds and components and the log of
    /// `options`.
    Expected<std::unique_ptr<RunningSystem>> load(LiveOptions options);
    /// Reads the description of the recorded system only from the journal.
    Expected<SystemSpec> spec(const LiveOptions& options);
    /// The seed of the recorded run.
    std::uint64_t seed_of(const SystemSpec& spec) const { return seed_wins_ ? seed_ : spec.seed.value_or(seed_); }
    /// The acts that changed this component, each with the tick before which it came, up to the first restart or seek.
    Expected<std::vector<std::pair<std::int64_t, Act>>> acts_on(const std::string& component) const;
    /// The tick before which the run ended, and its robots began to brake; nothing if its journal is incomplete.
    std::optional<std::int64_t> end_tick() const;
    /// Whether the run was on hardware.
    bool is_of_hardware() const { return is_of_hardware_; }
    /// Performs the acts before the next tick, and compares hashes. Returns true if there is more, so that a tick may
    /// follow. An error gives the line where the run differs from the journal.
    Expected<bool> before_tick(RunningSystem& live);

    /// Whether all entries have been performed, so that the run is at its end.
    bool is_over() const;
    /// The number of ticks of the recorded run, over all its starts.
    std::int64_t ticks() const;
    /// The version of nezumi that wrote the journal; "": this version.
    const std::string& other_version() const { return other_version_; }
    /// "; the journal is of nezumi 1.2, this is 1.3", or "".
    std::string written_by() const;
    /// How the recorded run ended; nothing if its journal is incomplete, because the process was killed.
    std::optional<RunEnd> end() const { return end_; }
    const std::string& end_message() const { return end_message_; }
    /// The hash printed by the recorded run, if any.
    std::optional<std::uint64_t> hash() const { return hash_; }
    /// The incomplete line that was ignored; 0: none.
    int torn_line() const { return torn_; }

private:
    struct Entry;

    Replay(std::filesystem::path file);
    static Expected<std::unique_ptr<Replay>> parse(std::string_view text, const std::filesystem::path& file,
                                                   const std::string& version, bool takes_hardware);
    Expected<void> read_header(const std::string& line, const std::string& version, bool takes_hardware);
    LiveOptions with_its_files(LiveOptions options);
    Expected<void> read_entry(const std::string& line, int number);
    Expected<void> read_out_of_time(const nlohmann::ordered_json& json, const ActTime& when, int number);
    Unexpected wrong(int line, const std::string& what) const;
    Expected<void> perform(RunningSystem& live, const Entry& entry);
    // A possible cause of a difference: "; ...", or nothing.
    std::string cause(const ActTime& now) const;

    std::filesystem::path file_;
    std::string other_version_, version_;
    std::string system_;
    std::vector<std::filesystem::path> installed_;
    std::uint64_t seed_ = 0;
    bool seed_wins_ = false;
    bool is_of_hardware_ = false;
    StartValues values_;
    std::optional<RecordedFiles> files_;
    std::vector<Entry> entries_;
    std::size_t next_ = 0;
    std::vector<RunningSystem::Foreseen> foreseen_;
    struct Ended {
        ActTime when;
        std::string component;
        std::string lost;
    };
    std::vector<Ended> ended_;  // calls that ran out of time
    std::optional<RunEnd> end_;
    std::string end_message_;
    std::optional<std::uint64_t> hash_;
    int torn_ = 0;
};

}  // namespace nezumi
