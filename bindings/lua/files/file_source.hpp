// Where in the text of a Lua file the fields of a table stand that a call was given: Lua itself only knows the call's
// line.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

class Value;

/// A field within nested tables: "pose", "x"; elements are "[1]", "[2]".
using FieldPath = std::vector<std::string>;

/// "pose.x", "sensors.front.at[2]".
std::string to_text(const FieldPath& path);

/// What a call was given: the name before its table, "" when it takes none or nobody knows, and the table, or null.
struct GivenTable {
    std::string name{};
    const Value* table = nullptr;
};

class FileSource {
public:
    /// Text that is no Lua gives fewer places, never an error.
    FileSource(std::string_view text, std::string shown);
    ~FileSource();
    FileSource(FileSource&&) noexcept;
    FileSource& operator=(FileSource&&) noexcept;

    const std::string& shown() const { return shown_; }

    /// The place of a field of the table that `word` was called with at `call`; of the field around it when the text
    /// doesn't show the field itself (a program made it); `call` when it shows nothing. Of several such calls in that
    /// line it is the one whose text can give what was `given`; `call` when that is not one alone.
    Place find(std::string_view word, const Place& call, const FieldPath& path, const GivenTable& given = {}) const;

private:
    struct Node;
    class Reader;
    std::string shown_;
    std::unique_ptr<Node> calls_;  // every call with a table: its children are the table's fields
};

}  // namespace nezumi
