// One line per pair of types; the conversions are in convert.hpp.
#include "bindings/dds/ros/mapping.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bindings/dds/message_age.hpp"
#include "bindings/dds/ros/convert.hpp"
#include "bindings/dds/ros/type_hash.hpp"
#include "engine/messages/msg_text.hpp"
#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/limits.hpp"

namespace nezumi::ros {
namespace {

constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};

template <class Message>
void set_stamp(Message& message, double stamp, const std::string& frame) {
    if constexpr (requires { message.header; }) {
        message.header = {to_time(stamp), frame};
    } else if constexpr (std::is_same_v<Message, TFMessage>) {
        for (TransformStamped& transform : message.transforms) transform.header = {to_time(stamp), frame};
    }
}

// Computes the velocity of a moving object from its poses.
class Motion {
public:
    /// The mean velocity since the last pose, in the frame of the object; 0 for the first pose. `tm` [s]: time of
    /// `pose`.
    Velocity2D to(const Pose2D& pose, double tm) {
        const Pose2D from = std::exchange(pose_, pose);
        const double period = tm - std::exchange(tm_, tm).value_or(tm);
        if (!(period > 0)) return {};
        const double turn = std::remainder(pose.heading - from.heading, 2 * std::numbers::pi);
        const double dx = pose.position.x - from.position.x, dy = pose.position.y - from.position.y;
        const double c = std::cos(from.heading + turn / 2), s = std::sin(from.heading + turn / 2);
        return {.vx = (c * dx + s * dy) / period, .vy = (c * dy - s * dx) / period, .va = turn / period};
    }

private:
    Pose2D pose_;
    std::optional<double> tm_;  // [s]
};

template <class T, class Message>
class Sender final : public Publication {
public:
    Sender(InPort<T>& port, std::unique_ptr<dds::Writer> writer, std::string frame)
        : port_(port), writer_(std::move(writer)), frame_(std::move(frame)) {}

    void send(double offset, const Velocity2D* measured) override {
        while (port_.is_new()) {
            const nezumi::Message<T>& taken = port_.take();
            if constexpr (std::is_same_v<Message, Odometry>)
                to_ros(measured != nullptr ? *measured : motion_.to(taken.data, taken.tm), message_.twist.twist);
            send(taken.data, taken.tm + offset);
        }
    }
    void send_zero(double stamp) override {
        while (port_.is_new()) static_cast<void>(port_.take());
        send(T{}, stamp);
    }
    bool moves() const override { return moves_; }

private:
    void send(const T& payload, double stamp) {
        if constexpr (std::is_same_v<T, Velocity2D>) moves_ = payload != Velocity2D{};
        to_ros(payload, message_);
        set_stamp(message_, stamp, frame_);
        write_cdr(bytes_, on_the_wire, message_);
        static_cast<void>(writer_->write(bytes_));
    }

    InPort<T>& port_;
    std::unique_ptr<dds::Writer> writer_;
    std::string frame_;
    Motion motion_;
    Message message_;
    Octets bytes_;
    bool moves_ = false;
};

template <class T, class Message>
class Taker final : public Subscription {
public:
    explicit Taker(std::unique_ptr<dds::Reader> reader) : reader_(std::move(reader)) {}

    std::string receive(double clock, const Give& give) override {
        std::string problem;
        for (const dds::TopicSample& sample : reader_->take()) {
            Expected<void> read = take(sample.bytes, clock, give);
            if (!read) problem = read.error().message;
        }
        return problem;
    }

private:
    Expected<void> take(const Octets& bytes, double clock, const Give& give) {
        Expected<void> read = read_cdr(bytes, on_the_wire, message_);
        if constexpr (std::is_same_v<Message, Range>) {
            if (!read) read = read_without_variance(bytes);
        }
        if (read) read = from_ros(message_, payload_);
        if (!read) return read;
        if (!is_finite(payload_)) return failure("a number is not finite");
        if constexpr (std::is_same_v<T, Velocity2D> && requires { message_.header; }) {
            const double stamp = to_seconds(message_.header.stamp);
            if (stamp > 0 && age_.of(stamp, clock) > silence) return {};  // from an interrupted connection
        }
        give(payload_);
        return {};
    }
    // Reads the format of ROS 2 Humble, in which `Range` has no variance.
    Expected<void> read_without_variance(const Octets& bytes) {
        message_.variance = 0;
        return read_cdr(bytes, on_the_wire, message_.header, message_.radiation_type, message_.field_of_view,
                        message_.min_range, message_.max_range, message_.range);
    }

