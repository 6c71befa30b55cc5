// A new behaviour as text: the component's file and a scenario for it.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/new/arguments.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// What the command line says of it.
struct NewBehavior {
    std::string name;                      ///< as it was given: line_follower or LineFollower
    std::vector<std::string> inputs;       ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> outputs;      ///< the same
    std::vector<std::string> parameters;   ///< as `read_new_parameter` reads them
    std::vector<std::string> callbacks{};  ///< beside on_execute: "on_activated", ...
    std::string doc{};                     ///< what it does, a sentence; "": a place for one
};

struct BehaviorTexts {
    std::string name;  ///< of the files: line_follower
    std::string behavior;
    std::string scenario;
};

/// The texts, which load as they are; or what is wrong with the command line, with the nearest name.
Expected<BehaviorTexts> write_behavior(const NewBehavior& wanted);

}  // namespace nezumi::cli
