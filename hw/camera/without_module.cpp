// A program without OpenCV (NEZUMI_SIMULATION=OFF) opens no camera.
#include "hw/camera/capture.hpp"

namespace nezumi::hw {

tl::expected<std::unique_ptr<Capture>, std::string> open_by_opencv(const std::string& /*node*/,
                                                                   const CaptureSettings& /*settings*/) {
    return tl::unexpected(load_opencv().error());
}

tl::expected<void, std::string> load_opencv() {
    return tl::unexpected<std::string>("this nezumi is built without cameras: take it out of the system");
}

}  // namespace nezumi::hw
