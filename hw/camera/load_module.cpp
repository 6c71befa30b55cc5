// Cameras by OpenCV's videoio: a module that is loaded when the first one is opened.
#include "engine/base/module.hpp"
#include "hw/camera/capture.hpp"
#include "hw/camera/module.hpp"

namespace nezumi::hw {

tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& node,
                                                                   const CaptureSettings& settings) {
    static const auto opens = load_function(
        {.file = camera_module, .function = open_in_module, .part = "cameras", .needs = "libopencv-videoio406"});
    if (!opens) return tl::unexpected(opens.error().message);
    std::string problem;
    std::unique_ptr<Capture> capture(reinterpret_cast<OpenInModule*>(*opens)(node, settings, problem));
    if (capture == nullptr) return tl::unexpected(problem);
    return capture;
}

}  // namespace nezumi::hw
