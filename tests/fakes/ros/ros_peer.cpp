// A program of ROS 2's middleware: eProsima Fast DDS with the topics, types and QoS of ROS 2's nodes (rmw_fastrtps).
//
// Usage: ros_peer DOMAIN MESSAGES
//
// MESSAGES is tests/golden/ros_messages. Of each the peer subscribes to /from/PORT/TYPE and publishes on /to/PORT/TYPE,
// ten times a second, until its standard input ends; /clock it only hears. What it says, one line each, tab between:
//   sends  PORT TYPE VALUES BYTES             what the message is to Fast DDS, and the bytes that it makes of it
//   heard  PORT TYPE VALUES BYTES             a message that came
//   found  TOPIC TYPE RELIABILITY USER_DATA   a writer that somebody else has
// FASTRTPS_DEFAULT_PROFILES_FILE and ROS_LOCALHOST_ONLY=1 are what they are to ROS 2's nodes.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "message_text.hpp"
#include "ros_messagesPubSubTypes.h"

namespace ros_peer {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;

std::mutex saying;

void say(const std::string& line) {
    const std::lock_guard lock(saying);
    std::cout << line << std::endl;
}

[[noreturn]] void fail(const std::string& why) {
    std::cerr << "ros_peer: " << why << '\n';
    std::exit(1);
}

std::string hex(const SerializedPayload_t& payload) {
    std::string text;
    for (std::uint32_t i = 0; i < payload.length; ++i) text += fmt::format("{:02x}", payload.data[i]);
    return text;
}

// What this thread has deserialized last.
thread_local std::string bytes_read;

/// A type whose messages are told.
class Told {
public:
    virtual ~Told() = default;
    virtual std::string text(const void* message) const = 0;
};

template <class Generated>
class ToldType final : public Generated, public Told {
public:
    explicit ToldType(const std::string& name) {
        this->setName(name.c_str());
        this->auto_fill_type_object(false);  // as ROS 2 has it
        this->auto_fill_type_information(false);
    }
    bool deserialize(SerializedPayload_t* payload, void* data) override {
        bytes_read = hex(*payload);
        return Generated::deserialize(payload, data);
    }
    std::string text(const void* message) const override {
        Text to;
        to.put(*static_cast<const typename Generated::type*>(message));
        return to.text();
    }
};

/// "geometry_msgs/msg/Twist" as ROS 2 calls it in DDS.
std::string dds_name(std::string_view type) {
    const std::size_t slash = type.find('/');
    std::string name(type.substr(type.rfind('/') + 1));
    if (name == "RangeOfHumble") name = "Range";
    return fmt::format("{}::msg::dds_::{}_", type.substr(0, slash), name);
}

using MakeType = TopicDataType* (*)(const std::string& name);

template <class Generated>
TopicDataType* make(const std::string& name) {
    return new ToldType<Generated>(name);
}

const std::map<std::string, MakeType, std::less<>> types{
    {"geometry_msgs/msg/Twist", make<geometry_msgs::msg::dds_::Twist_PubSubType>},
    {"geometry_msgs/msg/TwistStamped", make<geometry_msgs::msg::dds_::TwistStamped_PubSubType>},
    {"geometry_msgs/msg/PoseStamped", make<geometry_msgs::msg::dds_::PoseStamped_PubSubType>},
    {"nav_msgs/msg/Odometry", make<nav_msgs::msg::dds_::Odometry_PubSubType>},
    {"tf2_msgs/msg/TFMessage", make<tf2_msgs::msg::dds_::TFMessage_PubSubType>},
    {"rosgraph_msgs/msg/Clock", make<rosgraph_msgs::msg::dds_::Clock_PubSubType>},
    {"sensor_msgs/msg/LaserScan", make<sensor_msgs::msg::dds_::LaserScan_PubSubType>},
    {"sensor_msgs/msg/Range", make<sensor_msgs::msg::dds_::Range_PubSubType>},
    {"sensor_msgs/msg/RangeOfHumble", make<sensor_msgs::msg::dds_::RangeOfHumble_PubSubType>},
    {"sensor_msgs/msg/Image", make<sensor_msgs::msg::dds_::Image_PubSubType>},
    {"sensor_msgs/msg/CompressedImage", make<sensor_msgs::msg::dds_::CompressedImage_PubSubType>},
    {"sensor_msgs/msg/CameraInfo", make<sensor_msgs::msg::dds_::CameraInfo_PubSubType>},
    {"sensor_msgs/msg/Joy", make<sensor_msgs::msg::dds_::Joy_PubSubType>},
    {"std_msgs/msg/Bool", make<std_msgs::msg::dds_::Bool_PubSubType>},
    {"std_msgs/msg/Int16", make<std_msgs::msg::dds_::Int16_PubSubType>},
    {"std_msgs/msg/Int32", make<std_msgs::msg::dds_::Int32_PubSubType>},
    {"std_msgs/msg/Float32", make<std_msgs::msg::dds_::Float32_PubSubType>},
    {"std_msgs/msg/Float64", make<std_msgs::msg::dds_::Float64_PubSubType>},
    {"std_msgs/msg/String", make<std_msgs::msg::dds_::String_PubSubType>},
    {"std_msgs/msg/Int16MultiArray", make<std_msgs::msg::dds_::Int16MultiArray_PubSubType>},
    {"std_msgs/msg/Int32MultiArray", make<std_msgs::msg::dds_::Int32MultiArray_PubSubType>},
    {"std_msgs/msg/Float32MultiArray", make<std_msgs::msg::dds_::Float32MultiArray_PubSubType>},
    {"std_msgs/msg/Float64MultiArray", make<std_msgs::msg::dds_::Float64MultiArray_PubSubType>},
    {"my_msgs/msg/Obstacle", make<my_msgs::msg::dds_::Obstacle_PubSubType>},
};

/// A message of tests/golden/ros_messages.
struct Golden {
    std::string port;  ///< its type
    std::string type;  ///< of ROS 2
    std::vector<std::uint8_t> bytes;
};

std::vector<Golden> read_golden(const char* path) {
    std::ifstream file(path);
    std::vector<Golden> all;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line.front() == '#' || line.find('{') != line.npos) continue;
        if (line.front() != ' ') {
            std::istringstream words(line);
            words >> all.emplace_back().port >> all.back().type;
            continue;
        }
        for (std::size_t i = line.find_first_not_of(' '); i + 1 < line.size(); i += 2)
            all.back().bytes.push_back(static_cast<std::uint8_t>(std::stoi(line.substr(i, 2), nullptr, 16)));
    }
    if (all.empty()) fail(fmt::format("{} has no messages", path));
    return all;
}

