// Message types that a .msg file defines, and a device with ports of one.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>

#include "engine/components/component.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/messages/msg_file.hpp"
#include "engine/ports/port.hpp"

namespace nezumi::dds {

inline MessageDefinition definition_of(const std::string& name, const std::string& text) {
    auto read = read_msg({name + ".msg", name + ".msg", text}, "my_msgs");
    INFO((read ? "" : describe(read.error())));
    REQUIRE(read);
    return *read;
}

inline const MessageType* define(const MessageDefinition& definition, const Type* inner = nullptr) {
    const auto made = MessageCatalog::shared().define(
        definition, [&](const FieldDefinition&) -> Expected<const Type*> { return inner; });
    INFO((made ? "" : describe(made.error())));
    REQUIRE(made);
    return *made;
}

/// Has an out-port `seen` and an in-port `given` of a type.
class Carrier final : public Device {
public:
    Carrier(std::string name, const MessageType* type) : Device(std::move(name), "Part") {
        out_ports_.push_back(make_out_port(type, "seen", ""));
        in_ports_.push_back(make_in_port(type, "given", "", 10));
    }
    void sense(const Time& /*now*/) override {}
    void actuate(const Time& /*now*/) override {}
    OutPort<Value>& seen() { return static_cast<OutPort<Value>&>(*out_ports_.front()); }
    InPort<Value>& given() { return static_cast<InPort<Value>&>(*in_ports_.front()); }
};

}  // namespace nezumi::dds
