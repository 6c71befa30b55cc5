// Reads a device, stamps its messages, and searches for the device again after a loss.
#include "hw/wire/wire_link.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstring>
#include <deque>
#include <utility>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/health.hpp"
#include "hw/device/sampler.hpp"
#include "hw/device/tick_clock.hpp"
#include "hw/device/worker.hpp"
#include "hw/wire/device_writer.hpp"

namespace nezumi::hw {
namespace {

using Driver = std::shared_ptr<const WireDriver>;

// The job of the reading thread, which the control loop shares.
class WireJob final : public DeviceJob {
public:
    WireJob(Driver driver, std::string safe, std::shared_ptr<DeviceWriter> writer)
        : driver_(std::move(driver)), safe_(std::move(safe)), writer_(std::move(writer)) {}

    // Opens the device. An error says why it can't be used.
    tl::expected<void, std::string> try_open() {
        auto opened = driver_->open();
        if (!opened) return tl::unexpected(opened.error());
        const int problem = writer_->give((*opened)->target(), driver_->end(), safe_);
        if (problem != 0)
            return tl::unexpected(std::string("can't give it to the process that writes: ") + std::strerror(problem));
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
        return read();
    }
    int watched_file() const override { return wire_ == nullptr ? -1 : wire_->watched_file(); }
    void end() override { wire_.reset(); }

    // Called by the control loop when the writer reports that the device is lost.
    void note_lost(int error) {
        lost_by_ = error;
        is_lost_ = true;
        is_open_ = false;
    }
    // Called when the writer has ended: then this thread sends the safe bytes instead.
    void stop_soon() { must_stop_ = true; }
    bool is_open() const { return is_open_; }
    std::deque<Arrived> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(arrived_, {});
    }
    std::vector<std::string> take_faults() { return health_.take(); }

private:
    void lose(int error) {
        is_open_ = false;
        writer_->release();
        wire_.reset();
        health_.lost(driver_->why_lost(error));
    }

    void stop() const {
        const std::string text = driver_->end() + safe_;
        if (!safe_.empty() && write_message(wire_->target(), text.data(), text.size()) < 0) return;
    }

    double read() {
        std::vector<Arrived> messages;
        const auto next = wire_->read(messages);
        if (!messages.empty()) {
            health_.works();
            put(std::move(messages));
        }
        if (next) return *next;
        lose(next.error());
        return retry_period;
    }

    void put(std::vector<Arrived> messages) {
        const std::lock_guard lock(mutex_);
        for (Arrived& message : messages) arrived_.push_back(std::move(message));
        while (arrived_.size() > WiredDevice::queue) arrived_.pop_front();
    }

    Health health_{""};
    const Driver driver_;
    const std::string safe_;
    std::shared_ptr<DeviceWriter> writer_;  // shared with the link: this thread may hang in the device
    std::unique_ptr<OpenWire> wire_;        // null: the device is lost
    std::atomic<bool> is_open_ = false, is_lost_ = false, must_stop_ = false;
    std::atomic<int> lost_by_ = 0;
    Mutex mutex_;  // held only for a copy
    std::deque<Arrived> arrived_;
};

class WireLink final : public DeviceLink {
public:
    WireLink(Driver driver, std::unique_ptr<WireJob> job, std::shared_ptr<DeviceWriter> writer)
        : driver_(std::move(driver)), writer_(std::move(writer)), job_(std::move(job)) {}

    std::vector<Message> take(const Time& now) override {
        clock_.look(now);
        std::vector<Message> messages;
        for (Arrived& each : job_->take()) {
            if (driver_->has_times()) each.bytes += fmt::format(" {:.6f}", clock_.exact_time(each.tm));
            messages.push_back({clock_.system_time(now, each.tm), std::move(each.bytes)});
        }
        while (auto taken = writer_->take_answer()) {
            auto& [answer, bytes] = *taken;
            if (answer.kind == WriterAnswer::Kind::answer) {
                messages.push_back({clock_.system_time(now, answer.tm), std::move(bytes)});
            } else if (answer.kind == WriterAnswer::Kind::lost) {
                job_->note_lost(answer.error);
                job_.wake();
            } else if (answer.kind == WriterAnswer::Kind::stopped) {
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
        } else if (job_->hangs(clock_seconds())) {
            guard_health_.lost(no_answer);
        } else {
            guard_health_.works();
        }
        return messages;
    }
    void send(std::string_view bytes) override {
        const auto encoded = driver_->encode(bytes);
        if (encoded && encoded->size() <= longest_message) return writer_->send(*encoded);
        guard_health_.lost(
            fmt::format("a message of {} bytes was dropped: {}", bytes.size(),
                        encoded ? fmt::format("expected at most {}", longest_message) : encoded.error()));
    }
    void beat() override { writer_->beat(clock_seconds()); }
    void stop() override { writer_->stop(); }
    bool works() const override { return job_->is_open() && !writer_->has_ended() && !job_->hangs(clock_seconds()); }
    std::vector<std::string> take_faults() override {
        std::vector<std::string> all = job_->take_faults();
        append(all, guard_health_.take());
        return all;
    }

private:
    TickClock clock_;
    const Driver driver_;
    std::shared_ptr<DeviceWriter> writer_;
    Health guard_health_{""};
    bool has_stopped_ = false;  // after the end of the writer
    RunningJob<WireJob> job_;
};

}  // namespace

Expected<std::unique_ptr<DeviceLink>> open_wire(MakeWireDriver make, const Parameters& parameters,
                                                const DeviceRoots& roots) {
    if (!roots.files->are_real())
        return failure("can't replay this device: a device log has no messages of Serial, Udp, I2c, Spi and Gpio");
    auto made = make(parameters, roots);
    if (!made) return failure(made.error());
    const Driver driver = std::move(*made);
    const std::string safe = driver->encode_safe(value_of<std::string>(parameters, "safe"));
    // Opening may already stop the device, so another program must not be using it.
    auto lease = driver->lease();
    if (!lease) return Unexpected(lease.error());
    if (const auto there = driver->open(); !there && !safe.empty()) return failure(there.error());
    auto writer = DeviceWriter::start(std::move(*lease));
    if (!writer) return Unexpected(writer.error());
    std::shared_ptr<DeviceWriter> shared = std::move(*writer);
    auto job = std::make_unique<WireJob>(driver, safe, shared);
    if (const auto opened = job->try_open(); !opened && !safe.empty()) return failure(opened.error());
    return std::make_unique<WireLink>(driver, std::move(job), std::move(shared));
}

}  // namespace nezumi::hw
