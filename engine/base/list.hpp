// Searches for a value in a short list, element by element.
#pragma once

#include <utility>

namespace nezumi {

/// Whether one of the list's elements equals `value`, as by C++23's `std::ranges::contains`.
template <class List, class Value>
bool contains(const List& list, const Value& value) {
    for (const auto& each : list)
        if (each == value) return true;
    return false;
}

/// Appends the value if the list does not contain it.
template <class List, class Value>
void add_once(List& list, Value&& value) {
    if (!contains(list, value)) list.emplace_back(std::forward<Value>(value));
}

}  // namespace nezumi
