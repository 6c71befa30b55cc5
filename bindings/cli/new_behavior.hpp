// A new behaviour as text: the component's file and a scenario for it.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// What the command line says of it.
struct NewBehavior {
    std::string name;                     ///< as it was given: line_follower or LineFollower
    std::vector<std::string> inputs;      ///< "name:Type"
    std::vector<std::string> outputs;     ///< "name:Type"
    std::vector<std::string> parameters;  ///< "name=default"
};

struct BehaviorTexts {
    std::string name;  ///< of the files: line_follower
    std::string behavior;
    std::string scenario;
};

/// The texts, which load as they are; or what is wrong with the command line, with the nearest name.
Expected<BehaviorTexts> write_behavior(const NewBehavior& wanted);

/// A default as Lua writes it: `30`, `0.5`, `true`, `{ 1.0, 0.5 }` stay, any other text is quoted. An error when it
/// looks like a number or a truth value and is none.
Expected<std::string> default_text(const std::string& given);

/// "LineFollower" and "line_follower" are both line_follower; an error says which names there can be.
Expected<std::string> behavior_file_name(const std::string& given);

}  // namespace nezumi::cli
