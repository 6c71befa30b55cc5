// Walks over the descriptions of the message types.
#include "bindings/lua/stubs/message_shape.hpp"

#include <limits>
#include <tuple>
#include <type_traits>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

template <class T>
ValueShape shape_of() {
    ValueShape shape;
    if constexpr (Described<T>) {
        shape.kind = ValueShape::Kind::structure;
        shape.name = Describe<T>::name;
        const T sample{};
        for_each_field(sample, [&](const auto& field, const auto& member) {
            shape.fields.push_back(
                {field.name, field.unit, field.doc, shape_of<std::remove_cvref_t<decltype(member)>>()});
        });
    } else if constexpr (Sequence<T>) {
        shape = shape_of<typename T::value_type>();
        shape.sequence = true;
    } else if constexpr (std::is_same_v<T, bool>) {
        shape.kind = ValueShape::Kind::boolean;
    } else if constexpr (std::is_integral_v<T>) {
        shape.kind = ValueShape::Kind::integer;
        shape.min = std::numeric_limits<T>::min();
        shape.max = std::numeric_limits<T>::max();
    } else if constexpr (std::is_floating_point_v<T>) {
        shape.kind = ValueShape::Kind::number;
        shape.limit = static_cast<double>(std::numeric_limits<T>::max());
    } else {
        shape.kind = std::is_same_v<T, Octets> ? ValueShape::Kind::octets : ValueShape::Kind::text;
    }
    return shape;
}

template <class T>
MessageShape message_of(const MessageType<T>& type) {
    return {type.name, type.doc, shape_of<T>()};
}

}  // namespace

std::vector<MessageShape> message_shapes() {
    return std::apply([](const auto&... type) { return std::vector<MessageShape>{message_of(type)...}; },
                      message_types);
}

}  // namespace nezumi
