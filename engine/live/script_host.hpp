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

/// New versions of the behaviours of one system, which must outlive it. All of it is to be called between two ticks. An
/// error means that nothing has changed; its message ends with "still running version N".
class Reloads {
public:
    virtual ~Reloads() = default;
    /// Reloads every component of these files and every one that requires them, from what the files hold now.
    virtual Expected<ActResult> reload_files(const std::vector<std::string>& paths) = 0;
    /// Reloads the components of a file from this text of it.
    virtual Expected<ActResult> reload(const SourceText& source) = 0;
    /// Takes a component, and those that came to their version with it, back to the version before, state included.
    virtual Expected<ActResult> rollback(const Component& component) = 0;
    /// After every tick: takes back what has failed on probation.
    virtual void after_tick() = 0;

    /// All files that the behaviours come from, modules too.
    virtual std::vector<ScriptFile> loaded_files() const = 0;
    /// The same, and those that a refused version required.
    virtual std::vector<ScriptFile> files() const = 0;

    /// Loads what `reload_files` would, and lets it go: the error is why it would be refused. May be called in any
    /// thread, and outlive the system.
    using Rehearsal = std::function<Expected<void>()>;
    virtual Expected<Rehearsal> rehearsal(const std::vector<std::string>& paths) const = 0;
    /// What the preparation of a component may take [s of CPU time]; 0: what its calls may.
    virtual void limit_preparation(double seconds) = 0;
};

/// A behaviour that was loaded beside the ticks.
class LoadedBehavior {
public:
    virtual ~LoadedBehavior() = default;
    /// Between two ticks, once: for the system that it was loaded for, which is there.
    virtual std::unique_ptr<Component> take() = 0;
};
/// May be called in any thread, and outlive the system. Reads through this project's files, which it needs no longer
/// when it has returned.
using BehaviorLoader = std::function<Expected<std::unique_ptr<LoadedBehavior>>(
    const BehaviorEntry& entry, const MakerContext& context, const Project& project)>;

/// The behaviours of one start of a system. It must outlive them.
class Behaviors {
public:
    virtual ~Behaviors() = default;
    /// For `Makers::behavior`.
    virtual Expected<std::unique_ptr<Component>> make(const BehaviorEntry& entry, const MakerContext& context) = 0;
    virtual BehaviorLoader loader() = 0;
    virtual std::unique_ptr<Reloads> reloads_of(System& system) = 0;
};

struct SystemFileOptions {
    std::uint64_t seed = 0;                       ///< of `math.random` in the file
    double seconds = 2.0;                         ///< of CPU time that the file may take
    std::function<void(std::string_view)> print;  ///< takes what `print` was given, a line at a time; may be empty
    bool is_part = false;  ///< the robots that components are on, and the tick, may be in the rest of the system
};

/// Values of parameters that whoever starts a system puts in place of the system file's. Both are taken again at every
/// start of the system: `restart` keeps them.
struct StartValues {
    std::string file;              ///< a system file, as `save` writes it, whose parameters and sets hold; "" for none
    std::vector<std::string> set;  ///< "controller.speed_x=0.3", the last of a parameter counts; over those of `file`
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
    virtual std::unique_ptr<Behaviors> behaviors(const Project& project, Budget budget) const = 0;
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
