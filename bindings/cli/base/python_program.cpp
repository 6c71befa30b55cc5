// Starts Python by its full path, because only this Python has the modules of Debian's packages.
#include "bindings/cli/base/python_program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "bindings/cli/base/environment.hpp"

namespace nezumi::cli {

Expected<std::string> python_file(const std::string& name) {
    std::error_code none;
    for (const std::filesystem::path& folder : installed_folders()) {
        const std::filesystem::path file = folder / name;
        if (std::filesystem::exists(file, none)) return file.string();
    }
    return failure(fmt::format("{} is not among the installed files", name));
}

void become_python(const std::string& file, const std::vector<std::string>& words) {
    std::vector<std::string> all{"/usr/bin/python3", "-B", "-E", "-s", file};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    pointers.reserve(all.size() + 1);
    for (std::string& word : all) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(all.front().c_str(), pointers.data());
}

}  // namespace nezumi::cli
