// Finds a module beside the program, in the folder for its libraries.
#include "engine/base/module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

namespace nezumi {
namespace {

std::filesystem::path path_of(const Module& module) {
    return (own_program().parent_path() / NEZUMI_MODULES / module.file).lexically_normal();
}

}  // namespace

std::filesystem::path own_program() {
    // The portable package (.ci/portable) starts this program through its own dynamic loader. The kernel then knows
    // only the loader, so the start script sets this variable.
    if (const char* script = std::getenv("NEZUMI_PROGRAM")) return script;
    std::error_code none;
    // The kernel's link to the program, which a confined program may read too.
    return std::filesystem::read_symlink("/proc/self/exe", none);
}

bool is_built_with(const Module& module) {
    std::error_code none;
    return std::filesystem::exists(path_of(module), none);
}

Expected<void*> load_function(const Module& module) {
    const std::filesystem::path file = path_of(module);
    if (!is_built_with(module))
        return failure(
            fmt::format("this build of nezumi has no support for {}: there is no {}", module.part, file.string()));
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        return failure(
            fmt::format("the part of nezumi for {} can't be loaded: {}. Install nezumi again, with what it needs: sudo "
                        "apt install {}",
                        module.part, dlerror(), module.needs));
    void* function = dlsym(library, std::string(module.function).c_str());
    if (function == nullptr)
        return failure(fmt::format("{} is of another version of nezumi: install nezumi again", file.string()));
    return function;
}

}  // namespace nezumi
