// Compares nezumi's CDR with Fast DDS's own encoder, in both byte orders and both directions: each built-in and each
// installed message type with random values, by dynamic types that are made of its fields. Prints a line for each that
// differs; exits 1 then.
#include <fastcdr/Cdr.h>
#include <fastrtps/types/DynamicData.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicTypeBuilder.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/types/DynamicTypePtr.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/values/cdr.hpp"
#include "tests/unit/foreign_encoder.hpp"

using namespace nezumi;
namespace fast = eprosima::fastrtps::types;

namespace {

constexpr std::uint32_t most = 100'000;

// Its functions for encoding are those of its publishers.
struct OpenData : fast::DynamicData {
    using DynamicData::deserialize;
    using DynamicData::serialize;
};

void need(fast::ReturnCode_t code) {
    if (code != fast::ReturnCode_t::RETCODE_OK) throw std::runtime_error("Fast DDS refuses a value");
}

fast::DynamicType_ptr type_like(const Type& type) {
    auto& factory = *fast::DynamicTypeBuilderFactory::get_instance();
    switch (type.kind) {
        case Type::Kind::boolean: return factory.create_bool_type();
        case Type::Kind::int8:  // it has no such integer; it looks as an octet does
        case Type::Kind::uint8: return factory.create_byte_type();
        case Type::Kind::int16: return factory.create_int16_type();
        case Type::Kind::int32: return factory.create_int32_type();
        case Type::Kind::int64: return factory.create_int64_type();
        case Type::Kind::uint16: return factory.create_uint16_type();
        case Type::Kind::uint32: return factory.create_uint32_type();
        case Type::Kind::uint64: return factory.create_uint64_type();
        case Type::Kind::float32: return factory.create_float32_type();
        case Type::Kind::float64: return factory.create_float64_type();
        case Type::Kind::text: return factory.create_string_type(most);
        case Type::Kind::octets: return factory.create_sequence_builder(factory.create_byte_type(), most)->build();
        case Type::Kind::sequence: return factory.create_sequence_builder(type_like(*type.element), most)->build();
        case Type::Kind::array:
            return factory.create_array_builder(type_like(*type.element), {static_cast<std::uint32_t>(type.length)})
                ->build();
        case Type::Kind::enumeration: {
            fast::DynamicTypeBuilder* builder = factory.create_enum_builder();
            builder->set_name("E");
            std::uint32_t index = 0;
            for (const auto& choice : type.choices) need(builder->add_empty_member(index++, std::string(choice)));
            return builder->build();
        }
        case Type::Kind::structure: {
            fast::DynamicTypeBuilder* builder = factory.create_struct_builder();
            builder->set_name("S");
            fast::MemberId id = 0;
            for (const Type::Field& field : type.fields)
                need(builder->add_member(id++, std::string(field.name), type_like(*field.type)));
            return builder->build();
        }
        default: throw std::runtime_error("no type of Fast DDS");
    }
}

void put(fast::DynamicData& out, fast::MemberId id, const ValueView& value);

// A part that has parts itself is lent.
template <class Work>
void with_part(fast::DynamicData& out, fast::MemberId id, const Work& work) {
    fast::DynamicData* part = out.loan_value(id);
    if (part == nullptr) throw std::runtime_error("Fast DDS has no such part");
    work(*part);
    need(out.return_loaned_value(part));
}

void put_sequence(fast::DynamicData& out, const ValueView& value) {
    for_each_element(value, [&](const ValueView& element) {
        fast::MemberId id = 0;
        need(out.insert_sequence_data(id));
        put(out, id, element);
        return true;
    });
}

void put(fast::DynamicData& out, fast::MemberId id, const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::boolean: return need(out.set_bool_value(value.as<bool>(), id));
        case Type::Kind::int8:
            return need(out.set_byte_value(static_cast<eprosima::fastrtps::rtps::octet>(value.as<std::int8_t>()), id));
        case Type::Kind::uint8: return need(out.set_byte_value(value.as<std::uint8_t>(), id));
        case Type::Kind::int16: return need(out.set_int16_value(value.as<std::int16_t>(), id));
        case Type::Kind::int32: return need(out.set_int32_value(value.as<std::int32_t>(), id));
        case Type::Kind::int64: return need(out.set_int64_value(value.as<std::int64_t>(), id));
        case Type::Kind::uint16: return need(out.set_uint16_value(value.as<std::uint16_t>(), id));
        case Type::Kind::uint32: return need(out.set_uint32_value(value.as<std::uint32_t>(), id));
        case Type::Kind::uint64: return need(out.set_uint64_value(value.as<std::uint64_t>(), id));
        case Type::Kind::float32: return need(out.set_float32_value(value.as<float>(), id));
        case Type::Kind::float64: return need(out.set_float64_value(value.as<double>(), id));
        case Type::Kind::text: return need(out.set_string_value(value.as<std::string>(), id));
        case Type::Kind::enumeration: return need(out.set_enum_value(static_cast<std::uint32_t>(value.choice()), id));
        case Type::Kind::octets:
            return with_part(out, id, [&](fast::DynamicData& part) {
                for (const std::uint8_t octet : value.as<Octets>()) {
                    fast::MemberId at = 0;
                    need(part.insert_sequence_data(at));
                    need(part.set_byte_value(octet, at));
                }
            });
        case Type::Kind::sequence:
            return with_part(out, id, [&](fast::DynamicData& part) { put_sequence(part, value); });
        case Type::Kind::array:
            return with_part(out, id, [&](fast::DynamicData& part) {
                fast::MemberId at = 0;
                for_each_element(value, [&](const ValueView& element) {
                    put(part, at++, element);
                    return true;
                });
            });
        case Type::Kind::structure:
            return with_part(out, id, [&](fast::DynamicData& part) {
                fast::MemberId at = 0;
                for (const Type::Field& field : value.type->fields) put(part, at++, value.field(field));
            });
        default: throw std::runtime_error("no value of Fast DDS");
    }
}

