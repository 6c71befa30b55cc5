// The module for pictures: OpenCV's readers of JPEG, BMP, TIFF and others, and its writer of JPEG. The one place that
// needs imgcodecs.
#include "engine/world/image_module.hpp"

#include <exception>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace nezumi {
namespace {

// Converts to 8 bits per channel: blue, green, red and, if present, alpha.
cv::Mat to_bytes(const cv::Mat& picture) {
    const double scale = picture.depth() == CV_16U ? 1 / 257.0 : picture.depth() == CV_8U ? 1 : 255;
    cv::Mat bytes;
    picture.convertTo(bytes, CV_8U, scale);
    if (bytes.channels() == 1) cv::cvtColor(bytes, bytes, cv::COLOR_GRAY2BGR);
    return bytes;
}

Rgb over_white(const std::uint8_t* bgr, int channels) {
    const int alpha = channels == 4 ? bgr[3] : 255;
    const auto part = [&](int i) { return static_cast<Rgb>((bgr[i] * alpha + 255 * (255 - alpha)) / 255); };
    return part(2) << 16 | part(1) << 8 | part(0);
}

// Suppresses OpenCV's own lines about wrong pictures on standard error.
class Quiet {
public:
    Quiet() : before_(std::cerr.rdbuf(nullptr)) {}
    ~Quiet() { std::cerr.rdbuf(before_); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

private:
    std::streambuf* before_;
};

bool decode(const std::uint8_t* bytes, std::size_t size, Picture& picture, std::string& problem) {
    if (size == 0) {
        problem = "it is empty";
        return false;
    }
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const Quiet quiet;
    const cv::Mat file(1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(bytes));
    // With IMREAD_COLOR OpenCV turns a photograph upright, but drops alpha, which JPEG does not have.
    const bool is_jpeg = size > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
    const cv::Mat read = cv::imdecode(file, is_jpeg ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
    if (read.empty()) {
        problem = "OpenCV can't read its format (PNG, JPEG, BMP, TIFF, WebP, PPM and others are possible)";
        return false;
    }
    const cv::Mat pixels = to_bytes(read);
    if (pixels.channels() != 3 && pixels.channels() != 4) {
        problem = cv::format("it has %d channels, expected 1, 3 or 4", pixels.channels());
        return false;
    }
    picture = {pixels.cols, pixels.rows, {}};
    picture.pixels.reserve(pixels.total());
    for (int row = 0; row < pixels.rows; ++row) {
        const std::uint8_t* at = pixels.ptr<std::uint8_t>(row);
        for (int column = 0; column < pixels.cols; ++column, at += pixels.channels())
            picture.pixels.push_back(over_white(at, pixels.channels()));
    }
    return true;
}

bool encode(int width, int height, int channels, const std::uint8_t* pixels, Octets& jpeg, std::string& problem) {
    constexpr int quality = 80;
    // cv::Mat has no constructor for const data; this one is only read.
    const cv::Mat given(height, width, CV_8UC(channels), const_cast<std::uint8_t*>(pixels));
    cv::Mat picture = given;
    if (channels == 3) cv::cvtColor(given, picture, cv::COLOR_RGB2BGR);
    if (cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, quality})) return true;
    problem = "OpenCV can't write JPEG";
    return false;
}

// Calls OpenCV and converts its exceptions to an error.
template <class Call>
bool caught(const Call& call, std::string& problem) {
    try {
        return call();
    } catch (const cv::Exception& thrown) {  // OpenCV's assertions have several lines: the first is used
        problem = "OpenCV reports: " + thrown.err.substr(0, thrown.err.find('\n'));
    } catch (const std::exception& thrown) {
        problem = thrown.what();
    }
    return false;
}

}  // namespace
}  // namespace nezumi

extern "C" __attribute__((visibility("default"))) nezumi::DecodeInModule nezumi_decode_image;
extern "C" __attribute__((visibility("default"))) nezumi::EncodeInModule nezumi_encode_jpeg;

bool nezumi_decode_image(const std::uint8_t* bytes, std::size_t size, nezumi::Picture& picture, std::string& problem) {
    return nezumi::caught([&] { return nezumi::decode(bytes, size, picture, problem); }, problem);
}

bool nezumi_encode_jpeg(int width, int height, int channels, const std::uint8_t* pixels, nezumi::Octets& jpeg,
                        std::string& problem) {
    return nezumi::caught([&] { return nezumi::encode(width, height, channels, pixels, jpeg, problem); }, problem);
}
