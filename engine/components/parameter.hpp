// Parameters: named values with limits and documentation.
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

/// Values by parameter name, as in a system file or a parameter set. Sorted, so that messages are the same each time.
using ParameterValues = std::map<std::string, Value, std::less<>>;

/// The declaration of a parameter. Its type is the type of the default: boolean, integer (`std::int64_t`), number
/// (`double`), text, or an array of one of these.
struct ParameterSpec {
    std::string name;
    Value initial;              ///< the default
    std::optional<double> min;  ///< inclusive, per element of an array
    std::optional<double> max;  ///< inclusive, per element of an array
    double step = 0;            ///< for widgets only; does not limit the value; 0: none
    std::string widget;         ///< "slider", "spin", "text", "checkbox", "radio", ... as in OpenRTM; may be empty
    std::string unit;
    std::string doc;
    std::vector<Value> choices;           ///< empty: any value within the limits
    std::optional<std::size_t> min_size;  ///< of an array
    std::optional<std::size_t> max_size;  ///< of an array
    Place place;
};

/// "number", "integer", "boolean", "string", "array of numbers", ...
std::string type_text(const Value& value);

/// Checks a declaration: finite limits in order, choices with the type of the default, and an allowed default.
Expected<void> check_declaration(const ParameterSpec& spec);

/// `value` as this parameter would store it (3 becomes 3.0 for a number, 3.0 becomes 3 for an integer), or the error:
/// "parameter 'speed_x' (number): 2.0 is above its maximum 1.5".
Expected<Value> check_value(const ParameterSpec& spec, const Value& value);

/// The parameters of one component, in the order of their declaration.
class Parameters {
public:
    struct Parameter {
        ParameterSpec spec;
        Value value;
        bool set = false;           ///< the value was set; otherwise it follows the default, also of a later version
        bool from_outside = false;  ///< the value was set from outside since this version began
        bool from_within = false;   ///< the component itself has set the value since this version began
    };

    /// Adds a parameter with its default. An error if the declaration is wrong or the name is taken.
    Expected<void> declare(ParameterSpec spec);

    /// nullptr if there is no parameter with this name.
    const Parameter* find(std::string_view name) const;
    const std::vector<Parameter>& all() const { return all_; }

    /// Sets one value immediately. The error names the nearest parameter, or the limit; then nothing has changed.
    Expected<void> set(std::string_view name, const Value& value);
    /// Sets all these values, or none if one is refused.
    Expected<void> set_all(const ParameterValues& values);
    /// Resets a parameter to its default, as if it had never been set. Unknown names are ignored.
    void follow_default(std::string_view name);
    /// For the component itself: sets a value that becomes effective at the next `take_staged`. It is checked now.
    Expected<void> stage(std::string_view name, const Value& value) { return stage(name, value, false); }
    /// Makes the staged values effective. Returns whether there were any.
    bool take_staged();

    /// Takes over every value that was set in an earlier version of the component and still fits.
    void adopt(const Parameters& earlier);
    /// Like `adopt`, only for values that were set from outside.
    void adopt_from_outside(const Parameters& earlier);
    /// Takes over the value of one parameter.
    void adopt(const Parameters& earlier, std::string_view name);
    /// Begins another version of the component: clears `from_outside` and `from_within` of all parameters.
    void begin_version();

    /// The index of a parameter in `all`. The error names the nearest parameter.
    Expected<std::size_t> index_of(std::string_view name) const;

    /// Grows with every change of a value, for caches.
    std::uint64_t version() const { return version_; }

private:
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
