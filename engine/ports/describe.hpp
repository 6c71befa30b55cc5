// How a structure describes itself, once, at compile time: fields with their units and what they mean.
#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace nezumi {

/// One field of a structure: its name as scripts and files see it, where it is, its unit ("" for none) and its meaning.
template <class S, class T>
struct Field {
    std::string_view name;
    T S::*member;
    std::string_view unit;
    std::string_view doc;
};
template <class S, class T>
Field(const char*, T S::*, const char*, const char*) -> Field<S, T>;

/// What a structure that crosses a port says of itself: `name`, and a tuple `fields` that lists every member in order.
/// The structure has them as its own `type_name` and `fields`, or, where its header should not know how files spell it,
/// this template is specialised for it.
template <class T>
struct Describe;

template <class T>
requires requires { T::fields; }
struct Describe<T> {
    static constexpr std::string_view name = T::type_name;
    static constexpr const auto& fields = T::fields;
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

/// A structure that has a `Describe`.
template <class T>
concept Described = requires {
    Describe<T>::fields;
};

/// Calls `visit(field, value)` for every field of `object`, in order. A member that `Describe<T>` forgets does not
/// compile.
template <Described T, class Visit>
constexpr void for_each_field(T&& object, Visit&& visit) = delete;

template <class T, class Visit>
requires Described<std::remove_const_t<T>>
constexpr void for_each_field(T& object, Visit&& visit) {
    using Plain = std::remove_const_t<T>;
    static_assert(
        detail::member_count<Plain>() == std::tuple_size_v<std::remove_cvref_t<decltype(Describe<Plain>::fields)>>,
        "Describe<T>::fields must list every member of T");
    std::apply([&](const auto&... field) { (visit(field, object.*(field.member)), ...); }, Describe<Plain>::fields);
}

}  // namespace nezumi