    std::unique_ptr<dds::Reader> reader_;
    dds::MessageAge age_;
    Message message_;
    T payload_{};
};

// Sends messages of a type that a file defines. They have no stamp, unless the type has a field for it.
class DefinedSender final : public Publication {
public:
    DefinedSender(InPort<Value>& port, std::unique_ptr<dds::Writer> writer) : port_(port), writer_(std::move(writer)) {}

    void send(double /*offset*/, const Velocity2D* /*measured*/) override {
        while (port_.is_new()) {
            write_cdr(bytes_, on_the_wire, ValueView(port_.take().data));
            static_cast<void>(writer_->write(bytes_));
        }
    }
    void send_zero(double /*stamp*/) override {}
    bool moves() const override { return false; }

private:
    InPort<Value>& port_;
    std::unique_ptr<dds::Writer> writer_;
    Octets bytes_;
};

class DefinedTaker final : public Subscription {
public:
    DefinedTaker(std::unique_ptr<dds::Reader> reader, const Type& payload)
        : reader_(std::move(reader)), payload_(payload) {}

    std::string receive(double /*clock*/, const Give& give) override {
        std::string problem;
        for (const dds::TopicSample& sample : reader_->take()) {
            Value value(payload_);
            const Expected<void> read = read_cdr(sample.bytes, on_the_wire, ValuePlace(value));
            std::string wrong = read ? find_misfit(ValueView(value)) : read.error().message;
            if (read && wrong.empty() && !is_finite(value)) wrong = "a number is not finite";
            if (wrong.empty()) {
                give(std::move(value));
            } else {
                problem = std::move(wrong);
            }
        }
        return problem;
    }

private:
    std::unique_ptr<dds::Reader> reader_;
    const Type& payload_;
};

template <class T, class Message>
MessageCoding coding_of(const std::string& frame) {
    MessageCoding made;
    made.type = Describe<Message>::name;
    made.definition = msg_text(type_of<Message>());
    made.write = [frame](Octets& out, const ValueView& payload, double tm) {
        Message message;
        to_ros(payload.as<T>(), message);
        set_stamp(message, tm, frame);
        write_cdr(out, on_the_wire, message);
    };
    if constexpr (requires(const Message& from, T& to) { from_ros(from, to); }) {
        made.read = [](std::span<const std::uint8_t> bytes, double tm) -> Expected<AnyMessage> {
            Message message;
            T payload{};
            Expected<void> read = read_cdr(bytes, on_the_wire, message);
            if (read) read = from_ros(message, payload);
            if (!read) return Unexpected(read.error());
            if (!is_finite(payload)) return failure("a number is not finite");
            if constexpr (requires { message.header.stamp; }) tm = to_seconds(message.header.stamp);
            return AnyMessage{Value(std::move(payload)), tm};
        };
    }
    return made;
}

template <class T, class Message>
Mapping pair(std::string_view frame, bool sensor_data) {
    Mapping made;
    made.port_type = message_of<T>();
    made.type = Describe<Message>::name;
    made.frame = frame;
    made.sensor_data = sensor_data;
    made.definition = &type_of<Message>();
    made.publish = [](InPortBase& port, std::unique_ptr<dds::Writer> writer,
                      const std::string& its_frame) -> std::unique_ptr<Publication> {
        return std::make_unique<Sender<T, Message>>(static_cast<InPort<T>&>(port), std::move(writer), its_frame);
    };
    if constexpr (requires(const Message& from, T& to) { from_ros(from, to); }) {
        made.subscribe = [](std::unique_ptr<dds::Reader> reader) -> std::unique_ptr<Subscription> {
            return std::make_unique<Taker<T, Message>>(std::move(reader));
        };
    }
    made.coding = coding_of<T, Message>;
    return made;
}

// The mapping of a type that a file defines: its payload is the message.
Mapping defined(const MessageType& type) {
    return {
        .port_type = &type,
        .type = type.ros,
        .definition = type.payload,
        .publish = [](InPortBase& port, std::unique_ptr<dds::Writer> writer,
                      const std::string&) -> std::unique_ptr<Publication> {
            return std::make_unique<DefinedSender>(static_cast<InPort<Value>&>(port), std::move(writer));
        },
        .subscribe = [&payload = *type.payload](std::unique_ptr<dds::Reader> reader) -> std::unique_ptr<Subscription> {
            return std::make_unique<DefinedTaker>(std::move(reader), payload);
        },
        .coding = [&payload = *type.payload](const std::string&) { return coding_of_structure(payload); }};
}

constexpr std::string_view body = "base_link", odometry = "odom", camera = "camera";

// [messages] Queue lengths of ROS's default profile and of its profile for sensor data.
constexpr int usual_depth = 10, sensor_depth = 5;

}  // namespace

