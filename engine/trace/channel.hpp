// What can be recorded of a system: every node of its tree that has a value, by the name that a console calls it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {

class Series;

/// Whether a leaf's path is `part` or within it: "pose.heading" in "pose", all in "".
bool is_within(std::string_view path, std::string_view part);

/// Beside its ports, what a component has that changes while it runs and that a channel can follow: "truth", "config",
/// "state", ... Sorted.
std::vector<std::string> changing_members(const TreeNode& component);

/// One thing that is followed, or a part of it. It is known by name: it outlives its port, a reload and a restart.
///
/// What each kind has in a tick: an out-port all that it published, an in-port all that arrived (of connections, of
/// `inject` and of `hold`), `config` the parameters in the tick in which one changed, a script's `state`, `tasks` and
/// `probes` what they are after the execution, any other value what it was when all ports had latched: a robot's truth
/// as its sensors saw it.
class Channel {
public:
    /// The channel "mouse.truth.pose" of this system. An error says what is not there, and names the nearest.
    static Expected<Channel> find(const System& system, std::string_view name);

    std::string name() const { return join_path(whole_, part_); }
    /// What it is a part of: "mouse.truth"; and the part: "pose", "" for all.
    const std::string& whole() const { return whole_; }
    const std::string& part() const { return part_; }
    /// It holds its value from one message to the next: parameters do.
    bool holds() const { return kind_ == Kind::config; }
    /// What a leaf of it is called: "mouse.truth.pose.heading", "mouse.ir_sensor_out[1]".
    std::string name_of(const LeafPath& path) const;

    /// The system has it now.
    bool exists() const { return kind_ != Kind::none; }
    /// It has carried something since the start.
    bool has_value() const { return has_value_; }
    /// Messages of the tick that latched last; what is no port has one when it is new.
    std::size_t fresh() const { return fresh_; }
    /// Ticks with fresh messages: for those who look later than once a tick.
    std::uint64_t turn() const { return turn_; }
    /// Visits the numbers, truth values and texts of one of these, the oldest is 0.
    void visit(std::size_t message, const LeafVisitor& visit) const;
    /// Visits those of the latest message, or zeros when there was none: what it has.
    void visit_latest(const LeafVisitor& visit) const;

    /// To be called when the system's layout has changed.
    void resolve(const System& system);
    /// Takes a tick's messages: between this and the next tick they can be visited.
    void latch(std::int64_t tick);
    /// Adds the numbers, truth values and texts of these messages; `seconds` is the stamp of what carries none. An
    /// empty series gets what the channel holds.
    void append_to(Series& series, double seconds) const;
    bool is_port() const { return kind_ == Kind::out_port || kind_ == Kind::in_port; }
    /// It carries pictures.
    bool has_pictures() const;

private:
    enum class Kind { none, out_port, in_port, config, data, value };

    Channel(std::string whole, std::string part) : whole_(std::move(whole)), part_(std::move(part)) {}

    std::string whole_;  // "mouse.truth"
    std::string part_;   // "pose"; "" for all

    Kind kind_ = Kind::none;
    std::optional<TreeNode> node_;  // the whole
    NodeValue value_;               // of `Kind::value`, when it latched
    std::uint64_t config_version_ = 0;
    std::uint64_t turn_ = 0;
    std::size_t fresh_ = 0;
    bool has_value_ = false;
};

}  // namespace nezumi
