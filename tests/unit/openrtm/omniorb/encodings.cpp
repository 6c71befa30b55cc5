// Compares nezumi's CDR with omniORB's own encoder, in both byte orders: each built-in and each installed message type
// with random values, by type codes that are made of its fields. Prints a line for each that differs; exits 1 then.
#include <omniORB4/CORBA.h>

#include <span>
#include <stdexcept>
#include <string>

#include "engine/values/cdr.hpp"
#include "tests/unit/foreign_encoder.hpp"

using namespace nezumi;

namespace {

CORBA::TypeCode_ptr code_of(CORBA::ORB_ptr orb, const Type& type) {
    switch (type.kind) {
        case Type::Kind::boolean: return CORBA::TypeCode::_duplicate(CORBA::_tc_boolean);
        case Type::Kind::int8:  // CORBA has no such integer; it looks as an octet does
        case Type::Kind::uint8: return CORBA::TypeCode::_duplicate(CORBA::_tc_octet);
        case Type::Kind::int16: return CORBA::TypeCode::_duplicate(CORBA::_tc_short);
        case Type::Kind::int32: return CORBA::TypeCode::_duplicate(CORBA::_tc_long);
        case Type::Kind::int64: return CORBA::TypeCode::_duplicate(CORBA::_tc_longlong);
        case Type::Kind::uint16: return CORBA::TypeCode::_duplicate(CORBA::_tc_ushort);
        case Type::Kind::uint32: return CORBA::TypeCode::_duplicate(CORBA::_tc_ulong);
        case Type::Kind::uint64: return CORBA::TypeCode::_duplicate(CORBA::_tc_ulonglong);
        case Type::Kind::float32: return CORBA::TypeCode::_duplicate(CORBA::_tc_float);
        case Type::Kind::float64: return CORBA::TypeCode::_duplicate(CORBA::_tc_double);
        case Type::Kind::text: return orb->create_string_tc(0);
        case Type::Kind::octets: return orb->create_sequence_tc(0, CORBA::_tc_octet);
        case Type::Kind::array: {
            const CORBA::TypeCode_var element = code_of(orb, *type.element);
            return orb->create_array_tc(static_cast<CORBA::ULong>(type.length), element);
        }
        case Type::Kind::sequence: {
            const CORBA::TypeCode_var element = code_of(orb, *type.element);
            return orb->create_sequence_tc(0, element);
        }
        case Type::Kind::enumeration: {
            CORBA::EnumMemberSeq names;
            for (const auto& choice : type.choices) {
                names.length(names.length() + 1);
                names[names.length() - 1] = CORBA::string_dup(std::string(choice).c_str());
            }
            return orb->create_enum_tc("IDL:E:1.0", "E", names);
        }
        case Type::Kind::structure: {
            CORBA::StructMemberSeq members;
            for (const Type::Field& field : type.fields) {
                members.length(members.length() + 1);
                CORBA::StructMember& member = members[members.length() - 1];
                member.name = CORBA::string_dup(field.name.c_str());
                member.type = code_of(orb, *field.type);
            }
            return orb->create_struct_tc("IDL:S:1.0", "S", members);
        }
        default: throw std::runtime_error("no type of CORBA");
    }
}

void put(DynamicAny::DynAny_ptr out, const ValueView& value);

template <class Container>
void put_elements(Container& out, const ValueView& value) {
    for_each_element(value, [&](const ValueView& element) {
        const DynamicAny::DynAny_var current = out->current_component();
        put(current, element);
        out->next();
        return true;
    });
}

void put(DynamicAny::DynAny_ptr out, const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::boolean: return out->insert_boolean(value.as<bool>());
        case Type::Kind::int8: return out->insert_octet(static_cast<CORBA::Octet>(value.as<std::int8_t>()));
        case Type::Kind::uint8: return out->insert_octet(value.as<std::uint8_t>());
        case Type::Kind::int16: return out->insert_short(value.as<std::int16_t>());
        case Type::Kind::int32: return out->insert_long(value.as<std::int32_t>());
        case Type::Kind::int64: return out->insert_longlong(value.as<std::int64_t>());
        case Type::Kind::uint16: return out->insert_ushort(value.as<std::uint16_t>());
        case Type::Kind::uint32: return out->insert_ulong(value.as<std::uint32_t>());
        case Type::Kind::uint64: return out->insert_ulonglong(value.as<std::uint64_t>());
        case Type::Kind::float32: return out->insert_float(value.as<float>());
        case Type::Kind::float64: return out->insert_double(value.as<double>());
        case Type::Kind::text: return out->insert_string(value.as<std::string>().c_str());
        case Type::Kind::octets: {
            const auto sequence = DynamicAny::DynSequence::_narrow(out);
            const auto& octets = value.as<Octets>();
            sequence->set_length(static_cast<CORBA::ULong>(octets.size()));
            for (const std::uint8_t octet : octets) {
                const DynamicAny::DynAny_var current = sequence->current_component();
                current->insert_octet(octet);
                sequence->next();
            }
            return;
        }
        case Type::Kind::array: {
            const DynamicAny::DynArray_var array = DynamicAny::DynArray::_narrow(out);
            return put_elements(array, value);
        }
        case Type::Kind::sequence: {
            const DynamicAny::DynSequence_var sequence = DynamicAny::DynSequence::_narrow(out);
            sequence->set_length(static_cast<CORBA::ULong>(value.count()));
            return put_elements(sequence, value);
        }
        case Type::Kind::enumeration: {
            const DynamicAny::DynEnum_var choice = DynamicAny::DynEnum::_narrow(out);
            return choice->set_as_ulong(static_cast<CORBA::ULong>(value.choice()));
        }
        case Type::Kind::structure: {
            const DynamicAny::DynStruct_var structure = DynamicAny::DynStruct::_narrow(out);
            for (const Type::Field& field : value.type->fields) {
                const DynamicAny::DynAny_var current = structure->current_component();
                put(current, value.field(field));
                structure->next();
            }
            return;
        }
        default: throw std::runtime_error("no value of CORBA");
    }
}

