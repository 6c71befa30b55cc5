// Type tables made at run time, for the memory layout of types that files define.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "engine/values/value.hpp"

namespace nezumi {

/// Makes type tables and owns them. A table refers to the tables of its parts, which must live as long.
class Types {
public:
    Types() = default;
    Types(const Types&) = delete;
    Types& operator=(const Types&) = delete;

    /// A sequence of any length. For numbers, booleans and texts it has the layout of a `std::vector`.
    const Type& sequence_of(const Type& element);
    /// An array of `length` (1 or more) elements in consecutive memory.
    const Type& array_of(const Type& element, std::size_t length);
    /// An enumeration with these choices, which must differ.
    const Type& enumeration_of(std::vector<std::string> choices);
    /// A structure with these fields in this order; sets their offsets.
    Type& structure_of(std::string name, std::vector<Type::Field> fields);
    /// A separate type with the same memory layout as `other`.
    Type& like(const Type& other);

private:
    Type& add(Type type);

    std::deque<Type> all_;
};

/// Sets the default value of a structure that `Types` has made. Call it before the type is used.
void set_initial(Type& type, Value value);

}  // namespace nezumi
