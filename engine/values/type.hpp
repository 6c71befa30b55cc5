// Type descriptions at run time: one table for each type. Functions over values (CDR, JSON, a hash, ...) are ordinary
// functions over these tables, compiled once. The tables are made from the descriptions of structures, or from
// definitions in files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/values/describe.hpp"
#include "engine/values/members.hpp"

namespace nezumi {

class Value;
struct Rule;
struct MessageType;

/// The limits of a field in a message, in addition to its type. Bounds are inclusive.
struct FieldLimits {
    double min = -std::numeric_limits<double>::infinity();  ///< of a number, or of each number in it
    double max = std::numeric_limits<double>::infinity();
    std::size_t length = std::numeric_limits<std::size_t>::max();  ///< the most elements, or bytes of a text
    bool operator==(const FieldLimits&) const = default;
};

/// A function that is called with each element of a map and its name.
using EntryVisitor = std::function<void(const std::string& name, const void* element)>;

/// Raw bytes: one value, a string in Lua.
using Octets = std::vector<std::uint8_t>;

namespace detail {
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
}  // namespace detail

/// A sequence of elements (`Octets` counts as one value).
template <class T>
concept Sequence = detail::IsVector<T>::value && !std::is_same_v<T, Octets>;

/// The run-time description of a type. It exists once for each type, so equal types have equal addresses.
struct Type {
    enum class Kind : std::uint8_t {
        nothing,  ///< std::monostate
        boolean,
        int8,
        int16,
        int32,
        int64,
        uint8,
        uint16,
        uint32,
        uint64,
        float32,
        float64,
        enumeration,  ///< one of `choices`, by its index
        text,         ///< std::string
        octets,       ///< Octets
        structure,    ///< `fields`
        array,        ///< `length` elements of type `element`; the length is not stored in the value
        sequence,     ///< any number of elements of type `element`
        optional,     ///< one element of type `element`, or none
        map,          ///< any number of elements of type `element`, each with a name (`entries`)
        any,          ///< a `Value`, which contains its type
        other,        ///< a value without a description: known only by its address
    };

    struct Field {
        std::string name;
        std::size_t offset = 0;  ///< [bytes] from the structure's begin
        const Type* type = nullptr;
        std::string unit;  ///< "" for none
        std::string doc;
        Numbers numbers = Numbers::finite;
        /// The rule, for a table in a file (engine/ports/setting.hpp).
        const Rule* rule = nullptr;
        /// The limits, for a message defined by a file; null for none.
        std::shared_ptr<const FieldLimits> limits{};
        std::string lua_type{};  ///< if no member has the value (type `nothing`): the Lua type for editors
    };

    /// Access to the elements of a sequence or an optional in memory.
    struct Elements {
        std::size_t (*count)(const void* value) = nullptr;
        void (*resize)(const Type& type, void* value, std::size_t count) = nullptr;
        /// The address of the first element; the others follow it. Null if booleans are stored as single bits.
        const void* (*first)(const void* value) = nullptr;
        bool (*bit)(const void* value, std::size_t index) = nullptr;
        void (*set_bit)(void* value, std::size_t index, bool bit) = nullptr;
    };

    /// Access to the elements of a map in memory.
    struct Entries {
        void (*for_each)(const void* map, const EntryVisitor& visit) = nullptr;  ///< in the order of their names
        void* (*add)(void* map, const std::string& name) = nullptr;  ///< returns the new or the existing element
    };

    /// Constructs, copies and destroys a value in existing memory.
    struct Storage {
        void (*construct)(const Type& type, void* at) = nullptr;
        void (*copy)(const Type& type, void* at, const void* from) = nullptr;  ///< constructs a copy
        void (*assign)(const Type& type, void* to, const void* from) = nullptr;
        void (*destroy)(const Type& type, void* at) = nullptr;
    };

