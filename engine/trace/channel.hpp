// Everything of a system that can be recorded: every node of its tree with a value, by its name in the console.
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

/// Whether the path of a leaf is `part` or within it: "pose.heading" in "pose", all in "".
bool is_within(std::string_view path, std::string_view part);

/// Members of a component, besides ports, that change while it runs and can be recorded: "truth", "config", "state",
/// ... Sorted.
std::vector<std::string> changing_members(const TreeNode& component);

/// A recorded value, or a part of one. A channel is identified by its name, so it survives a change of its port, a
/// reload and a restart.
///
/// The values of a tick: for an out-port all published messages, for an in-port all messages that arrived (through
/// connections, `inject` and `hold`), for `config` the parameters in ticks with a change, for a script's `state`,
/// `tasks` and `probes` their state after the execution, for any other value its state after all ports have latched.
/// The truth about a robot is from the moment of its sensor readings.
class Channel {
public:
    /// The channel with this name ("mouse.truth.pose") in a system. The error has the part that does not exist, and the
    /// nearest name.
    static Expected<Channel> find(const System& system, std::string_view name);

    std::string name() const { return join_path(whole_, part_); }
    /// The name of the whole value: "mouse.truth"; and of the part: "pose", "" for all.
    const std::string& whole() const { return whole_; }
    const std::string& part() const { return part_; }
    /// Whether its value stays valid until the next one; true only for `config`.
    bool holds() const { return kind_ == Kind::config; }
    /// The name of a leaf: "mouse.truth.pose.heading", "mouse.ir_sensor_out[1]".
    std::string name_of(const LeafPath& path) const;

    /// Whether the system has this channel now.
    bool exists() const { return kind_ != Kind::none; }
    /// Whether there was a value since the start.
    bool has_value() const { return has_value_; }
    /// Number of messages in the last latched tick. A channel that is not a port has one value in each tick; `config`
    /// only in ticks with a change.
    std::size_t fresh() const { return fresh_; }
    /// Number of ticks with new messages, for readers that do not read in every tick.
    std::uint64_t turn() const { return turn_; }
    /// Visits the numbers, booleans and texts of a message of the last latched tick; 0 is the oldest.
    void visit(std::size_t message, const LeafVisitor& visit) const;
    /// A message of the last latched tick, only for ports. It stays valid until the next tick.
    MessageView message(std::size_t message) const { return node_->port()->message(message); }
    /// The port; null for other channels.
    const Port* port() const { return is_port() ? node_->port() : nullptr; }
    /// Visits the numbers, booleans and texts of the latest message; zeros if there was none.
    void visit_latest(const LeafVisitor& visit) const;

    /// Call this after the layout of the system has changed.
    void resolve(const System& system);
    /// Copies the messages of this tick. They can be visited until the next tick.
    void latch(std::int64_t tick);
    /// Adds the messages of the last latched tick to a series; `seconds` is the time stamp for values without one. If
    /// the series is empty, `config` adds its present values.
    void append_to(Series& series, double seconds) const;
    bool is_port() const { return kind_ == Kind::out_port || kind_ == Kind::in_port; }
    /// Whether its messages are pictures.
    bool has_pictures() const;

private:
    enum class Kind { none, out_port, in_port, config, data, value };

    Channel(std::string whole, std::string part) : whole_(std::move(whole)), part_(std::move(part)) {}

    std::string whole_;  // "mouse.truth"
    std::string part_;   // "pose"; "" for all

    Kind kind_ = Kind::none;
    std::optional<TreeNode> node_;  // the whole value
    NodeValue value_;               // of `Kind::value`, when it latched
    std::uint64_t config_version_ = 0;
    std::uint64_t turn_ = 0;
    std::size_t fresh_ = 0;
    bool has_value_ = false;
};

}  // namespace nezumi
