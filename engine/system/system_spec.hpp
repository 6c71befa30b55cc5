// The description of a system, as in a system file.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/components/parameter.hpp"
#include "engine/world/arena_spec.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The backend of simulated components, and the default.
inline constexpr std::string_view simulated = "sim";
/// The backend of a real device that is connected to the computer by a wire.
inline constexpr std::string_view wired_backend = "wired";

/// Limits of a robot that a system file changes; the others are those of the model. Units as in `Limits`.
struct LimitChanges {
    std::optional<double> speed, yaw_rate, acceleration, yaw_acceleration;
    bool operator==(const LimitChanges&) const = default;
};

/// `robot NAME { model, pose, limits, backend }`.
struct RobotEntry {
    std::string name;
    std::string model;  ///< key of `SystemSpec::models`
    Pose2D pose;
    LimitChanges limits;
    std::string backend;            ///< key of `Makers::bodies`; "": "sim"
    bool calibrated = false;        ///< the simulated robot has the measured values as well
    bool odometry_at_pose = false;  ///< its odometry starts at `pose`, else at 0, 0, 0
    bool active = true;
    Place place;
    std::string description;  ///< key of the robot's own description in `SystemSpec::models`; "": `model`
    std::string changes;      ///< the fields of a robot file that differ from its model, as the text of a table
    std::string twin_of;      ///< the real robot whose twin this is, an earlier entry; "": none
    std::string driver{};     ///< the driver, a later behaviour entry (`add_script_drivers`); "": none

    /// The key of its description in `SystemSpec::models`.
    const std::string& described_by() const { return description.empty() ? model : description; }
    bool is_real() const { return !backend.empty() && backend != simulated; }
};

/// The locations of the fields of a table, by path: "config.speed_x".
using FieldPlaces = std::map<std::string, Place, std::less<>>;

/// `behavior NAME { script, config, sets, set, rate, active }`.
struct BehaviorEntry {
    std::string name;
    std::string script;  ///< as in the file
    std::string path;    ///< path of the script that was found
    ParameterValues config;
    std::map<std::string, ParameterValues, std::less<>> sets;
    std::string set;  ///< "" for none
    double rate = 0;  ///< [Hz]; 0: the rate of ticks
    bool active = true;
    Place place;
    FieldPlaces places{};  ///< of the values in `config` and `sets`
};

/// `component NAME { type, config, rate, ... }` for native components.
struct ComponentEntry {
    std::string name;
    std::string type;
    ParameterValues config;
    double rate = 0;      ///< [Hz]; 0: the default of the type
    std::string on;       ///< the robot that carries it; "" for none
    Point3D at{};         ///< [m] in that robot's body frame
    double yaw = 0;       ///< [rad]
    std::string backend;  ///< key of the factories of its type; "": "sim"
    bool active = true;
    /// For a Camera: the file that ROS's camera_calibration wrote. After reading, its values are in `config`, and this
    /// is "".
    std::string calibration{};
    Place place;
    FieldPlaces places{};  ///< of the values in `config`
};

using Entry = std::variant<RobotEntry, BehaviorEntry, ComponentEntry>;

/// The name of any entry, and its location.
const std::string& name_of(const Entry& entry);
const Place& place_of(const Entry& entry);

class PeerSpec;
class PeerWord;
/// Words that describe peers, in the order in which they check a system. The words must outlive all users.
using PeerWords = std::vector<const PeerWord*>;

/// `connect(from, to)`, each "name.port"; "host/name.port" for a port of another host, "WORD:NAME.port" for one of
/// another program (`PeerWord::port_form`).
struct ConnectionSpec {
    std::string from;
    std::string to;
    Place place;

    bool operator==(const ConnectionSpec& other) const { return from == other.from && to == other.to; }
};

/// Whether a port is another program's: "WORD:NAME.port".
constexpr bool is_foreign(std::string_view path) { return path.find(':') != std::string_view::npos; }
/// Whether a component or port is another host's: "host/name", "host/name.port".
constexpr bool is_remote(std::string_view path) {
    return path.find('/') != std::string_view::npos && !is_foreign(path);
}
/// "host" of "host/name.port", and the rest.
constexpr std::string_view host_of(std::string_view path) { return path.substr(0, path.find('/')); }
constexpr std::string_view without_host(std::string_view path) { return path.substr(path.find('/') + 1); }

struct SystemSpec {
    std::string file;   ///< as it was given
    double rate = 100;  ///< [Hz] of the tick
    Place rate_place;
    double physics_step = 0.005;  ///< [s]
    std::optional<std::uint64_t> seed;
    ArenaSpec arena;
    std::map<std::string, RobotSpec> models;  ///< by the name that entries use
    std::vector<Entry> entries;               ///< in the order of the file
    std::vector<ConnectionSpec> connections;
    std::map<std::string, std::shared_ptr<const PeerSpec>, std::less<>> peers{};  ///< by their word
    std::vector<std::string> files;  ///< all files of the description: system, models, maps
};

/// The entries of one kind, in the order of the file.
template <class AnEntry, class Spec>
auto entries_of(Spec& spec) {
    std::vector<decltype(std::get_if<AnEntry>(spec.entries.data()))> found;
    for (auto& entry : spec.entries) {
        if (auto* each = std::get_if<AnEntry>(&entry)) found.push_back(each);
    }
    return found;
}

/// The entry of this kind with this name; null if there is none.
template <class AnEntry, class Spec>
auto find_entry(Spec& spec, std::string_view name) -> decltype(std::get_if<AnEntry>(spec.entries.data())) {
    for (auto* each : entries_of<AnEntry>(spec)) {
        if (each->name == name) return each;
    }
    return nullptr;
}

}  // namespace nezumi
