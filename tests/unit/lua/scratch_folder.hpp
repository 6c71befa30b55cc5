// A folder of its own for a test, gone when the test is over.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace nezumi {

class Scratch {
public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "nezumi_test_XXXXXX").string();
        root_ = mkdtemp(name.data());
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    std::filesystem::path path() const { return root_; }
    std::filesystem::path path(std::string_view name) const { return root_ / name; }

    /// Writes a file, and the folders it is in.
    std::filesystem::path write(std::string_view name, std::string_view text) const {
        const std::filesystem::path file = path(name);
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

private:
    std::filesystem::path root_;
};

}  // namespace nezumi
