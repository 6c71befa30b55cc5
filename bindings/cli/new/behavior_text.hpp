// The files of a new behaviour as texts, from its parts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/new/arguments.hpp"
#include "bindings/lua/script/script.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::cli {

struct NewPort {
    std::string name;
    const MessageType* type = nullptr;  ///< of the messages
    std::string doc;
    std::string options{};  ///< "queue = 5": the text within its braces
};

struct BehaviorParts {
    std::string name;  ///< of the file: line_follower
    std::string doc;   ///< lines; "": a placeholder
    ScriptAbout about;
    std::vector<std::string> comments;  ///< lines of comments below `doc`
    std::vector<NewPort> inputs, outputs;
    std::vector<NewParameter> parameters;
    std::vector<std::string> declarations;  ///< declarations that become comments below the parameters
    std::vector<std::string> callbacks;     ///< besides on_execute
    double rate = 0;                        ///< [Hz] of the component in the scenario; 0: the system's
};

/// Each line of a text as a comment that begins with these dashes. An empty line becomes a comment too, so that the
/// comment is not interrupted.
std::string comment_text(std::string_view dashes, std::string_view lines);

/// The names in a behaviour's file that a local variable must not hide.
bool is_taken_word(const std::string& name);

std::string behavior_text(const BehaviorParts& parts);

/// A scenario in which the behaviour executes at least twice, gets a message in each in-port and writes each out-port.
std::string behavior_scenario_text(const BehaviorParts& parts);

}  // namespace nezumi::cli
