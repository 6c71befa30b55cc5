// How a table that a person writes describes itself, once: its fields as a message's, and what may stand in each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/values/describe.hpp"

namespace nezumi {

/// Which numbers may stand in a field. All are finite.
enum class NumberRange { any, not_negative, positive };

/// What may stand in a field, beside what its type says.
struct Rule {
    bool required = false;
    NumberRange range = NumberRange::any;         ///< of a number, or of each coordinate of a place
    double least = 0;                             ///< of such a number, unless it is 0: smaller ones can't be simulated
    double most = 1e6;                            ///< of its size: no length, mass or rate of a robot comes near it
    std::int64_t min = 0;                         ///< of a whole number, inclusive
    std::int64_t max = 0;                         ///< of a whole number, inclusive
    bool level = false;                           ///< of a place: its z may be left out
    std::array<std::string_view, 2> words{};      ///< of a truth value: what a file says for false and for true
    std::span<const std::string_view> choices{};  ///< of a text: the only ones that may stand there
    unsigned of = 0;              ///< the kinds of the structure that have this field, as bits; 0: all of them
    bool selects = false;         ///< this field, a choice, says of which kind the structure is
    bool by_hand = false;         ///< its reader takes it by hand: it depends on other fields, or on files
    std::string_view fallback{};  ///< what holds without the field, where that is not the member's first value
    /// Brings a text into its final form, or says why it may not be.
    std::string (*adopt)(std::string& text) = nullptr;
};

/// A field of a table, and the member that holds it.
template <class S, class T>
struct Setting {
    std::string_view name;
    T S::*member;
    std::string_view unit;
    std::string_view doc;
    Rule rule{};
};
template <class S, class T>
Setting(const char*, T S::*, const char*, const char*, Rule = {}) -> Setting<S, T>;

/// A field that no member holds as it is: its reader takes it by hand. `type` is Lua's, as editors know it.
struct Extra {
    std::string_view name;
    std::string_view type;
    std::string_view unit;
    std::string_view doc;
    Rule rule{};
};

/// A member that no file sets.
template <class S, class T>
struct Internal {
    T S::*member;
};
template <class S, class T>
Internal(T S::*) -> Internal<S, T>;

/// The names of an enumeration's values in files, in order: specialised beside the enumeration as `names`.
template <class E>
struct Choices;

/// A structure that a person writes as a table: `Describe` has `name`, `doc` and a tuple `fields` of the above. Where
/// it comes in kinds, `kinds` has their names.
template <class T>
concept Recorded = requires {
    Describe<T>::doc;
    Describe<T>::fields;
};

namespace detail {

template <class T, std::size_t I, std::size_t J>
constexpr bool is_same_member() {
    const auto& a = std::get<I>(Describe<T>::fields);
    const auto& b = std::get<J>(Describe<T>::fields);
    if constexpr (requires { a.member == b.member; }) {
        return a.member == b.member;
    } else {
        return false;
    }
}

// 1 for a member that no earlier field has: two fields may stand for one member.
template <class T, std::size_t I, std::size_t... J>
constexpr std::size_t is_new_member(std::index_sequence<J...>) {
    if constexpr (requires { std::get<I>(Describe<T>::fields).member; }) {
        return (is_same_member<T, I, J>() || ...) ? 0 : 1;
    } else {
        return 0;
    }
}

template <class T, std::size_t... I>
constexpr std::size_t described_members(std::index_sequence<I...>) {
    return (is_new_member<T, I>(std::make_index_sequence<I>{}) + ... + 0);
}

}  // namespace detail

/// Calls `visit(field)` for every `Setting` and `Extra` of a structure, in order. A member that `Describe<T>` forgets
/// does not compile.
template <Recorded T, class Visit>
constexpr void for_each_setting(Visit&& visit) {
    using Fields = std::remove_cvref_t<decltype(Describe<T>::fields)>;
    static_assert(detail::member_count<T>() ==
                      detail::described_members<T>(std::make_index_sequence<std::tuple_size_v<Fields>>{}),
                  "Describe<T>::fields must list every member of T: as a Setting, or as Internal");
    const auto one = [&](const auto& field) {
        if constexpr (requires { field.rule; }) visit(field);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, Describe<T>::fields);
}

/// "a number", "a positive number".
std::string_view words_for(NumberRange range);
/// What is wrong with a number by the rule of its field, "" for nothing: "expected a positive number, got -1".
std::string check_number(double number, const Rule& rule, std::string_view unit);
/// The same of every number of a pose, which has no rule but the widest.
std::string check_pose(const Pose2D& pose);
std::string check_pose(const Pose3D& pose);

namespace detail {

template <Recorded T>
std::string check_fields(const T& record, const std::string& path);

template <class T>
std::string check_member(const T& value, const std::string& path, const Rule& rule, std::string_view unit) {
    if constexpr (std::is_same_v<T, double>) {
        const std::string problem = check_number(value, rule, unit);
        return problem.empty() ? problem : "field '" + path + "' " + problem;
    } else if constexpr (requires { value.x; }) {
        std::string problem = check_member(value.x, path + ".x", rule, unit);
        if (problem.empty()) problem = check_member(value.y, path + ".y", rule, unit);
        if constexpr (requires { value.z; }) {
            if (problem.empty()) problem = check_member(value.z, path + ".z", rule, unit);
        }
        return problem;
    } else if constexpr (requires { value.has_value(); }) {
        return value ? check_member(*value, path, rule, unit) : std::string();
    } else if constexpr (Recorded<T>) {
        return check_fields(value, path + ".");
    } else {
        return "";
    }
}

template <Recorded T>
std::string check_fields(const T& record, const std::string& path) {
    std::string problem;
    for_each_setting<T>([&](const auto& field) {
        if constexpr (requires { field.member; }) {
            if (problem.empty())
                problem = check_member(record.*(field.member), path + std::string(field.name), field.rule, field.unit);
        }
    });
    return problem;
}

}  // namespace detail

/// Checks the numbers and places of a structure by the rules of its fields, for whoever did not read it field by field:
/// a map, a program. The error is "box: field 'size.x' expected a positive number, got 0", at `place`.
template <Recorded T>
Expected<void> check_record(const T& record, const Place& place) {
    const std::string problem = detail::check_fields(record, "");
    if (!problem.empty()) return failure(std::string(Describe<T>::name) + ": " + problem, place);
    return {};
}

}  // namespace nezumi
