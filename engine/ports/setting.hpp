// Descriptions of tables that a person writes in files: the fields, with the limits of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// The allowed numbers of a field. All are finite.
enum class NumberRange { any, not_negative, positive };

/// The limits of a field, in addition to its type.
struct Rule {
    bool required = false;
    NumberRange range = NumberRange::any;  ///< of a number, or of each coordinate of a place
    double least = 0;                      ///< smallest number except 0: smaller numbers can't be simulated
    double most = 1e6;                     ///< largest magnitude; lengths, masses and rates of robots are much smaller
    std::int64_t min = 0;                  ///< of a whole number, inclusive
    std::int64_t max = 0;                  ///< of a whole number, inclusive
    bool level = false;                    ///< of a place: the coordinate z may be left out
    std::array<std::string_view, 2> words{};      ///< of a boolean: the words for false and true in files
    std::span<const std::string_view> choices{};  ///< of a text: the only allowed ones
    unsigned of = 0;              ///< the kinds of the structure that have this field, as bits; 0: all of them
    bool selects = false;         ///< this field, a choice, determines the kind of the structure
    bool by_hand = false;         ///< read by special code, because it depends on other fields or on files
    std::string_view fallback{};  ///< the default in documentation, if it is not the member's initial value
    /// Converts a text to its final form. Returns the error, or "".
    std::string (*adopt)(std::string& text) = nullptr;
};

/// A field of a table, and the structure's member for it.
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

/// A field that is read by special code, because no member has its value. `type` is the Lua type for editors.
struct Extra {
    std::string_view name;
    std::string_view type;
    std::string_view unit;
    std::string_view doc;
    Rule rule{};
};

/// A member that is not set by files.
template <class S, class T>
struct Internal {
    T S::*member;
};
template <class S, class T>
Internal(T S::*) -> Internal<S, T>;

/// The names of an enumeration's values in files, in order: a specialisation beside the enumeration has them as
/// `names`.
template <class E>
struct Choices;

/// A structure that is written as a table in files: `Describe` has `name`, `doc` and `fields` (each a `Setting`,
/// `Extra` or `Internal`). If the structure has several kinds, `kinds` has their names.
template <class T>
concept Recorded = requires {
    Describe<T>::doc;
    Describe<T>::fields;
};

namespace detail {

template <class A, class B>
constexpr bool is_same_member(const A& a, const B& b) {
    if constexpr (requires { a.member == b.member; }) {
        return a.member == b.member;
    } else {
        return false;
    }
}

// The number of members that the fields set; two fields may set the same one.
template <class... Each>
constexpr std::size_t count_members(const Each&... each) {
    std::size_t members = 0, place = 0;
    const auto count = [&](const auto& field) {
        std::size_t first = 0;  // place of the first field with this member
        (void)((is_same_member(field, each) || (++first, false)) || ...);
        if (first == place++) ++members;
    };
    (count(each), ...);
    return members;
}

}  // namespace detail

/// Calls `visit(field)` for every `Setting` and `Extra` of a structure, in order. Does not compile if `Describe<T>`
/// omits a member.
template <Recorded T, class Visit>
constexpr void for_each_setting(Visit&& visit) {
    constexpr std::size_t described =
        Describe<T>::fields.apply([](const auto&... each) { return detail::count_members(each...); });
    static_assert(detail::member_count<T>() == described,
                  "Describe<T>::fields must list every member of T: as a Setting, or as Internal");
    const auto one = [&](const auto& field) {
        if constexpr (requires { field.rule; }) visit(field);
    };
    Describe<T>::fields.apply([&](const auto&... field) { (one(field), ...); });
}

/// The numbers that a rule allows, in words: "a number", "a positive number", "a number from 0 to 1".
std::string words_for(const Rule& rule);
/// Checks a number by the rule of its field. Returns the error, or "": "expected a positive number, got -1".
std::string check_number(double number, const Rule& rule, std::string_view unit);
/// Checks that each number of a pose is finite and within the default bound of `Rule`.
std::string check_pose(const Pose2D& pose);
std::string check_pose(const Pose3D& pose);

