// Finds the fields of a call's table in the text of a Lua file. Lua itself knows only the line of the call.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

class Value;

/// A path to a field in nested tables: "pose", "x"; elements are "[1]", "[2]".
using FieldPath = std::vector<std::string>;

/// "pose.x", "sensors.front.at[2]".
std::string to_text(const FieldPath& path);

/// The arguments of a call: the name before its table ("" if there is none or it is unknown), and the table or null.
struct GivenTable {
    std::string name{};
    const Value* table = nullptr;
};

class FileSource {
public:
    /// A text with syntax errors gives fewer places, never an error.
    FileSource(std::string_view text, std::string shown);
    ~FileSource();
    FileSource(FileSource&&) noexcept;
    FileSource& operator=(FileSource&&) noexcept;

    const std::string& shown() const { return shown_; }

    /// The place of a field of the table argument of `word`, called at `call`. If the text does not contain the field
    /// (because a program made it), the place of the outer field; if it contains none, `call`. Of several calls in the
    /// line, the only one whose text fits `given`; `call` if this is ambiguous.
    Place find(std::string_view word, const Place& call, const FieldPath& path, const GivenTable& given = {}) const;

private:
    struct Node;
    class Reader;
    std::string shown_;
    std::unique_ptr<Node> calls_;  // every call with a table; its children are the fields
};

}  // namespace nezumi
