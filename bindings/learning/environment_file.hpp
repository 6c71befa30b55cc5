// A file that describes an environment for a learning program: the call `environment { ... }`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <lua.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/project/project.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// A part of the space of actions or of observations: `{ "ranges", count = 4, min = 0, max = 0.3 }`.
struct SpacePart {
    std::string name;
    std::size_t count = 1;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
};

/// The number of values of all parts.
std::size_t width_of(const std::vector<SpacePart>& parts);

struct EnvironmentSpec {
    std::string system;      ///< as the file names it
    std::int64_t ticks = 1;  ///< ticks of a step
    std::int64_t limit = 0;  ///< steps after which an episode is truncated; 0: no limit
    std::vector<SpacePart> action, observation;
    Place place;  ///< of the call `environment { ... }`
};

/// The functions of an environment, in Lua.
enum class EnvironmentFunction : unsigned char {
    start,       ///< (): returns a table of values, as for `--set`; called before the system is built
    reset,       ///< (world): called after the start, before the first tick
    act,         ///< (world, action): called before the ticks of a step
    observe,     ///< (world): returns the numbers of the observation, also in nested lists
    reward,      ///< (world, action): returns a number
    terminated,  ///< (world): returns whether the episode has ended
};

struct EnvironmentFunctionInfo {
    std::string_view name;
    int arguments;
    bool required;
};
inline constexpr std::array<EnvironmentFunctionInfo, 6> environment_functions{{{"start", 0, false},
                                                                               {"reset", 1, false},
                                                                               {"act", 2, true},
                                                                               {"observe", 1, true},
                                                                               {"reward", 2, true},
                                                                               {"terminated", 1, false}}};

class EnvironmentFile {
public:
    /// Runs the file, which only describes the environment. `project` must outlive the result. `seed` is for
    /// `math.random`; `print` gets the output, a line at a time. `errors` gets all mistakes; may be null.
    static Expected<std::unique_ptr<EnvironmentFile>> read(const SourceText& source, const Project& project,
                                                           std::uint64_t seed,
                                                           std::function<void(std::string_view)> print,
                                                           std::vector<Error>* errors = nullptr);

    const EnvironmentSpec& spec() const { return spec_; }
    LuaState& state() const { return LuaState::of(file_->lua()); }
    /// Finds the file of the environment's system. An error has the location of the call.
    Expected<std::filesystem::path> find_system(const Project& project) const;
    bool has(EnvironmentFunction function) const;
    /// Pushes the function, which must exist. Raises no Lua error.
    static void push(lua_State* lua, EnvironmentFunction function);
    /// The error with the name of the function before it, as in "reward: ...", and with a location.
    Error to_error(EnvironmentFunction function, const Error& error) const;

private:
    EnvironmentFile() = default;
    static int word(lua_State* lua);
    Expected<void> read_call(lua_State* lua);
    Expected<void> check_functions(lua_State* lua);

    EnvironmentSpec spec_;
    bool is_called_ = false;
    std::array<bool, environment_functions.size()> given_{};
    std::array<Place, environment_functions.size()> places_{};  // of the functions
    std::unique_ptr<DataFile> file_;
};

}  // namespace nezumi