// rmw_qos_profile_sensor_data where a node of ROS 2 would have it, else rmw_qos_profile_default.
bool is_sensor_data(std::string_view type) {
    return (type.substr(0, 12) == "sensor_msgs/" && type != "sensor_msgs/msg/Joy") || type == "rosgraph_msgs/msg/Clock";
}

template <class Qos>
void set_qos(Qos& qos, std::string_view type) {
    const bool sensor = is_sensor_data(type);
    qos.reliability().kind = sensor ? BEST_EFFORT_RELIABILITY_QOS : RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = sensor ? 5 : 10;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
}

/// Says whom it has found.
class Finder final : public DomainParticipantListener {
    void on_publisher_discovery(DomainParticipant* /*who*/,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override {
        if (found.status != eprosima::fastrtps::rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
        const auto& qos = found.info.m_qos;
        const auto& octets = qos.m_userData.getValue();
        say(fmt::format("found\t{}\t{}\t{}\t{}", found.info.topicName(), found.info.typeName(),
                        qos.m_reliability.kind == RELIABLE_RELIABILITY_QOS ? "reliable" : "best effort",
                        std::string(octets.begin(), octets.end())));
    }
};

/// One message: a publisher and a subscriber of it.
class Exchange final : public DataReaderListener {
public:
    Exchange(DomainParticipant& participant, Publisher& publisher, Subscriber& subscriber, const Golden& golden)
        : golden_(golden), type_(types.at(golden.type)(dds_name(golden.type))) {
        type_.register_type(&participant);
        told_ = dynamic_cast<Told*>(type_.get());
        message_ = type_.create_data();
        const std::string name = golden.type.substr(golden.type.rfind('/') + 1);
        const bool is_clock = golden.port == "-";
        const auto topic = [&](const char* way) {
            const std::string its = is_clock ? "rt/clock" : fmt::format("rt/{}/{}/{}", way, golden.port, name);
            Topic* made = participant.create_topic(its, type_.get_type_name(), TOPIC_QOS_DEFAULT);
            if (made == nullptr) fail(fmt::format("there is no topic for {}", golden.type));
            return made;
        };
        DataReaderQos reader = DATAREADER_QOS_DEFAULT;
        set_qos(reader, golden.type);
        DataWriterQos writer = DATAWRITER_QOS_DEFAULT;
        set_qos(writer, golden.type);
        writer.publish_mode().kind = ASYNCHRONOUS_PUBLISH_MODE;
        if (!is_clock) writer_ = publisher.create_datawriter(topic("to"), writer);
        const auto* made = subscriber.create_datareader(topic("from"), reader, this);
        if (made == nullptr || (writer_ == nullptr && !is_clock)) fail(golden.type + " can't be exchanged");
        read_golden_bytes();
    }
    ~Exchange() override { type_.delete_data(message_); }
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

    void publish() {
        if (writer_ != nullptr) writer_->write(message_);
    }

private:
    // What is sent is what Fast DDS makes of the bytes.
    void read_golden_bytes() {
        SerializedPayload_t given(static_cast<std::uint32_t>(golden_.bytes.size()));
        given.length = given.max_size;
        std::copy(golden_.bytes.begin(), golden_.bytes.end(), given.data);
        if (!type_.deserialize(&given, message_)) fail(fmt::format("Fast DDS can't read the {}", golden_.type));
        SerializedPayload_t made(type_.get_serialized_size_provider(message_)() + 64);
        if (!type_.serialize(message_, &made)) fail(fmt::format("Fast DDS can't write the {}", golden_.type));
        tell("sends", message_, hex(made));
    }
    void on_data_available(DataReader* reader) override {
        void* got = type_.create_data();
        SampleInfo info;
        while (reader->take_next_sample(got, &info) == ReturnCode_t::RETCODE_OK) {
            if (info.valid_data) tell("heard", got, bytes_read);
        }
        type_.delete_data(got);
    }
    void tell(const char* what, const void* message, const std::string& bytes) const {
        say(fmt::format("{}\t{}\t{}\t{}\t{}", what, golden_.port, golden_.type, told_->text(message), bytes));
    }

    Golden golden_;
    TypeSupport type_;
    Told* told_ = nullptr;
    void* message_ = nullptr;
    DataWriter* writer_ = nullptr;
};

/// A node of ROS 2: one context, one participant.
class Node {
public:
    explicit Node(std::uint32_t domain) {
        DomainParticipantFactory& factory = *DomainParticipantFactory::get_instance();
        factory.load_profiles();  // FASTRTPS_DEFAULT_PROFILES_FILE
        DomainParticipantQos qos = factory.get_default_participant_qos();
        static constexpr std::string_view enclave = "enclave=/;";
        qos.user_data().setValue({enclave.begin(), enclave.end()});
        const char* localhost = std::getenv("ROS_LOCALHOST_ONLY");
        if (localhost != nullptr && localhost == std::string_view("1")) {
            qos.transport().use_builtin_transports = false;
            const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
            udp->interfaceWhiteList.emplace_back("127.0.0.1");
            qos.transport().user_transports.push_back(udp);
            qos.transport().user_transports.push_back(
                std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>());
        }
        participant_ = factory.create_participant(domain, qos, &finder_, StatusMask::none());
        if (participant_ == nullptr) fail("there is no participant");
        publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
        subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    }
    ~Node() {
        participant_->delete_contained_entities();
        DomainParticipantFactory::get_instance()->delete_participant(participant_);
    }
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    void add(const Golden& golden) {
        exchanges_.push_back(std::make_unique<Exchange>(*participant_, *publisher_, *subscriber_, golden));
    }
    void publish() {
        for (const auto& each : exchanges_) each->publish();
    }

private:
    Finder finder_;
    std::vector<std::unique_ptr<Exchange>> exchanges_;
    DomainParticipant* participant_ = nullptr;
    Publisher* publisher_ = nullptr;
    Subscriber* subscriber_ = nullptr;
};

int run(std::uint32_t domain, const char* messages) {
    // Two definitions of one type don't meet in one participant, as in ROS 2.
    Node node(domain), humble(domain);
    for (const Golden& golden : read_golden(messages))
        (golden.type == "sensor_msgs/msg/RangeOfHumble" ? humble : node).add(golden);
    std::atomic<bool> over = false;
    std::thread input([&] {
        while (std::getchar() != EOF) {
        }
        over = true;
    });
    while (!over) {
        node.publish();
        humble.publish();
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    input.join();
    return 0;
}

}  // namespace
}  // namespace ros_peer

int main(int count, char** words) {
    if (count != 3) ros_peer::fail("usage: ros_peer DOMAIN MESSAGES");
    return ros_peer::run(static_cast<std::uint32_t>(std::atoi(words[1])), words[2]);
}
