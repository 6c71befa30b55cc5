// Reads the table of a described structure, strictly and field by field.
#pragma once

#include "engine/records/fields.hpp"

namespace nezumi {

/// Options for reading a table.
struct Reading {
    unsigned kind = 0;     ///< for a structure with kinds, the kind as a bit; 0: a field of the table selects the kind
    bool is_whole = true;  ///< required fields must exist; false: the table changes a complete structure
};

/// Reads all fields of the type of `out` that the table has; the others keep their values. Mistakes go to the check of
/// `fields`. Fields that are read by special code (`Rule::by_hand`, `Extra`) are only marked as read. The caller must
/// read them, and then call `fields.done()`.
void read_record(Fields& fields, const ValuePlace& out, Reading reading = {});
template <Recorded T>
void read_record(Fields& fields, T& out, Reading reading = {}) {
    read_record(fields, ValuePlace(record_of<T>(), &out), reading);
}

}  // namespace nezumi