namespace detail {

template <class T>
struct IsMap : std::false_type {};
template <class T>
struct IsMap<std::map<std::string, T, std::less<>>> : std::true_type {
    using Element = T;
};

// Types that only occur in tables of files: enumerations, structures with rules, and containers of these.
template <class T>
constexpr bool is_written() {
    if constexpr (IsOptional<T>::value || IsVector<T>::value) {
        return is_written<typename T::value_type>();
    } else {
        return Recorded<T> || std::is_enum_v<T> || IsMap<T>::value;
    }
}

template <class T>
const Type& written_type_of();

template <class T>
Type make_written() {
    Type type = table_for<T>();
    if constexpr (std::is_enum_v<T>) {
        type.kind = Type::Kind::enumeration;
        type.choices.assign(Choices<T>::names.begin(), Choices<T>::names.end());
    } else if constexpr (IsMap<T>::value) {
        type.kind = Type::Kind::map;
        type.element = &written_type_of<typename IsMap<T>::Element>();
        type.entries.for_each = [](const void* map, const EntryVisitor& visit) {
            for (const auto& [name, element] : *static_cast<const T*>(map)) visit(name, &element);
        };
        type.entries.add = [](void* map, const std::string& name) -> void* { return &(*static_cast<T*>(map))[name]; };
    } else {
        type.kind = IsOptional<T>::value ? Type::Kind::optional : Type::Kind::sequence;
        type.element = &written_type_of<typename T::value_type>();
        type.elements = elements_of<T>();
    }
    return type;
}

template <Recorded T>
Type make_record() {
    Type type = table_for<T>();
    type.kind = Type::Kind::structure;
    type.name = Describe<T>::name;
    type.doc = Describe<T>::doc;
    if constexpr (requires { Describe<T>::kinds; })
        type.kinds.assign(Describe<T>::kinds.begin(), Describe<T>::kinds.end());
    const T sample{};
    for_each_setting<T>([&](const auto& field) {
        Type::Field made{.name = std::string(field.name),
                         .type = &type_of<std::monostate>(),
                         .unit = std::string(field.unit),
                         .doc = std::string(field.doc),
                         .rule = &field.rule};
        if constexpr (requires { field.member; }) {
            const auto& member = sample.*(field.member);
            made.offset = place_in(sample, member);
            made.type = &written_type_of<std::remove_cvref_t<decltype(member)>>();
        } else {
            made.lua_type = field.type;
        }
        type.fields.push_back(std::move(made));
    });
    return type;
}

}  // namespace detail

/// The table of a structure that is written in files: its `Setting`s with their rules, and its `Extra`s, which have no
/// value.
template <Recorded T>
const Type& record_of() {
    static const Type type = detail::make_record<T>();
    return type;
}

template <class T>
const Type& detail::written_type_of() {
    if constexpr (Recorded<T>) {
        return record_of<T>();
    } else if constexpr (is_written<T>()) {
        static const Type type = make_written<T>();
        return type;
    } else {
        return type_of<T>();
    }
}

/// Whether a type is a structure whose fields have rules.
inline bool is_record(const Type& type) { return !type.fields.empty() && type.fields.front().rule != nullptr; }

/// The fields of a structure: "{ vx =, vy =, va = }". `kinds`: only the fields of these kinds, as bits; 0: all fields.
std::string usage_of(const Type& record, unsigned kinds = 0);
template <Recorded T>
std::string usage_of(unsigned kinds = 0) {
    return usage_of(record_of<T>(), kinds);
}

/// Checks the numbers and places of a structure by the rules of its fields, for structures that were not read from a
/// table (from a map, from a program). The error is "box: field 'size.x' expected a positive number, got 0", at
/// `place`.
Expected<void> check_record(const ValueView& record, const Place& place);
template <Recorded T>
Expected<void> check_record(const T& record, const Place& place) {
    return check_record(ValueView(record_of<T>(), &record), place);
}

}  // namespace nezumi
