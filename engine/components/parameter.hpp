// Parameters: named values with bounds and a description, that hold whoever sets them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// Values by parameter name, as a system file or a named set gives them. Ordered, so that messages are the same each
/// time.
using ParameterValues = std::map<std::string, Value, std::less<>>;

/// How a parameter is declared. The type of its values follows the default: truth value, integer (`std::int64_t`),
/// number (`double`), text, or an array of one of them.
struct ParameterSpec {
    std::string name;
    Value initial;              ///< the default
    std::optional<double> min;  ///< inclusive, per element of an array
    std::optional<double> max;  ///< inclusive, per element of an array
    double step = 0;            ///< of widgets only, binds no value; 0: none
    std::string widget;         ///< "slider", "spin", "text", "checkbox", "radio", ... as in OpenRTM; may be empty
    std::string unit;
    std::string doc;
    std::vector<Value> choices;           ///< empty: any value within the bounds
    std::optional<std::size_t> min_size;  ///< of an array
    std::optional<std::size_t> max_size;  ///< of an array
    Place place;
};

/// "number", "integer", "boolean", "string", "array of numbers", ...
std::string type_text(const Value& value);

/// Checks a declaration on its own: finite bounds in order, choices of the default's type, a default that is allowed.
Expected<void> check_declaration(const ParameterSpec& spec);

/// `value` as this parameter would hold it (3 becomes 3.0 for a number, 3.0 becomes 3 for an integer), or why it may
/// not: "parameter 'speed_x' (number): 2.0 is above its maximum 1.5".
Expected<Value> check_value(const ParameterSpec& spec, const Value& value);

/// The parameters of one component, in the order of their declaration.
class Parameters {
public:
    struct Parameter {
        ParameterSpec spec;
        Value value;
        bool set = false;           ///< somebody gave it a value; else it follows the default, also of a later version
        bool from_outside = false;  ///< and that was not its component, since this version began
        bool from_within = false;   ///< and that was its component, since this version began
    };

    /// Adds a parameter at its default. An error when the declaration is wrong or the name is taken.
    Expected<void> declare(ParameterSpec spec);

    /// nullptr when there is none of this name.
    const Parameter* find(std::string_view name) const;
    const std::vector<Parameter>& all() const { return all_; }

    /// Sets one value at once. An error names the nearest parameter, or the bound that it breaks; then nothing changed.
    Expected<void> set(std::string_view name, const Value& value);
    /// Sets all of these or, when one of them is refused, none.
    Expected<void> set_all(const ParameterValues& values);
    /// Gives one back its default, as if nobody had ever set it. An unknown name is none.
    void follow_default(std::string_view name);
    /// For the component itself: sets one value that holds from the next `take_staged`. Checked now.
    Expected<void> stage(std::string_view name, const Value& value) { return stage(name, value, false); }
    /// Lets the staged values take effect. Returns whether there were any.
    bool take_staged();

    /// Takes over from an earlier version of the component every value that somebody set and that still fits.
    void adopt(const Parameters& earlier);
    /// The same of those alone that were set from outside.
    void adopt_from_outside(const Parameters& earlier);
    /// The same for one of them.
    void adopt(const Parameters& earlier, std::string_view name);
    /// From now on another version of its component runs: nothing was set from outside since.
    void begin_version();

    /// Grows with every change of a value: tells a cache that it is out of date.
    std::uint64_t version() const { return version_; }

private:
    Expected<std::size_t> index_of(std::string_view name) const;

    struct Staged {
        std::size_t index;
        Value value;
        bool from_outside;
    };
    Expected<void> stage(std::string_view name, const Value& value, bool from_outside);

    std::vector<Staged> staged_;
    std::uint64_t version_ = 0;
    std::vector<Parameter> all_;
};

}  // namespace nezumi
