// Finds the fields of a call's table in the text of a Lua file. Lua itself knows only the line of the call.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/records/field_path.hpp"

namespace nezumi {

class FileSource final : public FieldSource {
public:
    /// A text with syntax errors gives fewer locations, never an error.
    FileSource(std::string_view text, std::string shown);
    ~FileSource() override;
    FileSource(FileSource&&) noexcept;
    FileSource& operator=(FileSource&&) noexcept;

    const std::string& shown() const { return shown_; }

    Place find(std::string_view word, const Place& call, const FieldPath& path, const GivenTable& given) const override;

private:
    struct Node;
    class Reader;
    std::string shown_;
    std::unique_ptr<Node> calls_;  // every call with a table; its children are the fields
};

}  // namespace nezumi
