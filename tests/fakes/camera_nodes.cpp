// Answers as a driver on the kernel's videobuf2: who has buffers owns the camera, who does not stream polls an error.
#include "tests/fakes/camera_nodes.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace nezumi::fakes {
namespace {

struct Size {
    int width, height;
};
constexpr std::array sizes{Size{640, 480}, Size{320, 240}, Size{160, 120}};
constexpr Size small = sizes.back();
constexpr std::size_t page = 4096;
constexpr std::size_t most_buffers = 8;
constexpr std::array rates{30U, 15U, 5U};

std::size_t bytes_of(int width, int height) { return 2 * static_cast<std::size_t>(width) * height; }

// BT.601, the range of a television's: weights of 256ths.
void to_yuyv(const CameraImage& image, std::vector<std::uint8_t>& yuyv) {
    yuyv.resize(bytes_of(image.width, image.height));
    const auto byte = [](int sum, int zero) { return static_cast<std::uint8_t>((sum + 128) / 256 + zero); };
    for (std::size_t i = 0; i + 3 < yuyv.size(); i += 4) {
        const std::uint8_t* p = &image.pixels[i / 2 * 3];
        yuyv[i] = byte(66 * p[0] + 129 * p[1] + 25 * p[2], 16);
        yuyv[i + 2] = byte(66 * p[3] + 129 * p[4] + 25 * p[5], 16);
        const int r = (p[0] + p[3]) / 2, g = (p[1] + p[4]) / 2, b = (p[2] + p[5]) / 2;
        yuyv[i + 1] = byte(-38 * r - 74 * g + 112 * b, 128);
        yuyv[i + 3] = byte(112 * r - 94 * g - 18 * b, 128);
    }
}

template <class Text>
void put(Text& field, const char* text) {
    std::strncpy(reinterpret_cast<char*>(field), text, sizeof field - 1);
}

}  // namespace

std::vector<std::string> CameraNodes::names() const {
    const std::lock_guard lock(mutex_);
    return is_there_ ? std::vector<std::string>{node} : std::vector<std::string>{};
}

int CameraNodes::look(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return is_there_ && name == node ? 0 : -ENOENT;
}

int CameraNodes::open(const std::string& name, std::uint64_t& handle) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return fault_ != "hang"; });
    if (!is_there_ || name != node) return -ENOENT;
    if (fault_ == "denied") return -EACCES;
    if (fault_ == "enodev") return -ENODEV;
    handle = next_handle_++;
    clients_[handle] = {.plugged_in = plugged_in_};
    return 0;
}

void CameraNodes::close(const std::string& /*name*/, std::uint64_t handle) {
    const std::lock_guard lock(mutex_);
    clients_.erase(handle);
    if (owner_ != handle) return;
    stop();
    buffers_.clear();
    owner_ = 0;
}

int CameraNodes::read(const std::string& /*name*/, std::uint64_t /*handle*/, std::string& /*text*/) { return -EINVAL; }
int CameraNodes::write(const std::string& /*name*/, std::uint64_t /*handle*/, std::string_view /*text*/) {
    return -EINVAL;
}

std::size_t CameraNodes::stride() const { return (bytes_of(sizes[0].width, sizes[0].height) + page - 1) / page * page; }

std::size_t CameraNodes::mapped_size(const std::string& /*name*/) const { return most_buffers * stride(); }

void CameraNodes::read_mapped(const std::string& /*name*/, std::size_t from, std::size_t size, char* bytes) {
    const std::lock_guard lock(mutex_);
    std::memset(bytes, 0, size);
    // The kernel reads around what it was asked for: the end of one buffer and the beginning of the next.
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const auto& all = buffers_[i].bytes;
        const std::size_t first = i * stride(), begin = std::max(first, from);
        const std::size_t end = std::min(first + all.size(), from + size);
        if (begin < end) std::memcpy(bytes + (begin - from), all.data() + (begin - first), end - begin);
    }
}

