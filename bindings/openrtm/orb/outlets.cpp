// Sends an out-port's messages. When a connection ends, sends velocity 0 to a robot at the other end and gives it time
// to receive that.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <utility>

#include "bindings/openrtm/orb/caller.hpp"
#include "bindings/openrtm/orb/peer_calls.hpp"
#include "bindings/openrtm/orb/servants.hpp"
#include "bindings/openrtm/orb/velocity_bytes.hpp"

namespace nezumi::openrtm {
namespace {

using Seconds = std::chrono::duration<double>;

// Messages to an RTC wait in the connection's buffer, which is deleted with the connection. The RTC reads the buffer at
// its next execution, so we wait for two of its periods. The waiting time [s]: default, minimum, maximum.
constexpr double periods_to_read = 2;
constexpr Seconds usual_time_to_read{0.3}, least_time_to_read{0.05}, most_time_to_read{1};
// The time until the velocity 0 is sent again to a peer with a full buffer.
constexpr std::chrono::milliseconds retry_period{10};

Clock::duration clock_time(Seconds seconds) { return std::chrono::duration_cast<Clock::duration>(seconds); }

Clock::duration time_to_read(RTC::PortService_ptr peer) {
    const double rate = execution_rate(peer);
    if (!(rate > 0)) return clock_time(usual_time_to_read);
    return clock_time(std::clamp(Seconds(periods_to_read / rate), least_time_to_read, most_time_to_read));
}

std::size_t capacity_for(const Terms& terms) {
    return terms.subscription == Terms::Subscription::flush || terms.keeps_all ? most_waiting : 1;
}

class OutPortObject final : public POA_OpenRTM::OutPortCdr {
public:
    explicit OutPortObject(bool of_velocities) : queue_(most_waiting, of_velocities) {}
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override {
        OpenRTM::CdrData_var answer = new OpenRTM::CdrData;
        Bytes message;
        const bool is_there = queue_.take(message);
        answer->length(static_cast<CORBA::ULong>(message.size()));
        std::copy(message.begin(), message.end(), answer->get_buffer());
        data = answer._retn();
        return is_there ? OpenRTM::PORT_OK : OpenRTM::BUFFER_EMPTY;
    }
    MessageQueue& queue() { return queue_; }

private:
    MessageQueue queue_;
};

// The peer fetches messages. It needs no time to use a fetched message, because it fetches while it executes.
class PullOutlet final : public Connector {
public:
    PullOutlet(CORBA::ORB_ptr orb, bool of_velocities)
        : object_(new OutPortObject(of_velocities)),
          of_velocities_(of_velocities),
          reference_(reference_of(orb, *object_.in())) {}
    ~PullOutlet() override { deactivate(*object_.in()); }
    PullOutlet(const PullOutlet&) = delete;
    PullOutlet& operator=(const PullOutlet&) = delete;
    void publish(std::span<const std::uint8_t> bytes) override { object_->queue().put(bytes); }
    void stop() override { object_->queue().stop(); }
    bool is_settled() override { return !of_velocities_ || object_->queue().is_done(); }
    std::string reference() const override { return reference_; }

private:
    PortableServer::Servant_var<OutPortObject> object_;
    const bool of_velocities_;
    std::string reference_;
};

class PushOutlet final : public Caller {
public:
    PushOutlet(OpenRTM::InPortCdr_ptr peer, RtcOutlet outlet, const Terms& terms)
        : Caller(capacity_for(terms), outlet.of_velocities),
          outlet_(std::move(outlet)),
          terms_(terms),
          peer_(OpenRTM::InPortCdr::_duplicate(peer)) {
        start([this] { run(); });
    }
    ~PushOutlet() override { end(); }
    PushOutlet(const PushOutlet&) = delete;
    PushOutlet& operator=(const PushOutlet&) = delete;
    void publish(std::span<const std::uint8_t> bytes) override {
        if (!lost_) queue_.put(bytes);
    }
    void stop() override { queue_.stop(); }
    bool is_settled() override { return lost_ || settled_ || !outlet_.of_velocities; }

private:
    void run() {
        Bytes message;
        while (!lost_ && next(message)) send(message);
        if (taken_at_ && outlet_.of_velocities) queue_.rest_until(*taken_at_ + time_to_read(outlet_.peer));
        settled_ = true;
    }
    bool next(Bytes& message) {
        if (terms_.subscription != Terms::Subscription::periodic) return queue_.wait(message);
        while (queue_.wait_until(next_)) {
            next_ = std::max(next_ + clock_time(Seconds(1 / terms_.rate)), Clock::now());
            if (queue_.take(message)) return true;
            if (queue_.is_done()) return false;
        }
        return false;
    }
    void send(const Bytes& message) {
        const auto size = static_cast<CORBA::ULong>(message.size());
        // The const_cast is safe: the called stub only reads its argument.
        const OpenRTM::CdrData data(size, size, const_cast<std::uint8_t*>(message.data()), false);
        const OpenRTM::PortStatus status = ask([&] { return peer_->put(data); });
        taken_at_.reset();
        if (status == OpenRTM::PORT_OK) taken_at_ = Clock::now();
        const bool was_late = status == OpenRTM::BUFFER_FULL || status == OpenRTM::BUFFER_TIMEOUT;
        if (!was_late || !outlet_.of_velocities || is_motion(message)) return;
        queue_.put_back(message);
        queue_.rest_until(Clock::now() + retry_period);
    }

    const RtcOutlet outlet_;
    const Terms terms_;
    OpenRTM::InPortCdr_var peer_;
    // Used only by the thread:
    Clock::time_point next_ = Clock::now();      // time of the next periodic message
    std::optional<Clock::time_point> taken_at_;  // when the peer accepted the last message
    std::atomic<bool> settled_ = false;
};

}  // namespace

std::unique_ptr<Connector> make_pull_outlet(CORBA::ORB_ptr orb, const RtcOutlet& outlet) {
    return std::make_unique<PullOutlet>(orb, outlet.of_velocities);
}

std::unique_ptr<Connector> make_push_outlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcOutlet& outlet,
                                            const Terms& terms) {
    const OpenRTM::InPortCdr_var peer = peer_of<OpenRTM::InPortCdr>(orb, reference);
    if (CORBA::is_nil(peer)) return nullptr;
    return std::make_unique<PushOutlet>(peer.in(), outlet, terms);
}

}  // namespace nezumi::openrtm
