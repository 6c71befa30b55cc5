// The constraint of a parameter in RTCBuilder's profile: bounds and choices.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

struct ProfileConstraint {
    std::optional<double> min, max;    ///< inclusive
    std::vector<std::string> choices;  ///< as texts
    std::vector<std::string> remarks;  ///< the parts that nezumi can't express, one line each

    bool operator==(const ProfileConstraint&) const = default;
};

/// Reads a `Constraint` element; an empty node means no constraint. `is_integer`: the parameter is an integer, so that
/// `x > 3` becomes the lower bound 4.
ProfileConstraint read_constraint(const pugi::xml_node& constraint, bool is_integer);

/// Writes bounds and choices of a parameter into its element; writes nothing if it has none.
void write_constraint(const ParameterSpec& spec, pugi::xml_node configuration);

}  // namespace nezumi::openrtm
