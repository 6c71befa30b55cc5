// Tables of types that are made at run time: what a file defines lies in memory as they say.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "engine/values/value.hpp"

namespace nezumi {

/// Makes tables and keeps them: they live as long as it. A table refers to those that it was made of, which must live
/// as long.
class Types {
public:
    Types() = default;
    Types(const Types&) = delete;
    Types& operator=(const Types&) = delete;

    /// Any number of elements. Of numbers, truth values and texts it is the `std::vector` that C++ has of them.
    const Type& sequence_of(const Type& element);
    /// `length` (1 or more) elements, one behind the other.
    const Type& array_of(const Type& element, std::size_t length);
    /// One of these, which are not the same.
    const Type& enumeration_of(std::vector<std::string> choices);
    /// These fields, in this order; their offsets are set here.
    Type& structure_of(std::string name, std::vector<Type::Field> fields);
    /// A type of its own that lies in memory as another one.
    Type& like(const Type& other);

private:
    Type& add(Type type);

    std::deque<Type> all_;
};

/// What `value` is by itself from now on: of a structure that was made here, and is not used yet.
void set_initial(Type& type, Value value);

}  // namespace nezumi
