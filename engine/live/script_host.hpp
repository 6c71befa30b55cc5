// The interface of a running system to the language of its files and behaviours. bindings/lua implements it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/budget.hpp"
#include "engine/components/component.hpp"
#include "engine/project/project.hpp"
#include "engine/system/act.hpp"
#include "engine/system/build_system.hpp"

namespace nezumi {

/// New versions of behaviours that have been loaded, or the error.
class PreparedReload {
public:
    virtual ~PreparedReload() = default;
};

/// Reloads the behaviours of one system. The system must outlive this object. Call all functions between two ticks.
/// After an error nothing has changed; the message ends with "still running version N".
class Reloads {
public:
    virtual ~Reloads() = default;
    /// Loads the components of `files` and of the files that require them, from their present contents. Without
    /// `files`, loads the components of the file of `source`, from the text of `source`. May be called in any thread,
    /// and may outlive the system.
    using Loader = std::function<std::unique_ptr<PreparedReload>(const std::vector<std::string>& files,
                                                                 const SourceText& source, const Project& project)>;
    virtual Loader loader() const = 0;
    /// Whether the behaviours are still those that the reload was prepared for.
    virtual bool fits(const PreparedReload& prepared) const = 0;
    /// Switches to the loaded versions, which must fit. Versions that depend on the tick are loaded in this call, from
    /// the files of `project` that were read before.
    virtual Expected<ActResult> commit(PreparedReload& prepared, const Project& project) = 0;
    /// Takes a component, and the components that were reloaded with it, back to the previous version, with the state
    /// of that version.
    virtual Expected<ActResult> rollback(const Component& component) = 0;
    /// Call this after every tick: rolls back versions that have failed on probation.
    virtual void after_tick() = 0;

    /// All files of the behaviours, including modules.
    virtual std::vector<ScriptFile> loaded_files() const = 0;
    /// The loaded files, and the files that a refused version required.
    virtual std::vector<ScriptFile> files() const = 0;
};

/// Behaviours that are loaded in any thread, and added to a system between two ticks.
class Behaviors {
public:
    virtual ~Behaviors() = default;
    /// Loads a behaviour from the files of `project`, which are not needed later. Errors are returned by `take`.
    virtual void load(const BehaviorEntry& entry, const MakerContext& context, const Project& project) = 0;
    /// Returns the loaded behaviour of this entry, for `Makers::behavior`. Call this once for each entry.
    virtual Expected<std::unique_ptr<Component>> take(const BehaviorEntry& entry) = 0;
    /// Takes over everything that another object of the same host has loaded.
    virtual void take_all(Behaviors& others) = 0;
    /// The reloads of the system that contains these behaviours. The behaviours must outlive the returned object.
    virtual std::unique_ptr<Reloads> reloads_of(System& system) = 0;
};

struct SystemFileOptions {
    std::uint64_t seed = 0;                       ///< seed of `math.random` in the file
    double seconds = 2.0;                         ///< limit of the CPU time for the file
    std::function<void(std::string_view)> print;  ///< gets the output of `print`, a line at a time; may be empty
    bool is_part = false;  ///< the text is a part: the tick rate and robots that it needs may be in another part
    std::vector<std::string>
        set{};               ///< as in `StartValues`: those without a dot before the = are arguments of the file
    PeerWords peer_words{};  ///< words that the file may use besides those of every system
};

/// Parameter values that replace those of the system file. They are used again at every restart of the system.
struct StartValues {
    std::string file;  ///< a system file, as `save` writes it, whose parameter values and sets apply; "": none
    /// "controller.speed_x=0.3"; the last value of a parameter counts, and overrides `file`. "wander_*.speed=0.2" is
    /// for all components with such names, "n=10" is an argument of the file.
    std::vector<std::string> set;
};

class ScriptHost {
public:
    virtual ~ScriptHost() = default;

    /// Reads a system file and every file that it names, except scripts, which are only searched. Errors have file and
    /// line.
    virtual Expected<SystemSpec> read_system(const std::filesystem::path& file, const Project& project,
                                             const SystemFileOptions& options) const = 0;
    /// Reads a system file from a text; `shown` is the file's name in errors, and names are first searched in its
    /// folder.
    virtual Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown,
                                                  const Project& project, const SystemFileOptions& options) const = 0;
    /// A text that is read as the same system; `title` becomes its first line, a comment.
    virtual std::string write_system_text(const SystemSpec& spec, const std::string& title) const = 0;
    /// Puts values into `spec`. The error names the option or the line of the file. The file may use `words`.
    virtual Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project,
                                 const PeerWords& words) const = 0;
    /// Reads the files of a robot that is added to the system `part`: its description, and its calibration if it uses
    /// one, which changes the entry.
    virtual Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& project) const = 0;

    /// `budget` is the limit of each call into a behaviour.
    virtual std::unique_ptr<Behaviors> behaviors(Budget budget) const = 0;
};

/// The script host of programs with components only in C++: reads no files and makes no behaviours.
const ScriptHost& no_scripts();

/// Reads parts of a system that an act contains as text.
struct PartReader {
    Project project;            ///< finds the files of entries
    const ScriptHost* scripts;  ///< must outlive this object
    /// The message types of the system's ports that files define.
    std::vector<const MessageType*> types{};

    /// Finds a message type by name: one of `types`, otherwise the one defined last; null if there is none.
    const MessageType* find_message(std::string_view name) const;

    /// Reads a part from its text. Names are first searched in the folder of `file`.
    Expected<SystemSpec> read(std::string_view text, const std::string& file) const {
        return scripts->read_system_text(text, file, project, {.is_part = true});
    }
};

/// The message types of a system's ports that files define.
std::vector<const MessageType*> defined_messages(const System& system);

}  // namespace nezumi
