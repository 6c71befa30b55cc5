// A file of scenarios: the calls `scenario(name, options, function)` of a `*_test.lua`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <lua.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/scenario/sweep.hpp"
#include "engine/base/error.hpp"
#include "engine/project/project.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Timeout of a scenario without this option, in simulated time [s].
inline constexpr double default_timeout = 60;
/// Number of draws of a sweep with a range, without the option.
inline constexpr std::size_t default_samples = 20;

struct Scenario {
    std::string name;
    Place place;
    double timeout = default_timeout;  ///< [s] of simulated time
    Sweep sweep;
    std::size_t seeds = 0;                ///< number of runs of each combination, with different seeds; 0: one run
    std::optional<std::uint64_t> seed{};  ///< of every run; nothing: each run has its own
    std::size_t search = 0;               ///< number of runs that a search chooses; 0: all runs are planned
    bool draws = false;                   ///< its text calls `s:any`
    std::string paired{};                 ///< runs that differ only in this key have the same seed; "": none
};

/// Checks that the runs of a scenario can be compared in pairs by this key: the sweep has a list of its values.
Expected<void> check_paired(const Scenario& scenario, const std::string& name);

/// Reads the values of a sweep, or of `s:any`, from a table: lists and ranges. `what` is the table's name in errors.
Expected<std::vector<SweepKey>> read_sweep_keys(lua_State* lua, int index, const std::string& what,
                                                const Budget& budget);

struct ScenarioFileOptions {
    std::vector<std::filesystem::path> installed;  ///< folders of the installed files (`Project::of`)
    PeerWords peer_words{};                        ///< as in `LiveOptions`
    std::uint64_t seed = 0;                        ///< of `math.random`
    std::function<void(std::string_view)> print;   ///< gets the output of the file, a line at a time; may be empty
    std::optional<std::string> text{};             ///< replaces the content of the file, which need not exist
    Coverage* coverage = nullptr;                  ///< of required modules; may be null, must outlive the file
    const ProjectFiles* project_files = nullptr;   ///< of the project, in place of the disk; may be null
    /// Only this scenario runs: the others, which were checked when the runs were planned, are counted and not read.
    std::optional<std::size_t> only{};
};

class ScenarioFile {
public:
    /// Runs the file, which only declares scenarios. `errors` gets all its mistakes.
    static Expected<std::unique_ptr<ScenarioFile>> read(const std::filesystem::path& path,
                                                        const ScenarioFileOptions& options,
                                                        std::vector<Error>* errors = nullptr);

    const std::string& shown() const { return shown_; }
    const Project& project() const { return project_; }
    const PeerWords& peer_words() const { return peer_words_; }
    /// In the order of the file; at least one.
    const std::vector<Scenario>& scenarios() const { return scenarios_; }
    LuaState& state() const { return LuaState::of(file_->lua()); }
    /// The text of the file, or of a module that it required; null for other names.
    const std::string* text(const std::string& shown) const;
    const FileSource* source(const std::string& shown) const { return file_->source(shown); }
    /// The paths of the file and of the modules that it and its scenarios have required, in the form of
    /// `Project::shown`.
    const std::vector<std::string>& files() const { return file_->files(); }

    /// The last error of `scenario` or `range`; empty at first. Running scenarios may call them by mistake.
    const std::string& refused() const { return refused_; }

    /// Pushes the function of a scenario. May raise a Lua error.
    void push_function(lua_State* lua, std::size_t scenario) const;

private:
    ScenarioFile(Project project, PeerWords peer_words, std::string shown, std::optional<std::size_t> only)
        : project_(std::move(project)), peer_words_(std::move(peer_words)), shown_(std::move(shown)), only_(only) {}

    static int scenario_word(lua_State* lua);
    static int range_word(lua_State* lua);
    Expected<void> noted(Expected<void> done);
    Expected<void> check_text(std::vector<Error>* errors);
    Expected<void> add(lua_State* lua);
    Expected<Scenario> read_call(lua_State* lua, const Place& place);
    Expected<void> check_names_of_runs(const Scenario& scenario) const;
    Expected<void> read_options(lua_State* lua, int index, Scenario& scenario);
    Expected<void> read_sweep(lua_State* lua, int index, Scenario& scenario);

    Project project_;
    PeerWords peer_words_;
    std::string shown_;
    std::optional<std::size_t> only_;
    std::string text_;
    std::string refused_;
    std::vector<Scenario> scenarios_;
    std::map<std::string, std::size_t, std::less<>> named_;  // the scenarios by their names
    bool is_read_ = false;                                   // after this, declarations are refused
    std::unique_ptr<DataFile> file_;
};

}  // namespace nezumi
