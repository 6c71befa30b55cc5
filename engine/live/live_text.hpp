// Ports, components and values as readable text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/system/system.hpp"
#include "engine/tree/node.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {

/// "mouse.ir_sensor_out  TimedShortSeq  { 0, 0, 0, 0 }  0.01 s old  -> controller.in", then the override and the note
/// of the port, if any.
std::string port_text(const System& system, const Component& component, const Port& port);
/// "RobotController, ACTIVE, version 1": type, state, and the version, rate and parameter set if there are any.
std::string component_title(const Component& component);
/// Lines for a component, its error, `about` values, ports, parameters, commands, tasks and probes.
std::string component_text(const System& system, const Component& component);
/// "\n  about version 1.2, vendor Acme": the `about` values of a script; "" if there are none.
std::string about_text(const Component& component);
/// "speed_x = 0.1  m/s, -1.5 to 1.5  straight-ahead speed".
std::string parameter_text(const Parameters::Parameter& parameter);
/// A line for each parameter.
std::string config_text(const Component& component);

/// The text of `tostring` for a component, a port, all ports or parameters, the truth about a robot, or a system.
std::string node_text(const TreeNode& node);

}  // namespace nezumi
