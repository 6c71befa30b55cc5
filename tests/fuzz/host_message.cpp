// What another host or a node of ROS sends: announcements, messages of ports, topics, sealed ones. Nothing of it may do
// more than count as wrong.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "bindings/dds/host_table.hpp"
#include "bindings/dds/port_topic.hpp"
#include "bindings/dds/request.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/sealed_transport.hpp"
#include "bindings/dds/step.hpp"
#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"
#include "engine/values/cdr.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

// Gives one message.
class OneMessage final : public dds::Reader {
public:
    explicit OneMessage(std::span<const std::uint8_t> bytes) : bytes_(bytes.begin(), bytes.end()) {}
    std::vector<dds::TopicSample> take() override { return {{std::exchange(bytes_, {}), 1}}; }
    std::vector<std::uint64_t> writers() const override { return {1}; }
    std::uint64_t lost() const override { return 0; }

private:
    Octets bytes_;
};

void announce(std::span<const std::uint8_t> bytes) {
    dds::HostTable hosts({.protocol = dds::protocol, .host = "me", .version = "1"}, 1, bytes.size() % 2 == 0);
    hosts.heard(1, bytes, 0);
    hosts.heard(2, bytes, 1);
    const std::uint64_t writers[] = {2};
    hosts.keep(writers, 10);
    for (const dds::Announcement* host : hosts.all()) require(hosts.find(host->head.host) == host);
}

// What a host in lockstep says with its tick.
void step(std::span<const std::uint8_t> bytes) {
    dds::Step read;
    if (!read_cdr(bytes, {.header = true}, read)) return;
    for (const dds::StepMessage& message : read.messages) {
        for (const MessageType& each : compiled_message_types()) {
            const MessageType* const type = &each;
            const auto value = dds::read_message(type, message.payload);
            require(!value || (message_of(value->type()) == type && is_finite(*value)));
        }
    }
}

// What is read of a request can be looked through without a check.
void request(std::span<const std::uint8_t> bytes) {
    dds::RemoteRequest read;
    if (!read_cdr(bytes, {.header = true}, read)) return;
    const PlainData& data = read.values;
    if (!is_sound(data)) return;
    for (const Value& value : data.values) {
        const auto* table = value.get_if<TableRef>();
        require(table == nullptr || table->index < data.tables.size());
    }
    Octets written;
    write_cdr(written, {.header = true}, data);
    PlainData again;
    require(read_cdr(written, {.header = true}, again).has_value() && (again == data || !is_finite(data)));
}

void receive(const MessageType* type, std::span<const std::uint8_t> bytes) {
    dds::Progress progress;
    dds::Inlet inlet(type, std::make_unique<OneMessage>(bytes), progress);
    inlet.receive(1, 1, [&](const Value& value) { require(message_of(value.type()) == type && is_finite(value)); });
}

void subscribe(const ros::Mapping& mapping, std::span<const std::uint8_t> bytes) {
    if (mapping.subscribe == nullptr) return;
    mapping.subscribe(std::make_unique<OneMessage>(bytes))->receive(1, [&](const Value& value) {
        require(message_of(value.type()) == mapping.port_type && is_finite(value));
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    const std::size_t kinds = 3 + compiled_message_count + ros::mappings().size();
    std::size_t kind = data[0] % kinds;
    if (kind == 0) {
        announce(bytes);
        step(bytes);
    } else if (kind == 1) {
        require(!dds::unseal(bytes, {.name = "a", .type = "b"}, dds::Secret{}).has_value());
    } else if (kind == kinds - 1) {
        request(bytes);
    } else if (kind -= 2; kind < compiled_message_count) {
        receive(&compiled_message_types()[kind], bytes);
    } else {
        subscribe(ros::mappings()[kind - compiled_message_count], bytes);
    }
    return 0;
}