class Encoder {
public:
    explicit Encoder(CORBA::ORB_ptr orb) : orb_(CORBA::ORB::_duplicate(orb)) {
        const CORBA::Object_var object = orb->resolve_initial_references("DynAnyFactory");
        factory_ = DynamicAny::DynAnyFactory::_narrow(object);
    }

    // A double stands before the value, so that the value begins where 8 bytes are aligned; then both are compared as
    // the end of an `any`.
    bool agrees(const Value& value, std::endian order) {
        CORBA::StructMemberSeq members;
        members.length(2);
        members[0].name = CORBA::string_dup("before");
        members[0].type = CORBA::TypeCode::_duplicate(CORBA::_tc_double);
        members[1].name = CORBA::string_dup("value");
        members[1].type = code_of(orb_, value.type());
        const CORBA::TypeCode_var code = orb_->create_struct_tc("IDL:W:1.0", "W", members);
        const DynamicAny::DynAny_var whole = factory_->create_dyn_any_from_type_code(code);
        const DynamicAny::DynStruct_var structure = DynamicAny::DynStruct::_narrow(whole);
        structure->next();
        const DynamicAny::DynAny_var inner = structure->current_component();
        put(inner, value);
        const CORBA::Any_var any = whole->to_any();
        cdrMemoryStream stream;
        stream.setByteSwapFlag(order == std::endian::little);
        any.in() >>= stream;
        Octets ours;
        write_cdr(ours, {.order = order}, value);
        const auto* theirs = static_cast<const std::uint8_t*>(stream.bufPtr());
        const std::size_t size = stream.bufSize();
        if (size <= ours.size()) return false;
        // omniORB leaves what it finds between values where it aligns them, so its bytes are read rather than compared.
        Value again(value.type());
        const std::span<const std::uint8_t> end(theirs + size - ours.size(), ours.size());
        return read_cdr(end, {.order = order}, again).has_value() && is_equal(again, value);
    }

private:
    CORBA::ORB_var orb_;
    DynamicAny::DynAnyFactory_var factory_;
};

// Texts of CORBA are of a code set: ASCII is in all of them.
void make_plain(const ValuePlace& value) {
    switch (value.type->kind) {
        case Type::Kind::text:
            for (char& c : value.as<std::string>()) c = static_cast<char>('a' + (static_cast<unsigned char>(c) % 26));
            return;
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) make_plain(value.field(field));
            return;
        case Type::Kind::array:
        case Type::Kind::sequence:
            return for_each_element(value, [](const ValuePlace& element) {
                make_plain(element);
                return true;
            });
        default: return;
    }
}

}  // namespace

int main() {
    int none = 0;
    const CORBA::ORB_var orb = CORBA::ORB_init(none, nullptr);
    Encoder encoder(orb);
    const auto agrees = [&](const Value& value, std::endian order) {
        try {
            return encoder.agrees(value, order);
        } catch (const CORBA::Exception& error) {
            throw std::runtime_error(error._name());
        }
    };
    return compare_shipped_types(agrees, [](Value& value) { make_plain(value); });
}
