// Reads, cuts messages and stamps them; looks for the device again after a loss.
#include "hw/wire/wire_link.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <deque>
#include <optional>
#include <utility>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/health.hpp"
#include "hw/device/node.hpp"
#include "hw/device/sampler.hpp"
#include "hw/device/tick_clock.hpp"
#include "hw/device/worker.hpp"
#include "hw/wire/device_writer.hpp"
#include "hw/wire/endpoint.hpp"
#include "hw/wire/framing.hpp"

namespace nezumi::hw {
namespace {

using Open = std::function<Opened()>;

struct Arrived {
    double tm;  // [s] by `clock_seconds`
    std::string bytes;
};

// What the reading thread and the control loop share.
class WireJob final : public DeviceJob {
public:
    WireJob(std::string name, Open open, Framing framing, std::string safe, std::shared_ptr<DeviceWriter> writer)
        : health_(std::move(name)),
          open_(std::move(open)),
          framer_(std::move(framing)),
          safe_(std::move(safe)),
          writer_(std::move(writer)) {}

    // Nothing, or why the device can't be used.
    tl::expected<void, std::string> try_open() {
        auto opened = open_();
        if (!opened) return tl::unexpected(opened.error());
        framer_.clear();
        const int problem = writer_->give({.file = (*opened)->file,
                                           .is_plain = (*opened)->is_plain,
                                           .is_datagram = (*opened)->is_datagram,
                                           .end = framer_.end(),
                                           .safe = safe_});
        if (problem != 0) return tl::unexpected(std::string("no process that writes: ") + std::strerror(problem));
        wire_ = std::move(*opened);
        is_open_ = true;
        return {};
    }

    double run() override {
        if (is_lost_.exchange(false)) lose(lost_by_);
        if (must_stop_.exchange(false) && wire_ != nullptr) stop();
        if (wire_ == nullptr) {
            if (const auto ok = try_open(); !ok) {
                health_.lost(ok.error());
                return retry_period;
            }
            health_.works();
        }
        if (!wire_->is_plain) read();
        return wire_ == nullptr ? retry_period : quiet;
    }
    int watched_file() const override { return wire_ == nullptr || wire_->is_plain ? -1 : wire_->file; }
    void end() override { wire_.reset(); }

    // The writer says that the device is gone. Called by the control loop.
    void note_lost(int error) {
        lost_by_ = error;
        is_lost_ = true;
        is_open_ = false;
    }
    // The writer has ended: this thread sends the safe bytes.
    void stop_soon() { must_stop_ = true; }
    bool is_open() const { return is_open_; }
    std::deque<Arrived> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(arrived_, {});
    }
    std::vector<std::string> take_faults() { return health_.take(); }
    Health& health() { return health_; }
    std::optional<std::string> encode(std::string_view message) const { return framer_.encode(message); }

private:
    static constexpr double quiet = 0.5;  // [s] between looks at a device that sends nothing

    void lose(int error) {
        is_open_ = false;
        wire_.reset();
        health_.lost(error == 0 ? "it was unplugged" : describe(NodeError{"it", error}));
    }

    void stop() const {
        const std::string text = framer_.end() + safe_;
        if (!safe_.empty() && write(wire_->file, text.data(), text.size()) < 0) return;
    }

    std::string without_end(std::string_view datagram) const {
        const std::string end = framer_.end();
        if (!end.empty() && datagram.ends_with(end)) datagram.remove_suffix(end.size());
        return std::string(datagram);
    }

    void read() {
        char buffer[4096];
        for (;;) {
            const ssize_t length = ::read(wire_->file, buffer, sizeof buffer);
            if (length < 0 && errno == EINTR) continue;
            if (length < 0 && (errno == EAGAIN || errno == ECONNREFUSED)) break;
            if (length <= 0 && !wire_->is_datagram) return lose(length == 0 || errno == EIO ? 0 : errno);
            if (length < 0) return lose(errno);
            const std::string_view bytes(buffer, static_cast<std::size_t>(length));
            put(wire_->is_datagram ? std::vector<std::string>{without_end(bytes)} : framer_.take(bytes));
            health_.works();
        }
    }

    void put(std::vector<std::string> messages) {
        const double now = clock_seconds();
        const std::lock_guard lock(mutex_);
        for (std::string& message : messages) arrived_.push_back({now, std::move(message)});
        while (arrived_.size() > WiredDevice::queue) arrived_.pop_front();
    }

