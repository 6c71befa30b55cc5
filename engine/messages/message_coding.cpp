// The stamp is two numbers of 32 bits, as OpenRTM has it and as hosts exchange it.
#include "engine/messages/message_coding.hpp"

#include <bit>
#include <utility>

#include "engine/messages/msg_text.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/limits.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

constexpr CdrFormat little_endian{.order = std::endian::little, .header = true};

// The message that was read. An error if reading failed, or if ports don't allow the value (its numbers or lengths).
Expected<AnyMessage> checked(Expected<void> read, Value value, double tm) {
    if (!read) return Unexpected(read.error());
    if (!is_finite(value)) return failure("a number is not finite");
    if (const std::string wrong = find_misfit(ValueView(value)); !wrong.empty()) return failure(wrong);
    return AnyMessage{std::move(value), tm};
}

}  // namespace

MessageCoding own_coding(const MessageType& type) {
    // A structure of the stamp and the payload, for the definition.
    Type message;
    message.kind = Type::Kind::structure;
    message.name = type.name;
    message.fields.push_back({.name = "tm", .type = &type_of<CdrTime>()});
    message.fields.push_back({.name = "data", .type = type.payload});
    return {.type = full_ros_name(message),
            .definition = msg_text(message),
            .write = [](Octets& out, const ValueView& payload,
                        double tm) { write_cdr_message(out, payload, tm, little_endian); },
            .read = [payload = type.payload](std::span<const std::uint8_t> bytes, double tm) -> Expected<AnyMessage> {
                Value value(*payload);
                Expected<void> read = read_cdr_message(bytes, ValuePlace(value), tm, little_endian);
                return checked(std::move(read), std::move(value), tm);
            }};
}

MessageCoding coding_of_structure(const Type& type) {
    return {
        .type = full_ros_name(type),
        .definition = msg_text(type),
        .write = [](Octets& out, const ValueView& payload, double /*tm*/) { write_cdr(out, little_endian, payload); },
        .read = [&type](std::span<const std::uint8_t> bytes, double tm) -> Expected<AnyMessage> {
            Value value(type);
            Expected<void> read = read_cdr(bytes, little_endian, ValuePlace(value));
            return checked(std::move(read), std::move(value), tm);
        }};
}

}  // namespace nezumi
