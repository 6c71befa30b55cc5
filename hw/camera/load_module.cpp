// Finds the module beside the program, in the folder for its libraries.
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "hw/camera/capture.hpp"
#include "hw/camera/module.hpp"

namespace nezumi::hw {
namespace {

// It stays until the program ends: a thread may hang in it.
tl::expected<OpenInModule*, std::string> load() {
    std::error_code none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    const std::filesystem::path file = (program.parent_path() / NEZUMI_MODULES / camera_module).lexically_normal();
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr)
        return tl::unexpected(
            fmt::format("the part of nezumi for cameras can't be loaded: {}. Install nezumi anew, "
                        "with OpenCV: sudo apt install libopencv-videoio406",
                        dlerror()));
    void* function = dlsym(module, open_in_module);
    if (function == nullptr)
        return tl::unexpected(fmt::format("{} is of another version of nezumi: install it anew", file.string()));
    return reinterpret_cast<OpenInModule*>(function);
}

}  // namespace

tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& node,
                                                                   const CaptureSettings& settings) {
    static const auto opens = load();
    if (!opens) return tl::unexpected(opens.error());
    std::string problem;
    std::unique_ptr<Capture> capture((*opens)(node, settings, problem));
    if (capture == nullptr) return tl::unexpected(problem);
    return capture;
}

}  // namespace nezumi::hw
