// References to values of any type, for functions over values.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "engine/values/type.hpp"

namespace nezumi {

/// A read-only reference to a value of any type. The value must outlive the reference.
struct ValueView {
    const Type* type;
    const void* at;

    ValueView(const Type& its_type, const void* place) : type(&its_type), at(place) {}
    // NOLINTNEXTLINE(google-explicit-constructor): functions that visit values take any type
    template <Tabled T>
    ValueView(const T& value) : type(&type_of<T>()), at(&value) {}

    /// The value as a T, which must be its type.
    template <class T>
    const T& as() const {
        return *static_cast<const T*>(at);
    }
    /// The value of one field.
    ValueView field(const Type::Field& field) const {
        return {*field.type, static_cast<const std::byte*>(at) + field.offset};
    }
    /// For an enumeration: the index of the choice.
    std::size_t choice() const {
        static_assert(std::endian::native == std::endian::little);
        std::size_t place = 0;
        std::memcpy(&place, at, type->size);
        return place;
    }
    /// For an array, a sequence or an optional: the number of elements.
    std::size_t count() const { return type->elements.count != nullptr ? type->elements.count(at) : type->length; }
    /// The address of the first element; the others follow it. Null if booleans are stored as single bits.
    const void* first() const {
        if (type->kind == Type::Kind::array) return at;
        return type->elements.first != nullptr ? type->elements.first(at) : nullptr;
    }
};

/// A reference to a value that may be changed.
struct ValuePlace {
    const Type* type;
    void* at;

    ValuePlace(const Type& its_type, void* place) : type(&its_type), at(place) {}
    // NOLINTNEXTLINE(google-explicit-constructor): a reader takes any value
    template <Tabled T>
    ValuePlace(T& value) : type(&type_of<T>()), at(&value) {}

    ValueView view() const { return {*type, at}; }
    template <class T>
    T& as() const {
        return *static_cast<T*>(at);
    }
    /// Sets the choice of an enumeration.
    void set_choice(std::size_t place) const { std::memcpy(at, &place, type->size); }
    ValuePlace field(const Type::Field& field) const {
        return {*field.type, static_cast<std::byte*>(at) + field.offset};
    }
    std::size_t count() const { return view().count(); }
    void* first() const { return const_cast<void*>(view().first()); }
    /// Sets the value to the default of its type.
    void reset() const;
    /// For a sequence or an optional: sets the number of elements.
    void resize(std::size_t count) const { type->elements.resize(*type, at, count); }
};

/// Calls `visit(element)` for the element with this index, from 0.
template <class Visit>
decltype(auto) with_element(const ValueView& all, std::size_t index, const Visit& visit) {
    const Type& type = *all.type->element;
    if (all.type->elements.bit != nullptr) {
        const bool bit = all.type->elements.bit(all.at, index);
        return visit(ValueView(type, &bit));
    }
    return visit(ValueView(type, static_cast<const std::byte*>(all.first()) + index * type.size));
}

/// Calls `visit(element)` for each element of an array, a sequence or an optional, in order, until it returns false.
template <class Visit>
void for_each_element(const ValueView& all, const Visit& visit) {
    const std::size_t count = all.count();
    const Type& type = *all.type->element;
    const auto* at = static_cast<const std::byte*>(all.first());
    for (std::size_t i = 0; i < count; ++i) {
        const bool goes_on = at == nullptr ? with_element(all, i, visit) : visit(ValueView(type, at + i * type.size));
        if (!goes_on) return;
    }
}
/// The same for elements that `visit` may change.
template <class Visit>
void for_each_element(const ValuePlace& all, const Visit& visit) {
    const std::size_t count = all.count();
    const Type& type = *all.type->element;
    auto* at = static_cast<std::byte*>(all.first());
    for (std::size_t i = 0; i < count; ++i) {
        bool goes_on = true;
        if (all.type->elements.bit != nullptr) {
            bool bit = all.type->elements.bit(all.at, i);
            goes_on = visit(ValuePlace(type, &bit));
            all.type->elements.set_bit(all.at, i, bit);
        } else {
            goes_on = visit(ValuePlace(type, at + i * type.size));
        }
        if (!goes_on) return;
    }
}

/// Calls `visit(name, element)` for each element of a map, in the order of their names.
template <class Visit>
void for_each_entry(const ValueView& map, const Visit& visit) {
    map.type->entries.for_each(map.at, [&](const std::string& name, const void* element) {
        visit(name, ValueView(*map.type->element, element));
    });
}

/// Calls `visit(number)` with the boolean or number to which `value` refers; `Any` is `ValueView` or `ValuePlace`.
template <class Any, class Visit>
decltype(auto) visit_number(const Any& value, const Visit& visit) {
    switch (value.type->kind) {
        case Type::Kind::boolean: return visit(value.template as<bool>());
        case Type::Kind::int8: return visit(value.template as<std::int8_t>());
        case Type::Kind::int16: return visit(value.template as<std::int16_t>());
        case Type::Kind::int32: return visit(value.template as<std::int32_t>());
        case Type::Kind::int64: return visit(value.template as<std::int64_t>());
        case Type::Kind::uint8: return visit(value.template as<std::uint8_t>());
        case Type::Kind::uint16: return visit(value.template as<std::uint16_t>());
        case Type::Kind::uint32: return visit(value.template as<std::uint32_t>());
        case Type::Kind::uint64: return visit(value.template as<std::uint64_t>());
        case Type::Kind::float32: return visit(value.template as<float>());
        default: assert(value.type->kind == Type::Kind::float64); return visit(value.template as<double>());
    }
}

}  // namespace nezumi
