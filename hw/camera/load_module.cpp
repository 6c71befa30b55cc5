// Loads the module with OpenCV's videoio when the first camera is opened.
#include "engine/base/module.hpp"
#include "hw/camera/capture.hpp"
#include "hw/camera/module.hpp"

namespace nezumi::hw {
namespace {

const Expected<void*>& opener() {
    static const auto opens = load_function(
        {.file = camera_module, .function = open_in_module, .part = "cameras", .needs = "libopencv-videoio406"});
    return opens;
}

}  // namespace

tl::expected<void, std::string> load_opencv() {
    if (!opener()) return tl::unexpected(opener().error().message);
    return {};
}

tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& node,
                                                                   const CaptureSettings& settings) {
    if (auto loaded = load_opencv(); !loaded) return tl::unexpected(loaded.error());
    std::string problem;
    std::unique_ptr<Capture> capture(reinterpret_cast<OpenInModule*>(*opener())(node, settings, problem));
    if (capture == nullptr) return tl::unexpected(problem);
    return capture;
}

}  // namespace nezumi::hw
