// With a loader of its own the process is that loader's file, so the file is asked for that this code is mapped from.
#include "engine/base/own_program.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace nezumi {
namespace {

std::filesystem::path mapped_file() {
    const auto here = reinterpret_cast<std::uintptr_t>(&mapped_file);
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        // "55d0c8a00000-55d0c8b00000 r-xp 00002000 fe:00 123  /usr/bin/nezumi"
        std::istringstream fields(line);
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        std::string rights, offset, device, inode, file;
        fields >> std::hex >> begin >> dash >> end >> rights >> offset >> device >> inode >> std::ws;
        if (here < begin || here >= end || !std::getline(fields, file)) continue;
        return file;
    }
    return {};
}

}  // namespace

std::filesystem::path own_program() {
    static const std::filesystem::path program = [] {
        const std::filesystem::path file = mapped_file(), folder = file.parent_path();
        return folder.filename() == "libexec" ? folder.parent_path() / "bin" / file.filename() : file;
    }();
    return program;
}

}  // namespace nezumi
