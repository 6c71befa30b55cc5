// JPEG by OpenCV.
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "bindings/web/jpeg.hpp"

namespace nezumi::web {
namespace {

constexpr int quality = 80;

bool encode(const CameraImage& picture, Octets& jpeg, std::string& problem) {
    const int channels = picture.bpp == 24 ? 3 : 1;
    const std::size_t needed = std::size_t{picture.width} * picture.height * static_cast<std::size_t>(channels);
    if (needed == 0 || picture.pixels.size() != needed || (picture.bpp != 8 && picture.bpp != 24)) {
        problem = "a picture whose size does not fit its pixels";
        return false;
    }
    try {
        // cv::Mat has no constructor for const data; this one is only read.
        cv::Mat pixels(picture.height, picture.width, channels == 3 ? CV_8UC3 : CV_8UC1,
                       const_cast<std::uint8_t*>(picture.pixels.data()));
        if (channels == 3 && picture.format != "bgr8") {
            cv::Mat turned;
            cv::cvtColor(pixels, turned, cv::COLOR_RGB2BGR);
            pixels = turned;
        }
        if (cv::imencode(".jpg", pixels, jpeg, {cv::IMWRITE_JPEG_QUALITY, quality})) return true;
        problem = "OpenCV can't write JPEG";
    } catch (const std::exception& thrown) {
        problem = thrown.what();
    }
    return false;
}

}  // namespace
}  // namespace nezumi::web

extern "C" __attribute__((visibility("default"))) nezumi::web::EncodeInModule nezumi_encode_jpeg;

bool nezumi_encode_jpeg(const nezumi::CameraImage& picture, nezumi::Octets& jpeg, std::string& problem) {
    return nezumi::web::encode(picture, jpeg, problem);
}