    Kind kind = Kind::other;
    std::string name{};                     ///< of a structure
    std::string doc{};                      ///< of a structure that a person writes as a table
    std::vector<std::string_view> kinds{};  ///< if such a structure has several kinds: their names
    std::size_t size = 0;                   ///< [bytes] in memory, without the allocated memory of texts and sequences
    std::size_t alignment = 1;              ///< [bytes]
    std::vector<Field> fields{};
    const Type* element = nullptr;
    std::size_t length = 0;
    Elements elements{};
    Entries entries{};
    std::vector<std::string> choices{};  ///< of an enumeration, in order
    Storage storage{};
    bool is_flat = false;  ///< the value can be copied byte by byte
    /// The default value, if `set_initial` has set one (for a type made at run time); otherwise null.
    std::shared_ptr<const Value> initial{};
    /// The message type with this payload, if a file defines it.
    const MessageType* message = nullptr;

    /// The element type of a sequence; otherwise the type itself.
    const Type& single() const { return kind == Kind::sequence ? *element : *this; }
    /// For an integer type: its smallest and largest value, at most the largest int64.
    std::pair<std::int64_t, std::int64_t> integer_range() const;
    bool is_number() const { return kind >= Kind::int8 && kind <= Kind::float64; }
    bool is_integer() const { return kind >= Kind::int8 && kind <= Kind::uint64; }
    bool is_floating() const { return kind == Kind::float32 || kind == Kind::float64; }
    /// A number, boolean, choice or nothing: a few bytes without allocated memory.
    bool is_scalar() const { return kind < Kind::text; }
    /// Whether the type has no parts.
    bool is_single() const { return kind < Kind::structure; }
};

/// The description of T, made on first use.
template <class T>
const Type& type_of();

namespace detail {

template <class T>
constexpr Type::Kind kind_of() {
    if constexpr (Described<T> || described_by_names<T>) return Type::Kind::structure;
    if constexpr (IsArray<T>::value) return Type::Kind::array;
    if constexpr (Sequence<T>) return Type::Kind::sequence;
    if constexpr (IsOptional<T>::value) return Type::Kind::optional;
    if constexpr (std::is_same_v<T, Value>) return Type::Kind::any;
    if constexpr (std::is_same_v<T, std::monostate>) return Type::Kind::nothing;
    if constexpr (std::is_same_v<T, bool>) return Type::Kind::boolean;
    if constexpr (std::is_same_v<T, std::int8_t>) return Type::Kind::int8;
    if constexpr (std::is_same_v<T, std::int16_t>) return Type::Kind::int16;
    if constexpr (std::is_same_v<T, std::int32_t>) return Type::Kind::int32;
    if constexpr (std::is_same_v<T, std::int64_t>) return Type::Kind::int64;
    if constexpr (std::is_same_v<T, std::uint8_t>) return Type::Kind::uint8;
    if constexpr (std::is_same_v<T, std::uint16_t>) return Type::Kind::uint16;
    if constexpr (std::is_same_v<T, std::uint32_t>) return Type::Kind::uint32;
    if constexpr (std::is_same_v<T, std::uint64_t>) return Type::Kind::uint64;
    if constexpr (std::is_same_v<T, float>) return Type::Kind::float32;
    if constexpr (std::is_same_v<T, double>) return Type::Kind::float64;
    if constexpr (std::is_same_v<T, std::string>) return Type::Kind::text;
    if constexpr (std::is_same_v<T, Octets>) return Type::Kind::octets;
    return Type::Kind::other;
}

template <class T>
constexpr bool is_scalar() {
    return kind_of<T>() < Type::Kind::text;
}

template <class T>
Type::Elements elements_of() {
    Type::Elements made;
    made.count = [](const void* value) -> std::size_t {
        if constexpr (IsOptional<T>::value) {
            return static_cast<const T*>(value)->has_value() ? 1 : 0;
        } else {
            return static_cast<const T*>(value)->size();
        }
    };
    made.resize = [](const Type&, void* value, std::size_t count) {
        T& all = *static_cast<T*>(value);
        if constexpr (IsOptional<T>::value) {
            count == 0 ? all.reset() : static_cast<void>(all.emplace());
        } else {
            all.resize(count);
        }
    };
    if constexpr (std::is_same_v<T, std::vector<bool>>) {
        made.bit = [](const void* value, std::size_t index) -> bool { return (*static_cast<const T*>(value))[index]; };
        made.set_bit = [](void* value, std::size_t index, bool bit) { (*static_cast<T*>(value))[index] = bit; };
    } else {
        made.first = [](const void* value) -> const void* {
            const T& all = *static_cast<const T*>(value);
            if constexpr (IsOptional<T>::value) {
                return all ? &*all : nullptr;
            } else {
                return all.data();
            }
        };
    }
    return made;
}

// The data from which `add_fields` makes a field. Only this small part depends on the C++ type, so it compiles fast.
struct FieldSeed {
    std::string_view name;
    std::size_t offset;
    const Type& (*type)();
    std::string_view unit;
    std::string_view doc;
    Numbers numbers;
};
void add_fields(Type& type, std::span<const FieldSeed> fields);

template <class Member>
constexpr Numbers numbers_of(const Member& field) {
    if constexpr (requires { field.numbers; }) return field.numbers;
    return Numbers::finite;
}

// The offset of a member in its structure [bytes].
inline std::size_t place_in(const auto& structure, const auto& member) {
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&member) -
                                    reinterpret_cast<const std::byte*>(&structure));
}

