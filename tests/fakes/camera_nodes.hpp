// The node of a camera as Video4Linux has it, video0: formats, buffers that are mapped, one that streams.
#pragma once

#include <linux/videodev2.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"
#include "tests/fakes/served_files.hpp"

namespace nezumi::fakes {

/// A USB camera that gives YUYV of three sizes. Its programs don't block: what is not there yet is EAGAIN, and poll(2)
/// tells when it is.
class CameraNodes : public ServedFiles {
public:
    static constexpr const char* node = "video0";

    std::vector<std::string> names() const override;
    int look(const std::string& name) override;
    int open(const std::string& name, std::uint64_t& handle) override;
    void close(const std::string& name, std::uint64_t handle) override;
    int read(const std::string& name, std::uint64_t handle, std::string& text) override;
    int write(const std::string& name, std::uint64_t handle, std::string_view text) override;
    bool is_stream(const std::string& /*name*/) const override { return true; }
    unsigned poll(const std::string& name, std::uint64_t handle, std::function<void()> again) override;
    int control(const std::string& name, std::uint64_t handle, unsigned request, void* data) override;
    std::size_t mapped_size(const std::string& name) const override;
    void read_mapped(const std::string& name, std::size_t from, std::size_t size, char* bytes) override;
    void tell_changes(std::function<void(const std::string& name)> changed) override;

    /// How a picture is to be, and how many a second; nothing while nobody streams.
    struct Wanted {
        int width = 0;
        int height = 0;
        double frame_rate = 0;
    };
    std::optional<Wanted> wanted() const;
    /// A picture, "rgb8", of the size that is wanted, exposed at `tm` [s] of the monotonic clock. Nobody gets it when
    /// no buffer waits.
    void give(const CameraImage& image, double tm);

    void unplug();
    void plug_in();
    /// "none", "denied" (EACCES), "busy" (another program streams), "eio", "enodev", "hang", "silent" (no pictures),
    /// "torn" (half of each picture is the one before, and its buffer says so), "small" (it has one size, 160 x 120).
    /// False for another one.
    bool set_fault(const std::string& fault);

private:
    struct Buffer {
        enum class State { idle, queued, done } state = State::idle;
        std::vector<std::uint8_t> bytes{};
        v4l2_buffer info{};
    };
    struct Client {
        int plugged_in = 0;  // when it was opened
        std::vector<std::function<void()>> waiting{};
    };
    int enter(std::unique_lock<std::mutex>& lock, std::uint64_t handle);
    int answer(std::uint64_t handle, unsigned request, void* data);
    int set_format(v4l2_format& format, bool keep);
    int make_buffers(std::uint64_t handle, v4l2_requestbuffers& request);
    int queue(const v4l2_buffer& buffer);
    int dequeue(v4l2_buffer& buffer);
    v4l2_buffer info_of(std::size_t index) const;
    std::size_t stride() const;  // of the buffers in the file
    void stop();
    void wake();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::uint64_t, Client> clients_;
    std::uint64_t next_handle_ = 1, owner_ = 0;  // owner_: who has the buffers; 0: nobody
    int width_ = 640, height_ = 480;
    unsigned frame_rate_ = 30, sequence_ = 0;
    bool streams_ = false;
    std::vector<Buffer> buffers_;
    std::vector<std::size_t> queued_, done_;  // indices, oldest first
    std::function<void(const std::string& name)> tell_;
    int plugged_in_ = 1;
    bool is_there_ = true;
    std::string fault_ = "none";
};

}  // namespace nezumi::fakes
