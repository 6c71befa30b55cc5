// What reads the texts of a case, by the folder of tests/texts that they are in.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "text_file.hpp"

namespace nezumi::texts {

/// Reads the texts of one case, one after the other, and says what came of each.
class CaseReader {
public:
    CaseReader() = default;
    virtual ~CaseReader() = default;
    CaseReader(const CaseReader&) = delete;
    CaseReader& operator=(const CaseReader&) = delete;

    /// A file that the case has, beside what is shipped.
    virtual void write(const std::string& name, const std::string& text) = 0;
    /// What a text in Lua says: errors at their lines, what it prints, in the order of time.
    virtual std::vector<Remark> read(const Text& text) = 0;
    /// What an input of a transcript is answered.
    virtual std::string answer(const std::string& input);
};

/// null: there is no such kind.
std::unique_ptr<CaseReader> make_reader(std::string_view kind);

std::unique_ptr<CaseReader> make_console_reader();
std::unique_ptr<CaseReader> make_command_reader();

}  // namespace nezumi::texts