template <class T>
Type::Storage storage_of() {
    return {
        .construct = [](const Type&, void* at) { new (at) T{}; },
        .copy = [](const Type&, void* at, const void* from) { new (at) T(*static_cast<const T*>(from)); },
        .assign = [](const Type&, void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); },
        .destroy = [](const Type&, void* at) { static_cast<T*>(at)->~T(); }};
}

// A table with only the memory layout of T.
template <class T>
Type table_for() {
    return {.size = sizeof(T),
            .alignment = alignof(T),
            .storage = storage_of<T>(),
            .is_flat = std::is_trivially_copyable_v<T>};
}

template <class T>
Type make_type() {
    Type type = table_for<T>();
    type.kind = kind_of<T>();
    if constexpr (Described<T>) {
        type.name = Describe<T>::name;
        const T sample{};
        check_fields<T>();
        T::fields.apply([&]<class... M>(const Field<T, M>&... field) {
            add_fields(type, std::array<FieldSeed, sizeof...(M)>{
                                 FieldSeed{field.name, place_in(sample, sample.*(field.member)), type_of<M>, field.unit,
                                           field.doc, numbers_of(field)}...});
        });
    } else if constexpr (described_by_names<T>) {
        type.name = Describe<T>::name;
        const T sample{};
        std::apply(
            [&]<class... M>(const M&... member) {
                [[maybe_unused]] std::size_t next = 0;
                add_fields(type, std::array<FieldSeed, sizeof...(M)>{FieldSeed{member_names<T>()[next++],
                                                                               place_in(sample, member), type_of<M>, "",
                                                                               "", Numbers::finite}...});
            },
            members_of(sample));
    } else if constexpr (IsArray<T>::value) {
        type.element = &type_of<typename T::value_type>();
        type.length = std::tuple_size_v<T>;
    } else if constexpr (Sequence<T> || IsOptional<T>::value) {
        type.element = &type_of<typename T::value_type>();
        type.elements = elements_of<T>();
    }
    return type;
}

}  // namespace detail

/// A value with a run-time description. `Value` itself is excluded: its type is that of its content.
template <class T>
concept Tabled = detail::kind_of<T>()
< Type::Kind::any;

template <class T>
const Type& type_of() {
    static const Type type = detail::make_type<T>();
    return type;
}

}  // namespace nezumi
