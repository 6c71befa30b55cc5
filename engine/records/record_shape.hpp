// Describes structures that a person writes as tables, for editors' annotations and tables of the documentation.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/ports/setting.hpp"

namespace nezumi {

/// The description of one field.
struct FieldRow {
    std::string name;
    std::string type;    ///< the Lua type, as editors know it
    std::string values;  ///< the values in words
    std::string unit;    ///< "" for none
    std::string doc;
    std::string fallback;  ///< the default; "" if there is none
    std::string kinds;     ///< the kinds of the structure that have this field; "" for all
    bool required = false;
};

/// One structure.
struct RecordShape {
    std::string name;
    std::string doc;
    std::vector<FieldRow> rows;
};

/// "robot_model": "RobotModelFields", "parameter_options": "ParameterOptions".
std::string class_of(std::string_view record);

/// The values of a field of this type in words: "a positive number", "{ x, y, z }", "one of box, cylinder".
std::string words_of(const Type& type, const Rule& rule);

RecordShape shape_of(const Type& record);
template <Recorded T>
RecordShape shape_of_record() {
    return shape_of(record_of<T>());
}

}  // namespace nezumi
