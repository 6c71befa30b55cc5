// Descriptions of structures at compile time: their fields with units and meanings.
#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace nezumi {

/// The allowed numbers of a field in a message.
enum class Numbers {
    finite,
    any,  ///< infinity and NaN are allowed and mean something
};

/// One field of a structure: its name in scripts and files, its member, its unit ("" for none) and its meaning.
template <class S, class T>
struct Field {
    std::string_view name;
    T S::*member;
    std::string_view unit;
    std::string_view doc;
    Numbers numbers = Numbers::finite;
};
template <class S, class T>
Field(const char*, T S::*, const char*, const char*, Numbers = Numbers::finite) -> Field<S, T>;

namespace detail {
template <std::size_t, class Each>
struct FieldAt {
    Each field;
};
template <class Places, class... Each>
struct NumberedFields;
template <std::size_t... I, class... Each>
struct NumberedFields<std::index_sequence<I...>, Each...> : FieldAt<I, Each>... {
    constexpr explicit NumberedFields(const Each&... each) : FieldAt<I, Each>{each}... {}
    template <class Use>
    constexpr decltype(auto) apply(Use&& use) const {
        return use(FieldAt<I, Each>::field...);
    }
};
}  // namespace detail

/// The fields of a structure, in order; `apply(use)` returns use(field, field, ...). A `std::tuple` would take longer
/// to compile, because its constructors check the conversions of each field.
template <class... Each>
struct FieldList : detail::NumberedFields<std::index_sequence_for<Each...>, Each...> {
    constexpr explicit FieldList(const Each&... each)
        : detail::NumberedFields<std::index_sequence_for<Each...>, Each...>(each...) {}
    static constexpr std::size_t count = sizeof...(Each);
};

/// The description of a structure: its name and its fields. The fields are the static member `fields` of the structure,
/// a `FieldList` of every member in order. The name is the static member `type_name`, or else the C++ name. For
/// structures that files write as tables, `Describe` is specialised beside the rules of the fields
/// (engine/ports/setting.hpp).
template <class T>
struct Describe;

/// A structure that describes itself.
template <class T>
concept Described = requires {
    T::fields.count;
};

/// A type with a static member `type_name`.
template <class T>
concept Named = requires {
    { T::type_name } -> std::convertible_to<std::string_view>;
};

/// Whether a structure is described only by the names of its members: it has a `type_name` and no `fields`, or this
/// variable is specialised for it.
template <class T>
inline constexpr bool described_by_names = Named<T> && !Described<T>;

namespace detail {
template <class T, class Variant>
inline constexpr bool is_alternative = false;
template <class T, class... Each>
inline constexpr bool is_alternative<T, std::variant<Each...>> = (std::is_same_v<T, Each> || ...);
}  // namespace detail
/// One of a variant's types.
template <class T, class Variant>
concept is_alternative = detail::is_alternative<T, Variant>;

namespace detail {

// "Velocity2D": the C++ name of T, without namespaces.
template <class T>
constexpr std::string_view own_name() {
    std::string_view name =
        __PRETTY_FUNCTION__;  // "... [with T = nezumi::Velocity2D; ...]", "... [T = nezumi::Velocity2D]"
    name.remove_prefix(name.find("T = ") + 4);
    name = name.substr(0, name.find_first_of(";]"));
    return name.substr(name.rfind(':') + 1);
}

template <class T>
constexpr std::string_view name_of_type() {
    if constexpr (Named<T>) {
        return T::type_name;
    } else {
        return own_name<T>();
    }
}

}  // namespace detail

template <Described T>
struct Describe<T> {
    static constexpr std::string_view name = detail::name_of_type<T>();
    static constexpr const auto& fields = T::fields;
};
template <class T>
requires described_by_names<T>
struct Describe<T> {
    static constexpr std::string_view name = detail::name_of_type<T>();
};

namespace detail {

struct AnyValue {
    template <class T>
    operator T() const;  // never defined: only asks whether an aggregate takes one more initialiser
};

template <std::size_t>
using AnyValueAt = AnyValue;

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires { T{AnyValueAt<I>{}...}; };
}

template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
    if constexpr (takes<T>(std::make_index_sequence<N + 1>{})) {
        return member_count<T, N + 1>();
    } else {
        return N;
    }
}

}  // namespace detail

namespace detail {
template <Described T>
constexpr void check_fields() {
    static_assert(member_count<T>() == T::fields.count, "T::fields must list every member of T");
}
}  // namespace detail

/// Calls `visit(field, value)` for every field of `object`, in order. Does not compile if `fields` omits a member.
template <Described T, class Visit>
constexpr void for_each_field(T&& object, Visit&& visit) = delete;

template <class T, class Visit>
requires Described<std::remove_const_t<T>>
constexpr void for_each_field(T& object, Visit&& visit) {
    using Plain = std::remove_const_t<T>;
    detail::check_fields<Plain>();
    Plain::fields.apply([&](const auto&... field) { (visit(field, object.*(field.member)), ...); });
}

}  // namespace nezumi