    Health health_;
    const Open open_;
    Framer framer_;
    const std::string safe_;
    std::shared_ptr<DeviceWriter> writer_;  // shared with the link: this thread may hang in the device
    std::unique_ptr<OpenWire> wire_;
    std::atomic<bool> is_open_ = false, is_lost_ = false, must_stop_ = false;
    std::atomic<int> lost_by_ = 0;
    Mutex mutex_;  // held only for a copy
    std::deque<Arrived> arrived_;
};

class WireLink final : public DeviceLink {
public:
    WireLink(const std::string& name, std::unique_ptr<WireJob> job, std::shared_ptr<DeviceWriter> writer)
        : writer_(std::move(writer)), encoder_(*job), guard_health_(name), job_(std::move(job)) {}

    std::vector<Message> take(const Time& now) override {
        clock_.look(now);
        std::vector<Message> messages;
        for (Arrived& each : job_->take())
            messages.push_back({clock_.system_time(now, each.tm), std::move(each.bytes)});
        while (const auto answer = writer_->take_answer()) {
            if (answer->kind == WriterAnswer::Kind::lost) {
                job_->note_lost(answer->error);
                job_.wake();
            } else if (answer->kind == WriterAnswer::Kind::stopped) {
                guard_health_.lost(fmt::format(
                    "its safe bytes were sent, as nothing came from the control loop for {} s", beat_timeout));
            } else {
                guard_health_.lost("it takes messages more slowly than they come: the oldest are dropped");
            }
        }
        if (writer_->has_ended()) {
            if (!std::exchange(has_stopped_, true)) {
                job_->stop_soon();
                job_.wake();
            }
            guard_health_.lost("the process that writes to it has ended: start the run again");
        } else {
            guard_health_.works();
        }
        return messages;
    }
    void send(std::string_view bytes) override {
        const auto encoded = encoder_.encode(bytes);
        if (encoded && encoded->size() <= longest_message) {
            writer_->send(*encoded);
        } else {
            guard_health_.lost(fmt::format("a message of {} bytes does not fit: it was dropped", bytes.size()));
        }
    }
    void beat() override { writer_->beat(clock_seconds()); }
    void stop() override { writer_->stop(); }
    bool works() const override { return job_->is_open() && !writer_->has_ended(); }
    std::vector<std::string> take_faults() override {
        std::vector<std::string> all = job_->take_faults();
        append(all, guard_health_.take());
        return all;
    }

private:
    TickClock clock_;
    std::shared_ptr<DeviceWriter> writer_;
    const WireJob& encoder_;
    Health guard_health_;
    bool has_stopped_ = false;  // after the end of the writer
    RunningJob<WireJob> job_;
};

Framing framing_of(const Parameters& parameters) {
    const auto text = [&](std::string_view name) {
        const auto* found = parameters.find(name);
        return found == nullptr ? std::string() : found->value.get<std::string>();
    };
    Framing framing;
    framing.end = text("terminator");
    if (const auto* length = parameters.find("length"))
        framing.length = static_cast<std::size_t>(length->value.get<std::int64_t>());
    if (const auto* cobs = parameters.find("cobs")) framing.cobs = cobs->value.get<bool>();
    return framing;
}

}  // namespace

Expected<std::unique_ptr<DeviceLink>> open_wire(const std::string& type, const std::string& name,
                                                const Parameters& parameters, const DeviceRoots& roots) {
    if (!roots.files->are_real()) return failure("a device log has no messages of such devices: it can't be replayed");
    const auto safe = parameters.find("safe")->value.get<std::string>();
    const Open open = [type, parameters, roots] {
        return type == "Udp" ? open_udp(parameters, roots) : open_serial(parameters, roots);
    };
    Framing framing = framing_of(parameters);
    const std::string ends = parameters.find("ends")->value.get<std::string>();
    const int ways =
        (framing.end.empty() ? 0 : 1) + (framing.length > 0 ? 1 : 0) + (framing.cobs ? 1 : 0) + (ends.empty() ? 0 : 1);
    if (ways > 1) return failure("ends, terminator, length and cobs: expected only one of them");
    const bool is_line = !ends.empty();
    if (is_line) framing.end = ends;
    // First looks whether it is there, and what it is; only then takes it.
    if (const auto there = open(); !there && !safe.empty()) return failure(there.error());
    const std::string node = lease_of(type, parameters, roots);
    auto lease = node.empty() ? Lease::of_nothing() : Lease::take("wire " + node, node);
    if (!lease) return Unexpected(lease.error());
    auto writer = DeviceWriter::start(std::move(*lease));
    if (!writer) return Unexpected(writer.error());
    std::shared_ptr<DeviceWriter> shared = std::move(*writer);
    auto job = std::make_unique<WireJob>(name, open, std::move(framing), safe, shared);
    if (const auto opened = job->try_open(); !opened && !safe.empty()) return failure(opened.error());
    return std::make_unique<WireLink>(name, std::move(job), std::move(shared));
}

}  // namespace nezumi::hw