struct Ended {
    void operator()(fast::DynamicData* data) const { fast::DynamicDataFactory::get_instance()->delete_data(data); }
};
using Data = std::unique_ptr<fast::DynamicData, Ended>;

// The value is the one member of a structure.
bool agrees(const Value& value, std::endian order) {
    auto& factory = *fast::DynamicTypeBuilderFactory::get_instance();
    fast::DynamicTypeBuilder* builder = factory.create_struct_builder();
    builder->set_name("W");
    need(builder->add_member(0, "value", type_like(value.type())));
    const fast::DynamicType_ptr type = builder->build();
    const Data data(fast::DynamicDataFactory::get_instance()->create_data(type));
    put(*data, 0, value);

    using eprosima::fastcdr::Cdr;
    const auto endianness = order == std::endian::big ? Cdr::BIG_ENDIANNESS : Cdr::LITTLE_ENDIANNESS;
    std::vector<char> theirs(std::size_t{1} << 20, '\0');
    eprosima::fastcdr::FastBuffer buffer(theirs.data(), theirs.size());
    Cdr writer(buffer, endianness, Cdr::DDS_CDR);
    (data.get()->*&OpenData::serialize)(writer);
    theirs.resize(writer.getSerializedDataLength());
    Octets ours;
    write_cdr(ours, {.order = order}, value);
    if (!std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                    [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }))
        return false;

    std::vector<char> given(ours.begin(), ours.end());
    eprosima::fastcdr::FastBuffer source(given.data(), given.size());
    Cdr reader(source, endianness, Cdr::DDS_CDR);
    const Data again(fast::DynamicDataFactory::get_instance()->create_data(type));
    return (again.get()->*&OpenData::deserialize)(reader) && again->equals(data.get());
}

}  // namespace

int main() {
    return compare_shipped_types(agrees, [](Value& /*value*/) {});
}
