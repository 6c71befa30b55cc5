// Finds the camera's node by its capabilities, and keeps the newest picture.
#include "hw/camera/video_camera.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "hw/device/clock.hpp"
#include "hw/device/node.hpp"
#include "hw/device/numbered_nodes.hpp"
#include "hw/device/tick_clock.hpp"

namespace nezumi::hw {
namespace {

constexpr double waiting = 0.05;    // [s] for a frame per call
constexpr double oldest_frame = 1;  // [s] a frame that seems older has its time from another clock
constexpr double early = 0.2;       // part of a period by which a frame may come too early

std::string with_camera_advice(const NodeError& error) {
    if (error.code == EBUSY)
        return describe(error) + ": another program uses it: fuser -v " + error.path + " says which";
    return with_usb_advice(error, "video");
}

// A node that is open only to ask for its capabilities.
class Questions {
public:
    explicit Questions(const std::string& node) : file_(::open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}
    ~Questions() {
        if (file_ >= 0) ::close(file_);
    }
    Questions(const Questions&) = delete;
    Questions& operator=(const Questions&) = delete;

    bool is_open() const { return file_ >= 0; }
    template <class Data>
    bool ask(unsigned long request, Data& data) const {
        return ioctl(file_, request, &data) == 0;
    }

private:
    int file_;
};

// Returns 0 if the node can capture pictures, -1 if it is not a camera, otherwise the errno.
int why_not(const std::string& node, const CaptureSettings& settings) {
    const Questions camera(node);
    if (!camera.is_open()) return errno;
    v4l2_capability about{};
    if (!camera.ask(VIDIOC_QUERYCAP, about)) return errno == ENOTTY || errno == EINVAL ? -1 : errno;
    const unsigned can = (about.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? about.device_caps : about.capabilities;
    // A USB camera has a second node for metadata, and a Raspberry Pi has nodes for its codecs.
    if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) return -1;
    // A camera that another program is using refuses a new size.
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!camera.ask(VIDIOC_G_FMT, format)) return errno;
    format.fmt.pix.width = static_cast<unsigned>(settings.width);
    format.fmt.pix.height = static_cast<unsigned>(settings.height);
    return camera.ask(VIDIOC_S_FMT, format) ? 0 : errno;
}

CaptureSettings capture_settings(const CameraSettings& settings) {
    return {.width = settings.width,
            .height = settings.height,
            .frame_rate = settings.frame_rate,
            .color = settings.color,
            .raw_intrinsics = settings.raw_intrinsics(),
            .pixel_format = settings.pixel_format,
            .undistort = settings.undistort && settings.raw_intrinsics() != settings.intrinsics()};
}

}  // namespace

VideoCamera::VideoCamera(std::string dev, const CameraSettings& settings, OpenCapture open)
    : dev_(std::move(dev)),
      wanted_(under_dev(dev_, settings.device)),
      open_(std::move(open)),
      settings_(capture_settings(settings)),
      alive_at_(clock_seconds()) {}

std::optional<double> VideoCamera::look(double now) {
    if (now - alive_at_ > slowest_opening)
        health_.lost(fmt::format("no answer for {} s: unplug it and plug it in again", slowest_opening));
    const std::lock_guard lock(mutex_);
    if (newest_at_) std::swap(newest_, looked_at_);
    return std::exchange(newest_at_, std::nullopt);
}

tl::expected<void, std::string> VideoCamera::find() {
    std::string why = fmt::format("none is connected: there is none in {}", dev_);
    for (const std::string& node : wanted_.empty() ? numbered_nodes(dev_, "video") : std::vector{wanted_}) {
        const int code = why_not(node, settings_);
        if (code == 0) {
            auto capture = open_(node, settings_);
            if (!capture) return tl::unexpected(capture.error());
            capture_ = std::move(*capture);
            node_ = node;
            frame_at_ = clock_seconds();
            return {};
        }
        if (code > 0) {
            why = with_camera_advice({node, code});
        } else if (!wanted_.empty()) {
            why = node + " is not a camera: it can't take pictures";
        }
    }
    return tl::unexpected(why);
}

void VideoCamera::close(const std::string& why) {
    capture_.reset();
    health_.lost(why);
}

// True if the frame at `tm` is used. A camera may be faster than requested; then some frames are skipped.
bool VideoCamera::is_due(double tm) {
    const double period = 1 / settings_.frame_rate;
    if (tm < due_ - early * period && due_ - tm < 2 * period) return false;
    due_ = std::max(due_, tm - period) + period;
    if (due_ - tm > 2 * period) due_ = tm + period;  // the camera's clock was set back
    return true;
}

void VideoCamera::take_frame() {
    const double now = clock_seconds();
    frame_at_ = now;
    double tm = capture_->frame_time();
    if (!(tm > now - oldest_frame && tm <= now)) tm = now;
    if (!is_due(tm) || !capture_->take(filled_)) return;
    health_.works();
    const std::lock_guard lock(mutex_);
    std::swap(newest_, filled_);
    newest_at_ = tm;
}

double VideoCamera::run() {
    alive_at_ = clock_seconds();
    if (capture_ == nullptr) {
        if (const auto found = find(); !found) {
            health_.lost(found.error());
            return search_period;
        }
    }
    switch (capture_->wait(waiting)) {
        case Capture::Wait::frame: take_frame(); return 0;
        case Capture::Wait::failed: {
            const int code = why_not(node_, settings_);
            close(with_camera_advice({node_, code > 0 && code != EBUSY ? code : EIO}));
            return search_period;
        }
        case Capture::Wait::nothing: break;
    }
    if (clock_seconds() - frame_at_ < std::max(patience, 3 / settings_.frame_rate)) return 0;
    close(node_ + ": it sends no pictures: unplug it and plug it in again");
    return search_period;
}

namespace {

class WorkedCamera final : public CameraSource {
public:
    WorkedCamera(std::unique_ptr<VideoCamera> camera, CameraSettings settings)
        : settings_(std::move(settings)), camera_(std::move(camera)) {}

    CameraIntrinsics intrinsics() const override { return settings_.intrinsics(); }
    bool is_device() const override { return true; }
    std::optional<double> expose(const Time& now) override {
        const auto tm = camera_->look(clock_.look(now));
        return tm ? std::optional(clock_.system_time(now, *tm)) : std::nullopt;
    }
    void develop(CameraImage& image) override {
        image.width = static_cast<std::uint16_t>(settings_.width);
        image.height = static_cast<std::uint16_t>(settings_.height);
        image.bpp = settings_.color ? 24 : 8;
        image.format = settings_.color ? "rgb8" : "gray8";
        image.fDiv = 1;
        camera_->give(image.pixels);
    }
    std::vector<std::string> take_faults() override { return camera_->take_faults(); }

private:
    const CameraSettings settings_;
    TickClock clock_;
    RunningJob<VideoCamera> camera_;
};

}  // namespace

std::unique_ptr<CameraSource> open_camera(const std::string& dev, const CameraSettings& settings, OpenCapture open) {
    return std::make_unique<WorkedCamera>(std::make_unique<VideoCamera>(dev, settings, std::move(open)), settings);
}

}  // namespace nezumi::hw
