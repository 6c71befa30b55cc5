// Measures how long each line of a script takes. It takes no time while it is not used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi {

/// A tree of call stacks with the time of each line, for flame graphs.
class LineCosts {
public:
    /// A function on the stack, or the line that it was executing.
    struct Node {
        std::size_t parent = 0;  ///< index; of the root: 0
        std::string name{};      ///< of a function: "nearest", "" for unknown; of a line ""
        std::string file{};      ///< its name in messages
        int line = 0;            ///< where the function begins, or the line
        bool is_line = false;
        std::int64_t nanoseconds = 0;  ///< CPU time of the line itself; functions have none
        std::int64_t count = 0;        ///< how often the line began
    };
    LineCosts() : nodes_(1) {}

    /// The first node is the root; parents come before their children.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// The child of `parent` for this function or line.
    std::size_t child(std::size_t parent, std::string_view name, std::string_view file, int line, bool is_line);
    void add(std::size_t node, std::int64_t nanoseconds) { nodes_[node].nanoseconds += nanoseconds; }
    void begin(std::size_t node) { ++nodes_[node].count; }

private:
    std::vector<Node> nodes_;
    std::map<std::pair<std::size_t, std::pair<std::string, int>>, std::size_t> children_;
};

/// The measured executions of a behaviour.
struct ExecutionProfile {
    static constexpr std::size_t most_times = 1'000'000;
    bool by_line = false;
    std::vector<std::int64_t> times{};  ///< [ns] CPU time of each execution, at most `most_times`
    LineCosts lines{};                  ///< if `by_line`

    void add(std::int64_t nanoseconds) {
        if (times.size() < most_times) times.push_back(nanoseconds);
    }
};

/// Measures the lines that this thread executes during its lifetime. A line's time includes the C functions that it
/// calls; the time of measuring is left out as far as it is known.
class LineProfile {
public:
    explicit LineProfile(LineCosts& costs);
    ~LineProfile();
    LineProfile(const LineProfile&) = delete;
    LineProfile& operator=(const LineProfile&) = delete;

    /// Called for a coroutine that is about to run: if this thread measures lines, also measures those of the
    /// coroutine, unless it has another hook.
    static void follow(lua_State* coroutine);

    /// [ns] CPU time that measuring has taken.
    std::int64_t time_of_hooks() const { return hooks_; }

private:
    static constexpr int deepest = 40;

    static void on_event(lua_State* lua, lua_Debug* event);
    void note(lua_State* lua, lua_Debug* event);

    LineCosts& costs_;
    LineProfile* outer_;
    std::size_t present_ = 0;  // the line that runs; 0: none
    std::int64_t since_;       // [ns] CPU time up to which costs are counted
    std::int64_t hooks_ = 0;
};

}  // namespace nezumi
