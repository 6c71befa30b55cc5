// Parameters and state that a new version of a script takes over from the version before, and the messages about it.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/values/plain_data.hpp"
#include "engine/components/component.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// Whether both sets of values would load the same version; both belong to one version.
bool same_values(const Parameters& one, const Parameters& other);

/// Reports the values whose parameters are gone, and those that no longer fit. `before` may lack the parameter set that
/// `running` has in use.
void describe_lost(const Parameters& running, const Parameters& before, const Parameters& after,
                   std::vector<std::string>& warnings);

/// "speed_x = 0.3 (its default is 0.2)": the values that a reload kept although the file has another default, because
/// they were set since the start, or because the default has changed.
std::string kept_text(const Parameters& before, const Parameters& after, const ParameterValues& configured);

/// Checks that all values of the parameter set in use fit these parameters.
Expected<void> check_set(const Component& component, Parameters parameters);

/// Changes `settings` to what they would be without the parameter set in use, except for values that were set later.
void leave_set(const Component& component, Parameters& settings);

/// Applies the choice of a parameter set since an earlier version to `settings` of that version: changes the parameters
/// of all sets, except those that were set later. `with_own`: also choices by the component itself.
void follow_use(const Component& component, const Parameters& running, bool with_own, Parameters& settings);

/// Reports the values of `state` that were dropped.
void describe_dropped(const std::vector<Dropped>& dropped, std::vector<std::string>& warnings);

}  // namespace nezumi
