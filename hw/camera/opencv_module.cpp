// The camera module: OpenCV's capture by Video4Linux. Only this file needs OpenCV's videoio.
#include <cstdint>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "hw/camera/module.hpp"

namespace nezumi::hw {
namespace {

class OpencvCapture final : public Capture {
public:
    OpencvCapture(const std::string& node, const CaptureSettings& settings) : settings_(settings) {
        captures_.emplace_back();
        // Errors are reported once by nezumi itself.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        if (!device().open(node, cv::CAP_V4L2)) return;
        if (const std::string& code = settings.pixel_format; code.size() == 4)
            device().set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]));
        device().set(cv::CAP_PROP_FRAME_WIDTH, settings.width);
        device().set(cv::CAP_PROP_FRAME_HEIGHT, settings.height);
        device().set(cv::CAP_PROP_FPS, settings.frame_rate);
        // A short queue, because only the newest frame is used.
        device().set(cv::CAP_PROP_BUFFERSIZE, 2);
        if (settings.undistort) make_maps();
    }

    bool is_open() const { return captures_.front().isOpened(); }
    // The pixel format that the camera sends now, four letters.
    std::string pixel_format() const {
        const auto code = static_cast<std::uint32_t>(captures_.front().get(cv::CAP_PROP_FOURCC));
        std::string letters;
        for (unsigned shift = 0; shift < 32; shift += 8) letters += static_cast<char>(code >> shift & 0xff);
        return letters;
    }
    cv::Size size() const {
        const cv::VideoCapture& device = captures_.front();
        return {static_cast<int>(device.get(cv::CAP_PROP_FRAME_WIDTH)),
                static_cast<int>(device.get(cv::CAP_PROP_FRAME_HEIGHT))};
    }

    Wait wait(double seconds) override {
        try {
            // OpenCV's read waits up to 10 s for a frame. `waitAny` has a time limit and also grabs the frame.
            const std::int64_t begin = cv::getTickCount();
            std::vector<int> ready;
            if (cv::VideoCapture::waitAny(captures_, ready, static_cast<std::int64_t>(seconds * 1e9)))
                return Wait::frame;
            // If the device is gone, `waitAny` returns immediately.
            const double waited = static_cast<double>(cv::getTickCount() - begin) / cv::getTickFrequency();
            return waited < seconds / 2 ? Wait::failed : Wait::nothing;
        } catch (const cv::Exception&) {
            return Wait::failed;
        }
    }

    double frame_time() const override { return captures_.front().get(cv::CAP_PROP_POS_MSEC) / 1000; }

    bool take(std::vector<std::uint8_t>& pixels) override {
        try {
            if (!device().retrieve(frame_) || frame_.cols != settings_.width || frame_.rows != settings_.height)
                return false;
            pixels.resize(static_cast<std::size_t>(settings_.width) * settings_.height * (settings_.color ? 3 : 1));
            cv::Mat picture(frame_.size(), settings_.color ? CV_8UC3 : CV_8UC1, pixels.data());
            const cv::Mat* whole = &frame_;
            if (settings_.undistort) {
                cv::remap(frame_, straight_, places_, weights_, cv::INTER_LINEAR);
                whole = &straight_;
            }
            cv::cvtColor(*whole, picture, settings_.color ? cv::COLOR_BGR2RGB : cv::COLOR_BGR2GRAY);
            return picture.data == pixels.data();
        } catch (const cv::Exception&) {
            return false;
        }
    }

private:
    cv::VideoCapture& device() { return captures_.front(); }
    void make_maps() {
        const CameraIntrinsics& raw = settings_.raw_intrinsics;
        const cv::Matx33d matrix(raw.fx, 0, raw.cx, 0, raw.fy, raw.cy, 0, 0, 1);
        const cv::Vec<double, 8> distortion(raw.k1, raw.k2, raw.p1, raw.p2, raw.k3, raw.k4, raw.k5, raw.k6);
        cv::initUndistortRectifyMap(matrix, distortion, cv::noArray(), matrix, {settings_.width, settings_.height},
                                    CV_16SC2, places_, weights_);
    }

    const CaptureSettings settings_;
    std::vector<cv::VideoCapture> captures_;  // the only one, in the form that `waitAny` needs
    cv::Mat frame_, straight_;                // buffers, kept to avoid allocation
    cv::Mat places_, weights_;
};

std::unique_ptr<Capture> open(const std::string& node, const CaptureSettings& settings, std::string& problem) {
    try {
        auto capture = std::make_unique<OpencvCapture>(node, settings);
        if (!capture->is_open()) {
            problem =
                node + ": it gives no pictures that OpenCV can read. v4l2-ctl --list-formats-ext shows what it has";
            return nullptr;
        }
        if (const std::string sent = capture->pixel_format();
            !settings.pixel_format.empty() && sent != settings.pixel_format) {
            problem = cv::format(
                "%s: it sends %s, not %s: set pixel_format to one that it has: v4l2-ctl "
                "--list-formats-ext",
                node.c_str(), sent.c_str(), settings.pixel_format.c_str());
            return nullptr;
        }
        if (const cv::Size size = capture->size(); size != cv::Size(settings.width, settings.height)) {
            problem = cv::format(
                "%s: it gives %d x %d pixels, not %d x %d: set width = %d and height = %d, or another size that it "
                "has: "
                "v4l2-ctl --list-formats-ext",
                node.c_str(), size.width, size.height, settings.width, settings.height, size.width, size.height);
            return nullptr;
        }
        return capture;
    } catch (const std::exception& thrown) {
        problem = node + ": " + thrown.what();
        return nullptr;
    }
}

}  // namespace

}  // namespace nezumi::hw

extern "C" __attribute__((visibility("default"))) nezumi::hw::OpenInModule nezumi_open_camera;

nezumi::hw::Capture* nezumi_open_camera(const std::string& node, const nezumi::hw::CaptureSettings& settings,
                                        std::string& problem) {
    return nezumi::hw::open(node, settings, problem).release();
}