void CameraNodes::tell_changes(std::function<void(const std::string& name)> changed) {
    const std::lock_guard lock(mutex_);
    tell_ = std::move(changed);
}

int CameraNodes::enter(std::unique_lock<std::mutex>& lock, std::uint64_t handle) {
    changed_.wait(lock, [&] { return fault_ != "hang"; });
    if (!is_there_ || clients_[handle].plugged_in != plugged_in_ || fault_ == "enodev") return -ENODEV;
    return 0;
}

unsigned CameraNodes::poll(const std::string& /*name*/, std::uint64_t handle, std::function<void()> again) {
    std::unique_lock lock(mutex_);
    if (enter(lock, handle) != 0) return POLLERR | POLLHUP;
    if (again) clients_[handle].waiting.push_back(std::move(again));
    if (owner_ != handle || !streams_ || fault_ == "eio") return POLLERR;
    return done_.empty() ? 0 : POLLIN | POLLRDNORM;
}

void CameraNodes::wake() {
    for (auto& [handle, client] : clients_) {
        for (const auto& again : std::exchange(client.waiting, {})) again();
    }
}

int CameraNodes::control(const std::string& /*name*/, std::uint64_t handle, unsigned request, void* data) {
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, handle); error != 0) return error;
    const int result = answer(handle, request, data);
    const auto tell = tell_;
    lock.unlock();
    // What the kernel remembers of the pages is the picture that was in this buffer before.
    if (request == VIDIOC_DQBUF && result == 0 && tell) tell(node);
    return result;
}

