// The disk, read whole and never past a size.
#include "bindings/lua/project/project_files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace nezumi {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;

class Disk final : public ProjectFiles {
public:
    fs::path working_folder() const override {
        std::error_code problem;
        return fs::current_path(problem);
    }
    bool is_file(const fs::path& path) const override {
        std::error_code problem;
        return fs::is_regular_file(path, problem);
    }
    bool is_folder(const fs::path& path) const override {
        std::error_code problem;
        return fs::is_directory(path, problem);
    }
    Expected<std::string> read(const fs::path& path, const std::string& shown) const override {
        return read_text_file(path, shown);
    }
};

}  // namespace

const ProjectFiles& disk() {
    static const Disk the_disk;
    return the_disk;
}

Expected<std::string> read_text_file(const fs::path& path, const std::string& shown) {
    const auto refuse = [&](int code) {
        return failure(fmt::format("can't be read: {}", std::strerror(code)), {shown});
    };
    if (disk().is_folder(path)) return failure("is a folder, expected a file", {shown});
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) return errno == ENOENT ? failure("there is no such file", {shown}) : refuse(errno);
    std::string text;
    char buffer[65536];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) {
        text.append(buffer, n);
        if (text.size() > largest_file)
            return failure(fmt::format("is larger than {} MB", largest_file >> 20), {shown});
    }
    if (std::ferror(file.get()) != 0) return refuse(errno);
    return text;
}

}  // namespace nezumi