std::span<const Mapping> mappings() {
    static const std::array all{
        pair<Velocity2D, Twist>("", false),
        pair<Velocity2D, TwistStamped>(body, false),
        pair<Pose2D, Odometry>(odometry, false),
        pair<Pose2D, TFMessage>(odometry, false),
        pair<Pose3D, PoseStamped>(odometry, false),
        pair<RangeData, LaserScan>(body, true),
        pair<RangeData, Range>(body, true),
        pair<CameraImage, Image>(camera, true),
        pair<CameraImage, CompressedImage>(camera, true),
        pair<CameraIntrinsics, CameraInfo>(camera, true),
        pair<bool, Bool>("", false),
        pair<std::int16_t, Int16>("", false),
        pair<std::int32_t, Int32>("", false),
        pair<float, Float32>("", false),
        pair<double, Float64>("", false),
        pair<std::string, String>("", false),
        pair<std::vector<std::int16_t>, Int16MultiArray>("", false),
        pair<std::vector<std::int32_t>, Int32MultiArray>("", false),
        pair<std::vector<float>, Float32MultiArray>("", false),
        pair<std::vector<float>, Joy>("", false),
        pair<std::vector<double>, Float64MultiArray>("", false),
        pair<std::vector<bool>, Joy>("", false),
    };
    return all;
}

Expected<Mapping> find_mapping(const MessageType* port_type, std::string_view type, bool takes) {
    std::vector<std::string_view> types;
    if (!port_type->is_compiled()) {
        if (port_type->ros.empty()) {
            return failure(fmt::format("{} has no name in ROS: write ros = \"PACKAGE/msg/NAME\" in {}", port_type->name,
                                       port_type->file));
        }
        if (type.empty() || type == port_type->ros) return defined(*port_type);
        types.push_back(port_type->ros);
    }
    for (const Mapping& each : mappings()) {
        if (each.port_type != port_type || (takes && each.subscribe == nullptr)) continue;
        if (type.empty() || each.type == type) return each;
        types.push_back(each.type);
    }
    const std::string_view name = port_type->name;
    if (types.empty()) return failure(fmt::format("there is no type of ROS for {}", name));
    return failure(fmt::format(
        "{} {} '{}'{}; the possible {} {}", name, takes ? "can't be made from" : "can't be sent as", shown(type),
        did_you_mean(type, types), types.size() == 1 ? "type is" : "types are", fmt::join(types, ", ")));
}

std::optional<MessageCoding> find_coding(const MessageType& port_type, std::string_view type) {
    if (!port_type.is_compiled()) {
        if (port_type.ros.empty() || (!type.empty() && type != port_type.ros)) return std::nullopt;
        return coding_of_structure(*port_type.payload);
    }
    const Mapping* found = nullptr;
    for (const Mapping& each : mappings()) {
        if (each.port_type != &port_type || (!type.empty() && each.type != type)) continue;
        if (found == nullptr || (found->frame.empty() && !each.frame.empty())) found = &each;
    }
    if (found == nullptr) return std::nullopt;
    return found->coding(std::string(found->frame));
}

dds::Topic topic_of(std::string_view name, const Mapping& mapping, bool writes) {
    // A best-effort reader receives from any writer, a reliable one only from a reliable writer. Of velocities only the
    // newest is useful.
    const bool velocity = mapping.port_type == message_of<Velocity2D>();
    return {.name = fmt::format("rt{}", name),
            .type = dds_type_name(mapping.type),
            .reliable = !mapping.sensor_data && (writes || !velocity),
            .depth = velocity && !writes   ? 1
                     : mapping.sensor_data ? sensor_depth
                                           : usual_depth,
            .user_data = fmt::format("typehash={};", type_hash(*mapping.definition))};
}

}  // namespace nezumi::ros
