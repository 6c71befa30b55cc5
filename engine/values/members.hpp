// The members of a structure and their names, found by the compiler.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "engine/values/describe.hpp"

namespace nezumi::detail {

// References to the members of a structure, in order.
template <class T>
constexpr auto members_of(T& object) {
    constexpr std::size_t count = member_count<std::remove_const_t<T>>();
    static_assert(count <= 12, "structures that are described by names have at most twelve members");
// NOLINTBEGIN(cppcoreguidelines-macro-usage): a structured binding has no pack
#define NEZUMI_MEMBERS(number, ...)    \
    if constexpr (count == (number)) { \
        auto& [__VA_ARGS__] = object;  \
        return std::tie(__VA_ARGS__);  \
    }
    // NOLINTEND(cppcoreguidelines-macro-usage)
    if constexpr (count == 0) return std::tuple<>{};
    NEZUMI_MEMBERS(1, a)
    NEZUMI_MEMBERS(2, a, b)
    NEZUMI_MEMBERS(3, a, b, c)
    NEZUMI_MEMBERS(4, a, b, c, d)
    NEZUMI_MEMBERS(5, a, b, c, d, e)
    NEZUMI_MEMBERS(6, a, b, c, d, e, f)
    NEZUMI_MEMBERS(7, a, b, c, d, e, f, g)
    NEZUMI_MEMBERS(8, a, b, c, d, e, f, g, h)
    NEZUMI_MEMBERS(9, a, b, c, d, e, f, g, h, i)
    NEZUMI_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
    NEZUMI_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
    NEZUMI_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
#undef NEZUMI_MEMBERS
}

// A structure without storage: only the addresses of its members are used.
template <class T>
struct Nowhere {
    T value;
};
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wundefined-var-template"
#pragma clang diagnostic ignored "-Wundefined-internal"  // of structures in anonymous namespaces
#endif
template <class T>
extern const Nowhere<T> nowhere;

template <class M>
struct Member {
    const M* at;
};
template <class M>
constexpr Member<M> member_at(const M& member) {
    return {&member};
}

// The name of a member, from the function's name, which contains the following.
// g++: "... {(& nowhere<nezumi::Use>.nezumi::detail::Nowhere<nezumi::Use>::value.nezumi::Use::set)} ...";
// clang: "... {&nowhere.value.set}]".
template <auto member>
constexpr std::string_view text_of_member() {
    std::string_view text = __PRETTY_FUNCTION__;
    text = text.substr(0, text.find_last_of('}'));
    if (text.ends_with(')')) text.remove_suffix(1);
    return text.substr(text.find_last_of(".:") + 1);
}

/// The names of a structure's members, in order.
template <class T>
constexpr auto member_names() {
    return []<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<std::string_view, sizeof...(I)>{
            text_of_member<member_at(std::get<I>(members_of(nowhere<T>.value)))>()...};
    }
    (std::make_index_sequence<member_count<T>()>{});
}
#ifdef __clang__
#pragma clang diagnostic pop
#endif

}  // namespace nezumi::detail
