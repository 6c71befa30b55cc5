// Reads the table of a structure that describes itself, strictly and field by field.
#pragma once

#include "bindings/lua/files/file_fields.hpp"

namespace nezumi {

/// How a table is read.
struct Reading {
    unsigned kind = 0;     ///< of a structure that comes in kinds, as a bit; 0: the one that its own field selects
    bool is_whole = true;  ///< what is required must be there; else the table changes a structure that is whole
};

/// Reads every field that the type of `out` has and the table gives; the others keep their values. What is wrong is
/// said to the check of `fields`. Fields that are read by hand are only known from here on; `fields.done()` is left to
/// the caller.
void read_record(Fields& fields, const ValuePlace& out, Reading reading = {});
template <Recorded T>
void read_record(Fields& fields, T& out, Reading reading = {}) {
    read_record(fields, ValuePlace(record_of<T>(), &out), reading);
}

}  // namespace nezumi
