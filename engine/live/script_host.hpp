// What a running system asks of the language that its files and behaviours are written in. bindings/lua is one.
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

/// New versions of behaviours that have been loaded, or why they can't be.
class PreparedReload {
public:
    virtual ~PreparedReload() = default;
};

/// New versions of the behaviours of one system, which must outlive it. All of it is to be called between two ticks. An
/// error means that nothing has changed; its message ends with "still running version N".
class Reloads {
public:
    virtual ~Reloads() = default;
    /// Loads the components of these files and those that require them, from what the files hold now; where there are
    /// none, those of the file of `source`, from its text. May be called in any thread, and outlive the system.
    using Loader = std::function<std::unique_ptr<PreparedReload>(const std::vector<std::string>& files,
                                                                 const SourceText& source, const Project& project)>;
    virtual Loader loader() const = 0;
    /// Whether the behaviours are still those that it was prepared for.
    virtual bool fits(const PreparedReload& prepared) const = 0;
    /// Lets the versions run that were loaded, which must fit. What depends on the tick is loaded here, from the files
    /// of `project`: those that were read before.
    virtual Expected<ActResult> commit(PreparedReload& prepared, const Project& project) = 0;
    /// Takes a component, and those that came to their version with it, back to the version before, state included.
    virtual Expected<ActResult> rollback(const Component& component) = 0;
    /// After every tick: takes back what has failed on probation.
    virtual void after_tick() = 0;

    /// All files that the behaviours come from, modules too.
    virtual std::vector<ScriptFile> loaded_files() const = 0;
    /// The same, and those that a refused version required.
    virtual std::vector<ScriptFile> files() const = 0;
};

/// Behaviours that are loaded, in any thread, and taken into a system between two ticks.
class Behaviors {
public:
    virtual ~Behaviors() = default;
    /// Reads through the files of `project`, which are not needed later. What is wrong is told by `take`.
    virtual void load(const BehaviorEntry& entry, const MakerContext& context, const Project& project) = 0;
    /// What was loaded for this entry, once: for `Makers::behavior`.
    virtual Expected<std::unique_ptr<Component>> take(const BehaviorEntry& entry) = 0;
    /// Takes over all that others of the same host have loaded.
    virtual void take_all(Behaviors& others) = 0;
    /// Of the system that these behaviours are in. They must outlive it.
    virtual std::unique_ptr<Reloads> reloads_of(System& system) = 0;
};

struct SystemFileOptions {
    std::uint64_t seed = 0;                       ///< of `math.random` in the file
    double seconds = 2.0;                         ///< of CPU time that the file may take
    std::function<void(std::string_view)> print;  ///< takes what `print` was given, a line at a time; may be empty
    bool is_part = false;  ///< the robots that components are on, and the tick, may be in the rest of the system
    std::vector<std::string>
        set{};  ///< as of `StartValues`: those without a dot before the = are arguments of the file
};

/// Values of parameters that whoever starts a system puts in place of the system file's. Both are taken again at every
/// start of the system: `restart` keeps them.
struct StartValues {
    std::string file;  ///< a system file, as `save` writes it, whose parameters and sets hold; "" for none
    /// "controller.speed_x=0.3", the last of a parameter counts; over those of `file`. "wander_*.speed=0.2" is of all
    /// that are called so, "n=10" an argument of the file.
    std::vector<std::string> set;
};

class ScriptHost {
public:
    virtual ~ScriptHost() = default;

    /// Reads a system file and every file that it names, except scripts, which are only found. Errors say file and
    /// line.
    virtual Expected<SystemSpec> read_system(const std::filesystem::path& file, const Project& project,
                                             const SystemFileOptions& options) const = 0;
    /// The same from text; `shown` is the file's name in errors, and its folder is where names are looked up first.
    virtual Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown,
                                                  const Project& project, const SystemFileOptions& options) const = 0;
    /// A text from which the same is read; `title` becomes its first line, a comment.
    virtual std::string write_system_text(const SystemSpec& spec, const std::string& title) const = 0;
    /// Puts values into `spec`. The error names the option or the line of the file.
    virtual Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project) const = 0;
    /// Reads the files of a robot into the models and files of `part`, the system that it is added to as far as it has
    /// the robot's: its description, and its calibration if it uses one, which changes the entry.
    virtual Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& project) const = 0;

    /// `budget` is of each call into a behaviour.
    virtual std::unique_ptr<Behaviors> behaviors(Budget budget) const = 0;
};

/// For programs whose components are all in C++: it reads no files and makes no behaviours.
const ScriptHost& no_scripts();

/// Reads parts of a system that an act carries as text.
struct PartReader {
    Project project;            ///< where the files of entries are found
    const ScriptHost* scripts;  ///< must outlive it

    /// `file` is the one beside which names are looked up.
    Expected<SystemSpec> read(std::string_view text, const std::string& file) const {
        return scripts->read_system_text(text, file, project, {.is_part = true});
    }
};

}  // namespace nezumi
