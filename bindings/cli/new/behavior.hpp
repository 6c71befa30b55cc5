// A new behaviour as text: the component's file and a scenario for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/new/behavior_text.hpp"
#include "engine/base/error.hpp"
#include "engine/messages/message_files.hpp"

namespace nezumi {
struct BehaviorRequest;
}

namespace nezumi::cli {

/// The arguments of the command line.
struct NewBehavior {
    std::string name;                      ///< as given: line_follower or LineFollower
    std::vector<std::string> inputs;       ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> outputs;      ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> parameters;   ///< as `read_new_parameter` reads them
    std::vector<std::string> callbacks{};  ///< besides on_execute: "on_activated", ...
    std::string doc{};                     ///< a sentence: what it does; "": a placeholder
    ScriptAbout about{};
    BehaviorParts base{};  ///< the parts to which all of the above is added; `name`, if given, replaces their name
};

struct BehaviorTexts {
    std::string name;  ///< of the files: line_follower
    std::string behavior;
    std::string scenario;
};

/// Finds the message types of the project in the working folder, and the installed ones.
MessageFinder new_messages();

/// Returns the texts, which can be loaded. An error is about the command line, with the most similar name.
Expected<BehaviorTexts> write_behavior(const NewBehavior& wanted);

/// Writes the behaviour's file and a scenario for it into the project in `root`, as `nezumi new behavior` does. Returns
/// the names of both files. Never overwrites a file.
Expected<std::vector<std::string>> write_new_behavior(const std::filesystem::path& root,
                                                      const BehaviorRequest& request);

}  // namespace nezumi::cli
