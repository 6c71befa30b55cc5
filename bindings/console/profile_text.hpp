// Measured executions as tables for people.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "bindings/lua/sandbox/line_profile.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

/// A row for each component, the most expensive first: executions (of a native one its ticks), median, worst, and the
/// mean as a share of the tick's period at this rate [Hz].
std::string cost_table(const std::map<std::string, ExecutionProfile>& behaviors,
                       const std::map<std::string, TickCosts>& natives, double rate);

/// A row for each line, the most expensive first: its share, its time, how often it ran, and its text. `text_of` gives
/// the text of a file by its name in messages.
std::string line_table(const LineCosts& lines, const std::function<std::string(const std::string& file)>& text_of);

}  // namespace nezumi
