// Internal values that a script shows with `probe(name, value)`.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

class Script;

/// The probes of one version of a script. They can be shown and recorded, and are not part of the trace hash.
class Probes {
public:
    static constexpr std::size_t most = 64;          ///< of a component
    static constexpr std::size_t most_entries = 64;  ///< of a table
    static constexpr std::size_t most_text = 1000;   ///< [bytes] of all texts of a value
    static constexpr std::size_t longest_name = 100;

    /// Sets a probe. An error if the name is not an identifier, or if there are too many probes.
    Expected<void> set(std::string_view name, PlainData value, double seconds);
    void clear() { probes_.clear(); }
    /// All probes, in the order of their first use.
    const std::vector<Probe>& all() const { return probes_; }

private:
    std::vector<Probe> probes_;
};

/// Sets `probe` in the table of globals, which is on top of the stack. May raise a Lua error (memory).
void set_probe_global(lua_State* L, Script& script);

}  // namespace nezumi
