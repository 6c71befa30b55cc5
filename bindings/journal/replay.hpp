// Reads a journal and performs it again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bindings/journal/journal.hpp"
#include "bindings/journal/recorded_files.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

class Replay {
public:
    /// Reads a journal of this version. An error says the file, the line and what is wrong with it, or in one line why
    /// it can't be replayed here. A last line that is torn is left out.
    static Expected<std::unique_ptr<Replay>> read(const std::filesystem::path& file, const std::string& version);
    ~Replay();
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    /// Why this is no journal of that system file; files are compared by name, as they may be gone or elsewhere now.
    Expected<void> check_system(const std::filesystem::path& file) const;
    /// Builds the system as it was, from the journal alone: with these makers of worlds and components, and this log.
    Expected<std::unique_ptr<RunningSystem>> load(LiveOptions options);
    /// Performs what came before the next tick, and compares hashes. Returns whether there is more: a tick may follow.
    /// An error says in which line the run is another one than that of the journal.
    Expected<bool> before_tick(RunningSystem& live);

    /// How that run ended; nothing: its journal breaks off, where its process was killed.
    std::optional<RunEnd> end() const { return end_; }
    const std::string& end_message() const { return end_message_; }
    /// What that run printed as its hash; nothing: it never did.
    std::optional<std::uint64_t> hash() const { return hash_; }
    /// The line that was left out because it is torn; 0: none.
    int torn_line() const { return torn_; }

private:
    struct Entry;

    Replay(std::filesystem::path file);
    Expected<void> read_header(const std::string& line, const std::string& version);
    Expected<void> read_entry(const std::string& line, int number);
    Expected<void> read_out_of_time(const nlohmann::ordered_json& json, const ActTime& when, int number);
    Unexpected wrong(int line, const std::string& what) const;
    Expected<void> perform(RunningSystem& live, const Entry& entry);
    // Why it may have become another run by now: "; ...", or nothing.
    std::string cause(const ActTime& now) const;

    std::filesystem::path file_;
    std::string system_;
    std::vector<std::filesystem::path> installed_;
    std::uint64_t seed_ = 0;
    bool seed_wins_ = false;
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
    std::vector<Ended> ended_;  // calls, by the clock
    std::optional<RunEnd> end_;
    std::string end_message_;
    std::optional<std::uint64_t> hash_;
    int torn_ = 0;
};

}  // namespace nezumi