int CameraNodes::set_format(v4l2_format& format, bool keep) {
    if (format.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return -EINVAL;
    Size nearest = small;
    if (fault_ != "small") {
        const auto distance = [&](const Size& size) {
            return std::abs(size.width - static_cast<int>(format.fmt.pix.width)) +
                   std::abs(size.height - static_cast<int>(format.fmt.pix.height));
        };
        nearest = *std::min_element(sizes.begin(), sizes.end(),
                                    [&](const Size& a, const Size& b) { return distance(a) < distance(b); });
    }
    if (keep) std::tie(width_, height_) = std::pair(nearest.width, nearest.height);
    v4l2_pix_format pixels{};
    pixels.width = static_cast<unsigned>(nearest.width);
    pixels.height = static_cast<unsigned>(nearest.height);
    pixels.pixelformat = V4L2_PIX_FMT_YUYV;
    pixels.field = V4L2_FIELD_NONE;
    pixels.bytesperline = 2 * pixels.width;
    pixels.sizeimage = static_cast<unsigned>(bytes_of(nearest.width, nearest.height));
    pixels.colorspace = V4L2_COLORSPACE_SRGB;
    format.fmt.pix = pixels;
    return 0;
}

int CameraNodes::make_buffers(std::uint64_t handle, v4l2_requestbuffers& request) {
    if (request.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || request.memory != V4L2_MEMORY_MMAP) return -EINVAL;
    if (streams_) return -EBUSY;
    request.count = std::min<unsigned>(request.count, most_buffers);
    request.capabilities = V4L2_BUF_CAP_SUPPORTS_MMAP;
    owner_ = request.count > 0 ? handle : 0;
    buffers_.assign(request.count, {});
    for (Buffer& buffer : buffers_) buffer.bytes.resize(bytes_of(width_, height_));
    return 0;
}

v4l2_buffer CameraNodes::info_of(std::size_t index) const {
    const Buffer& buffer = buffers_[index];
    v4l2_buffer info = buffer.info;
    info.index = static_cast<unsigned>(index);
    info.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    info.memory = V4L2_MEMORY_MMAP;
    info.field = V4L2_FIELD_NONE;
    info.length = static_cast<unsigned>(buffer.bytes.size());
    info.m.offset = static_cast<unsigned>(index * stride());
    info.flags |= V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    if (buffer.state == Buffer::State::queued) info.flags |= V4L2_BUF_FLAG_QUEUED;
    if (buffer.state == Buffer::State::done) info.flags |= V4L2_BUF_FLAG_DONE;
    return info;
}

int CameraNodes::queue(const v4l2_buffer& buffer) {
    if (buffer.index >= buffers_.size() || buffers_[buffer.index].state != Buffer::State::idle) return -EINVAL;
    buffers_[buffer.index].state = Buffer::State::queued;
    queued_.push_back(buffer.index);
    return 0;
}

int CameraNodes::dequeue(v4l2_buffer& buffer) {
    if (fault_ == "eio") return -EIO;
    if (!streams_) return -EINVAL;
    if (done_.empty()) return -EAGAIN;
    const std::size_t index = done_.front();
    done_.erase(done_.begin());
    buffers_[index].state = Buffer::State::idle;
    buffer = info_of(index);
    return 0;
}

void CameraNodes::stop() {
    streams_ = false;
    queued_.clear();
    done_.clear();
    for (Buffer& buffer : buffers_) buffer.state = Buffer::State::idle;
    wake();
}

int CameraNodes::answer(std::uint64_t handle, unsigned request, void* data) {
    const bool is_others = owner_ != 0 && owner_ != handle;
    const bool is_busy = is_others || fault_ == "busy";
    switch (request) {
        case VIDIOC_QUERYCAP: {
            auto& about = *static_cast<v4l2_capability*>(data);
            about = {};
            put(about.driver, "uvcvideo");
            put(about.card, "Plain Camera");
            put(about.bus_info, "usb-0000:01:00.0-1.2");
            about.version = 0x060100;
            about.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            about.capabilities = about.device_caps | V4L2_CAP_DEVICE_CAPS;
            return 0;
        }
        case VIDIOC_ENUM_FMT: {
            auto& format = *static_cast<v4l2_fmtdesc*>(data);
            if (format.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || format.index > 0) return -EINVAL;
            put(format.description, "YUYV 4:2:2");
            format.pixelformat = V4L2_PIX_FMT_YUYV;
            return 0;
        }
        case VIDIOC_ENUM_FRAMESIZES: {
            auto& size = *static_cast<v4l2_frmsizeenum*>(data);
            if (size.pixel_format != V4L2_PIX_FMT_YUYV || size.index >= sizes.size()) return -EINVAL;
            size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
            size.discrete = {static_cast<unsigned>(sizes[size.index].width),
                             static_cast<unsigned>(sizes[size.index].height)};
            return 0;
        }
        case VIDIOC_ENUM_FRAMEINTERVALS: {
            auto& interval = *static_cast<v4l2_frmivalenum*>(data);
            if (interval.pixel_format != V4L2_PIX_FMT_YUYV || interval.index >= rates.size()) return -EINVAL;
            interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
            interval.discrete = {1, rates[interval.index]};
            return 0;
        }
        case VIDIOC_G_FMT: {
            auto& format = *static_cast<v4l2_format*>(data);
            format.fmt.pix.width = static_cast<unsigned>(width_);
            format.fmt.pix.height = static_cast<unsigned>(height_);
            return set_format(format, false);
        }
        case VIDIOC_TRY_FMT: return set_format(*static_cast<v4l2_format*>(data), false);
        case VIDIOC_S_FMT:
            return is_busy || !buffers_.empty() ? -EBUSY : set_format(*static_cast<v4l2_format*>(data), true);
        case VIDIOC_S_PARM:
        case VIDIOC_G_PARM: {
            auto& parameters = *static_cast<v4l2_streamparm*>(data);
            if (parameters.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return -EINVAL;
            v4l2_captureparm& capture = parameters.parm.capture;
            if (request == VIDIOC_S_PARM && capture.timeperframe.numerator > 0) {
                const double asked = 1.0 * capture.timeperframe.denominator / capture.timeperframe.numerator;
                frame_rate_ = *std::min_element(rates.begin(), rates.end(), [&](unsigned a, unsigned b) {
                    return std::abs(a - asked) < std::abs(b - asked);
                });
            }
            capture = {};
            capture.capability = V4L2_CAP_TIMEPERFRAME;
            capture.timeperframe = {1, frame_rate_};
            capture.readbuffers = 2;
            return 0;
        }
        case VIDIOC_ENUMINPUT: {
            auto& input = *static_cast<v4l2_input*>(data);
            if (input.index > 0) return -EINVAL;
            input = {};
            put(input.name, "Camera 1");
            input.type = V4L2_INPUT_TYPE_CAMERA;
            return 0;
        }
        case VIDIOC_G_INPUT: *static_cast<int*>(data) = 0; return 0;
        case VIDIOC_S_INPUT: return *static_cast<int*>(data) == 0 ? 0 : -EINVAL;
        case VIDIOC_REQBUFS: return is_busy ? -EBUSY : make_buffers(handle, *static_cast<v4l2_requestbuffers*>(data));
        case VIDIOC_QUERYBUF: {
            auto& buffer = *static_cast<v4l2_buffer*>(data);
            if (buffer.index >= buffers_.size()) return -EINVAL;
            buffer = info_of(buffer.index);
            return 0;
        }
        case VIDIOC_QBUF: return is_busy ? -EBUSY : queue(*static_cast<v4l2_buffer*>(data));
        case VIDIOC_DQBUF: return is_busy ? -EBUSY : dequeue(*static_cast<v4l2_buffer*>(data));
        case VIDIOC_STREAMON:
            if (is_busy) return -EBUSY;
            if (buffers_.empty()) return -EINVAL;
            streams_ = true;
            return 0;
        case VIDIOC_STREAMOFF:
            if (is_others) return -EBUSY;
            stop();
            return 0;
        case VIDIOC_QUERYCTRL:
        case VIDIOC_G_CTRL:
        case VIDIOC_S_CTRL: return -EINVAL;
        default: return -ENOTTY;
    }
}

std::optional<CameraNodes::Wanted> CameraNodes::wanted() const {
    const std::lock_guard lock(mutex_);
    if (!streams_) return std::nullopt;
    return Wanted{.width = width_, .height = height_, .frame_rate = static_cast<double>(frame_rate_)};
}

void CameraNodes::give(const CameraImage& image, double tm) {
    std::vector<std::uint8_t> bytes;
    to_yuyv(image, bytes);
    const std::lock_guard lock(mutex_);
    if (!is_there_ || !streams_ || image.width != width_ || fault_ == "silent" || fault_ == "hang") return;
    ++sequence_;
    if (queued_.empty()) return;
    const std::size_t index = queued_.front();
    queued_.erase(queued_.begin());
    Buffer& buffer = buffers_[index];
    const std::size_t whole = bytes.size(), there = fault_ == "torn" ? whole / 2 : whole;
    std::copy_n(bytes.begin(), there, buffer.bytes.begin());
    buffer.state = Buffer::State::done;
    buffer.info = {};
    buffer.info.bytesused = static_cast<unsigned>(there);
    if (there < whole) buffer.info.flags = V4L2_BUF_FLAG_ERROR;
    buffer.info.sequence = sequence_;
    buffer.info.timestamp.tv_sec = static_cast<time_t>(tm);
    buffer.info.timestamp.tv_usec = static_cast<suseconds_t>((tm - std::floor(tm)) * 1e6);
    done_.push_back(index);
    wake();
}

void CameraNodes::unplug() {
    const std::lock_guard lock(mutex_);
    is_there_ = false;
    wake();
}

void CameraNodes::plug_in() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_there_, true)) return;
    ++plugged_in_;
    stop();
    buffers_.clear();
    owner_ = 0;
}

bool CameraNodes::set_fault(const std::string& fault) {
    const std::lock_guard lock(mutex_);
    constexpr std::array known{"none", "denied", "busy", "eio", "enodev", "hang", "silent", "torn", "small"};
    if (std::find(known.begin(), known.end(), fault) == known.end()) return false;
    fault_ = fault;
    changed_.notify_all();
    wake();
    return true;
}

}  // namespace nezumi::fakes
