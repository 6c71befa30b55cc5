// What ROS 2 calls a message type: its name in DDS, and the hash of its definition, both from its description.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/ports/cdr.hpp"
#include "engine/ports/describe.hpp"

namespace nezumi::ros {

namespace detail {

/// `type_id` of type_description_interfaces/msg/FieldType; an array's is 48 more, an unbounded sequence's 144.
template <class T>
constexpr int field_type() {
    if constexpr (Described<T>) return 1;
    if constexpr (std::is_same_v<T, std::int8_t>) return 2;
    if constexpr (std::is_same_v<T, std::uint8_t>) return 3;
    if constexpr (std::is_same_v<T, std::int16_t>) return 4;
    if constexpr (std::is_same_v<T, std::uint16_t>) return 5;
    if constexpr (std::is_same_v<T, std::int32_t>) return 6;
    if constexpr (std::is_same_v<T, std::uint32_t>) return 7;
    if constexpr (std::is_same_v<T, std::int64_t>) return 8;
    if constexpr (std::is_same_v<T, std::uint64_t>) return 9;
    if constexpr (std::is_same_v<T, float>) return 10;
    if constexpr (std::is_same_v<T, double>) return 11;
    if constexpr (std::is_same_v<T, bool>) return 15;
    if constexpr (std::is_same_v<T, std::string>) return 17;
}

template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::true_type {};

std::string field_text(std::string_view name, int type, std::size_t capacity, std::string_view nested);

/// The description of T as JSON, and of all that it is made of, by name.
template <class T>
void describe_type(std::map<std::string, std::string, std::less<>>& all);

/// One field; what it is made of goes to `all`.
template <class M>
std::string describe_field(std::string_view name, std::map<std::string, std::string, std::less<>>& all) {
    if constexpr (nezumi::detail::IsArray<M>::value || IsSequence<M>::value) {
        using Element = typename M::value_type;
        std::size_t capacity = 0;
        int kind = 144;
        if constexpr (nezumi::detail::IsArray<M>::value) {
            capacity = std::tuple_size_v<M>;
            kind = 48;
        }
        std::string_view nested;
        if constexpr (Described<Element>) {
            describe_type<Element>(all);
            nested = Describe<Element>::name;
        }
        return field_text(name, field_type<Element>() + kind, capacity, nested);
    } else {
        std::string_view nested;
        if constexpr (Described<M>) {
            describe_type<M>(all);
            nested = Describe<M>::name;
        }
        return field_text(name, field_type<M>(), 0, nested);
    }
}

template <class T>
void describe_type(std::map<std::string, std::string, std::less<>>& all) {
    if (all.contains(Describe<T>::name)) return;
    std::string fields;
    std::apply(
        [&]<class... M>(const Field<T, M>&... field) {
            ((fields += (fields.empty() ? "" : ", ") + describe_field<M>(field.name, all)), ...);
        },
        Describe<T>::fields);
    all.emplace(Describe<T>::name, fields);
}

/// "RIHS01_" and the hash.
std::string hash_of_description(std::string_view name, const std::map<std::string, std::string, std::less<>>& all);

}  // namespace detail

/// "geometry_msgs/msg/Twist" as DDS knows it: "geometry_msgs::msg::dds_::Twist_".
std::string dds_type_name(std::string_view name);

/// The hash by which tools of ROS 2 since Iron tell definitions apart (ROS Interface Hashing Standard, version 1).
template <Described T>
std::string type_hash() {
    std::map<std::string, std::string, std::less<>> all;
    detail::describe_type<T>(all);
    return detail::hash_of_description(Describe<T>::name, all);
}

}  // namespace nezumi::ros
