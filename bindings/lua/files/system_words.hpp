// The words of a system file (functions such as `robot`): each call adds data to a system, or returns an error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "bindings/lua/files/robot_file.hpp"
#include "engine/project/project.hpp"
#include "engine/records/word_call.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The error of a word that may be called only once.
Unexpected repeated(const WordCall& call, const Place& first);

/// Whether a name can't be used for a robot, behaviour or component: reserved names, and names of Lua's library.
bool is_taken_name(std::string_view name);

/// Builds a `SystemSpec` call by call. A call that fails adds nothing. `finish` checks what depends on the whole system
/// (rates, names); `build_system` checks what depends on the components (ports, parameters, overlaps).
class SystemWords {
public:
    /// `words`: the words that describe peers. `start`: the system that the calls extend.
    explicit SystemWords(const Project& project, PeerWords words = {}, SystemSpec start = {});

    /// Executes `robot`, `behavior` or `component`.
    Expected<void> entry(const WordCall& call, const std::string& name, const Value& fields);
    /// A name without its table: `robot "mouse"` before `{ ... }`. `finish` refuses names that got no table.
    Expected<std::size_t> begin_entry(const WordCall& call, const Value& name);
    Expected<void> complete_entry(std::size_t pending, const Value& fields);
    /// "robot 'mouse'", for messages.
    std::string pending_title(std::size_t pending) const;

    Expected<void> connect(const WordCall& call, const Value& from, const Value& to);

    /// `box`, `wall`, `cylinder`, `marker`, `maze`, `floor`, `line`, `csv` and `map` make an object; `arena` adds it to
    /// the arena.
    Expected<FileThing> thing(const WordCall& call, const Value& fields);
    /// The facts about an object that a file can read: the start, goal and size of a maze. Empty for other objects.
    const FileTable& facts(FileThing thing) const { return things_[thing.index].facts; }
    Expected<void> arena(const WordCall& call, const Value& fields);

    Expected<void> seed(const WordCall& call, const Value& value);
    Expected<void> rate(const WordCall& call, const Value& hertz);
    Expected<void> physics(const WordCall& call, const Value& fields);
    /// A word that describes peers.
    Expected<void> peer(const WordCall& call, const Value& fields);

    /// Sets the arguments of the file from `--set`: "n=10".
    void give_arguments(const std::vector<std::string>& set);
    /// The value of an argument: from `--set`, or `otherwise`.
    Expected<Value> argument(const WordCall& call, const Value& name, const Value& otherwise, const Value& options);
    /// An error if an argument was set that the file does not use.
    Expected<void> check_arguments() const;

    /// Checks what depends on the whole system; a part of a system (`is_part`) is checked less. May be called again
    /// after more words.
    Expected<void> finish(bool is_part = false) const;

    SystemSpec& spec() { return spec_; }
    const SystemSpec& spec() const { return spec_; }
    const Project& project() const { return project_; }
    /// Adds a file to the list of files that the system was read from.
    void note_file(const std::string& shown);
    /// Messages for the user of the file, such as what was taken from a map.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    using Made = std::variant<std::vector<BoxSpec>, CylinderSpec, MarkerSpec, FloorSpec, LineSpec>;
    struct Thing {
        WordCall call;
        Made made;
        bool placed = false;
        FileTable facts{};
    };
    struct PendingEntry {
        WordCall call;
        std::string name;
        bool complete = false;
    };

    Expected<void> check_name(const WordCall& call, const std::string& name) const;
    Expected<RobotEntry> read_robot(const WordCall& call, const std::string& name, const Value& fields);
    Expected<BehaviorEntry> read_behavior(const WordCall& call, const std::string& name, const Value& fields);
    Expected<ComponentEntry> read_component(const WordCall& call, const std::string& name, const Value& fields);
    Expected<void> load_model(const WordCall& call, const std::string& model);
    Expected<void> describe_changed(FieldCheck& check, const WordCall& call, RobotEntry& entry, const Value& changes);
    Expected<RobotFile*> robot_file(const WordCall& call, const std::string& model);
    // The path of a script or model, and its name in messages: found once for all entries with the same name.
    struct FoundFile {
        std::filesystem::path path;
        std::string shown;
    };
    Expected<FoundFile> find_file(const WordCall& call, FileKind kind, const std::string& name);
    // A file that the system file names: its path, its name in messages, and its content.
    struct ReadFile {
        std::filesystem::path path;
        std::string shown, text;
    };
    Expected<ReadFile> read_file(const WordCall& call, const Value& name);
    Expected<ReadFile> read_file(const WordCall& call, const std::string& name, const std::filesystem::path& named_in);
    Expected<FileThing> make_maze(const WordCall& call, const Value& value);
    Expected<std::vector<BoxSpec>> read_ros_map(const WordCall& call, const Value& name);
    Expected<std::vector<BoxSpec>> read_map(const WordCall& call, const Value& name);
    Expected<void> place_things(const WordCall& call, const std::vector<Value>& elements);
    Expected<void> use_ros_calibration(const WordCall& call, const FieldCheck& check, ComponentEntry& entry);
    void note_degrees(const FieldCheck& check, const WordCall& call, std::string_view what, std::string_view field,
                      double radians);
    Expected<void> check_rates() const;
    Expected<void> check_lines() const;
    Expected<void> check_mazes() const;

    struct Argument {
        std::string option;  // "--set n=10"
        std::string text;
    };
    const Project& project_;
    const PeerWords words_;
    SystemSpec spec_;
    std::map<std::string, Argument, std::less<>> given_;  // by name
    std::map<std::string, Place, std::less<>> asked_;     // where an argument is declared, by name
    std::vector<Thing> things_;
    std::vector<PendingEntry> pending_;
    std::vector<std::string> notes_;
    std::optional<Place> size_place_, border_place_, seed_place_, physics_place_;
    std::map<std::string, std::size_t, std::less<>> names_;  // of the entries: their indices in `spec_`
    std::set<std::pair<std::string, std::string>> wired_;
    std::map<std::tuple<FileKind, std::string, std::string>, FoundFile>
        found_;                                                      // by kind, name, and file that names it
    std::map<std::string, std::unique_ptr<RobotFile>> robot_files_;  // robot files that were read, by shown name
    std::map<std::string, Place> rate_places_;                       // of behaviours and components, by name
};

}  // namespace nezumi
