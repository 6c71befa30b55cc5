// What a new version of a script takes over of the parameters and the state of the one before, and what is said of it.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/values/plain_data.hpp"
#include "engine/components/component.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// Whether a version that was loaded with the one would be the same with the other; both are of one version.
bool same_values(const Parameters& one, const Parameters& other);

/// Says which values went with their parameters, and which no longer fit. `before` may be without the set that
/// `running` has in use.
void describe_lost(const Parameters& running, const Parameters& before, const Parameters& after,
                   std::vector<std::string>& warnings);

/// "speed_x = 0.3 (its default is 0.2)": values that a reload kept, where that may surprise: somebody set them since
/// the start, or the file has another default now, which they do not follow.
std::string kept_text(const Parameters& before, const Parameters& after, const ParameterValues& configured);

/// Whether the set in use is one that these parameters take whole.
Expected<void> check_set(const Component& component, Parameters parameters);

/// Makes `settings` what they would be without the set in use, but for what was set since.
void leave_set(const Component& component, Parameters& settings);

/// Makes of `settings`, which an earlier version had, what somebody's choice of a set since then has made of those that
/// run: the parameters of all sets but those that were set since. `with_own`: also by the component itself.
void follow_use(const Component& component, const Parameters& running, bool with_own, Parameters& settings);

/// Says which values of `state` were dropped.
void describe_dropped(const std::vector<Dropped>& dropped, std::vector<std::string>& warnings);

}  // namespace nezumi
