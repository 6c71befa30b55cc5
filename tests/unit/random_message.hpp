// Random definitions of messages, and random values of any type.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/messages/definition.hpp"
#include "engine/values/value.hpp"
#include "engine/values/view.hpp"

namespace nezumi {

class RandomMessages {
public:
    explicit RandomMessages(unsigned seed) : engine_(seed) {}

    std::size_t below(std::size_t most) { return engine_() % most; }

    MessageDefinition definition(const std::string& name) {
        MessageDefinition made{.name = name, .place = {name + ".msg"}};
        made.ros = fmt::format("{}/msg/{}", name.substr(0, name.find('/')), name.substr(name.find('/') + 1));
        const std::size_t count = 1 + below(6);
        for (std::size_t i = 0; i < count; ++i) {
            FieldDefinition field{.name = fmt::format("f{}", i), .numbers = Numbers::any};
            field.place = {made.place.file, static_cast<int>(i + 1)};
            constexpr std::array kinds{"boolean",  "octet",  "int8",    "short",     "long",
                                       "longlong", "ushort", "ulong",   "ulonglong", "float",
                                       "double",   "string", "Point2D", "Pose3D",    "SeenMarker"};
            field.kind = kinds[below(kinds.size())];
            if (below(3) == 0) field.shape.push_back(below(2) == 0 ? 0 : 1 + below(5));
            made.fields.push_back(std::move(field));
        }
        return made;
    }

    void fill(const ValuePlace& value) {
        switch (value.type->kind) {
            case Type::Kind::structure:
                for (const Type::Field& field : value.type->fields) fill(value.field(field));
                return;
            case Type::Kind::sequence: value.resize(below(5)); [[fallthrough]];
            case Type::Kind::array:
                return for_each_element(value, [&](const ValuePlace& element) {
                    fill(element);
                    return true;
                });
            case Type::Kind::enumeration: return value.set_choice(below(value.type->choices.size()));
            case Type::Kind::octets: value.as<Octets>().assign(below(5), static_cast<std::uint8_t>(engine_())); return;
            case Type::Kind::text:
                value.as<std::string>() = std::string(below(5), static_cast<char>(1 + below(255)));
                return;
            case Type::Kind::boolean: value.as<bool>() = below(2) == 1; return;
            default:
                return visit_number(value, [&]<class T>(T& number) {
                    if constexpr (std::is_floating_point_v<T>) {
                        number = below(20) == 0 ? std::numeric_limits<T>::infinity()
                                                : static_cast<T>(static_cast<std::int64_t>(engine_())) / 1024;
                    } else {
                        number = static_cast<T>(engine_());
                    }
                });
        }
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace nezumi
