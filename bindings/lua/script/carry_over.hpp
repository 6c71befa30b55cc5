// Parameters and state that a new version of a script takes over from the version before, and the messages about it.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/values/plain_data.hpp"
#include "engine/components/component.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// Whether two copies of the parameters of one version have equal values, so that loading a script with either gives
/// the same result.
bool same_values(const Parameters& one, const Parameters& other);

/// Warns about values whose parameters were removed, and about values that no longer fit. `running` has the values of
/// the running version; `before` has the same, possibly without those of a parameter set that was left.
void describe_lost(const Parameters& running, const Parameters& before, const Parameters& after,
                   std::vector<std::string>& warnings);

/// "speed_x = 0.3 (its default is 0.2)": the values that a reload kept although the file has another default, because
/// they were set since the start, or because the default has changed.
std::string kept_text(const Parameters& before, const Parameters& after, const ParameterValues& configured);

/// Checks that all values of the parameter set in use fit these parameters.
Expected<void> check_set(const Component& component, Parameters parameters);

/// Changes `settings` to what they would be without the parameter set in use, except for values that were set later.
void leave_set(const Component& component, Parameters& settings);

/// Adapts `settings` of an earlier version, since which another parameter set was chosen: parameters that occur in any
/// set get the value of the set in use, or their value without a set. Parameters that were set in the version that runs
/// keep their value: those that were set from outside, and if `with_own`, also those that the component set itself.
void follow_use(const Component& component, const Parameters& running, bool with_own, Parameters& settings);

/// Reports the values of `state` that were dropped.
void describe_dropped(const std::vector<Dropped>& dropped, std::vector<std::string>& warnings);

}  // namespace nezumi
