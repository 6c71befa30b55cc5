// Receives messages for an in-port. Repeated messages are dropped: an RTC that has stopped executing repeats its last
// one forever, from its empty buffer (`readback`) or from its periodic publisher (`periodic`), and a robot must not
// continue with that.
#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "bindings/openrtm/orb/caller.hpp"
#include "bindings/openrtm/orb/servants.hpp"
#include "bindings/openrtm/orb/velocity_bytes.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {
namespace {

// The time between two fetches from a peer.
constexpr std::chrono::milliseconds fetch_period{10};

// Recognises a repeated message: stamp and content equal those of the one before.
class Repeats {
public:
    explicit Repeats(const RtcInlet& inlet) : inlet_(inlet) {}

    /// True if the message equals the one before.
    bool is_repeat(const Bytes& message) {
        const bool is_one = message == last_;
        if (!is_one) last_ = message;
        return is_one;
    }
    /// Reports once that velocities without a stamp were dropped: such a message may have been new, not a repetition.
    void dropped(const Bytes& message) {
        if (told_ || !inlet_.of_velocities || is_stamped(message) || !is_motion(message)) return;
        told_ = true;
        inlet_.site.tell(true,
                         "rtm: " + inlet_.path + ": " + inlet_.from +
                             " repeats a velocity without a stamp: it counts once, and the robot stops after 0.5 s; "
                             "stamp what the RTC writes, or connect it with dataflow_type push and "
                             "subscription_type flush or new");
    }

private:
    const RtcInlet& inlet_;
    Bytes last_;
    bool told_ = false;
};

class InPortObject final : public POA_OpenRTM::InPortCdr {
public:
    InPortObject(RtcInlet inlet, const Terms& terms)
        : inlet_(std::move(inlet)),
          order_(terms.order),
          may_repeat_(terms.subscription == Terms::Subscription::periodic && !terms.keeps_all) {}
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override {
        const std::span<const std::uint8_t> bytes(data.get_buffer(), data.length());
        const std::lock_guard lock(mutex_);
        if (closed_) return OpenRTM::PORT_ERROR;
        if (may_repeat_ && is_repeat({bytes.begin(), bytes.end()})) return OpenRTM::PORT_OK;
        switch (inlet_.site.put(inlet_.path, inlet_.from, bytes, order_)) {
            case PutAnswer::taken: return OpenRTM::PORT_OK;
            case PutAnswer::malformed: return OpenRTM::PORT_ERROR;
            case PutAnswer::unknown: break;
        }
        return OpenRTM::UNKNOWN_ERROR;
    }
    /// Waits until a message that is being taken is done. No message is taken afterwards.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }

private:
    bool is_repeat(const Bytes& message) {
        if (!repeats_.is_repeat(message)) return false;
        repeats_.dropped(message);
        return true;
    }

    const RtcInlet inlet_;
    const std::endian order_;
    const bool may_repeat_;  // the peer's publisher is periodic
    Mutex mutex_;            // for the members below; held while a message is taken, never while a peer is called
    Repeats repeats_{inlet_};
    bool closed_ = false;
};

class PushInlet final : public Connector {
public:
    PushInlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms)
        : object_(new InPortObject(inlet, terms)), reference_(reference_of(orb, *object_.in())) {}
    ~PushInlet() override {
        object_->close();
        deactivate(*object_.in());
    }
    PushInlet(const PushInlet&) = delete;
    PushInlet& operator=(const PushInlet&) = delete;
    std::string reference() const override { return reference_; }

private:
    PortableServer::Servant_var<InPortObject> object_;
    std::string reference_;
};

class PullInlet final : public Caller {
public:
    PullInlet(OpenRTM::OutPortCdr_ptr peer, RtcInlet inlet, std::endian order)
        : Caller(1, false), inlet_(std::move(inlet)), order_(order), peer_(OpenRTM::OutPortCdr::_duplicate(peer)) {
        start([this] { run(); });
    }
    ~PullInlet() override { end(); }
    PullInlet(const PullInlet&) = delete;
    PullInlet& operator=(const PullInlet&) = delete;

private:
    void run() {
        Clock::time_point next = Clock::now();
        while (!lost_ && queue_.wait_until(next)) {
            next = std::max(next + fetch_period, Clock::now());
            take_round();
        }
    }
    void take_round() {
        std::vector<Bytes> round;
        const bool tells_empty = fetch(round);
        for (const Bytes& message : round) {
            // A peer that reports an empty buffer gives each message once.
            if (repeats_.is_repeat(message) && !tells_empty) {
                repeats_.dropped(message);
                continue;
            }
            static_cast<void>(inlet_.site.put(inlet_.path, inlet_.from, message, order_));
        }
    }
    // Fetches up to one more than a peer's buffer: a peer that never reports an empty buffer repeats its last message.
    // Returns true if it reported empty.
    bool fetch(std::vector<Bytes>& round) {
        while (round.size() <= most_waiting) {
            OpenRTM::CdrData_var data;
            const auto status = ask([&] { return peer_->get(data.out()); });
            if (status != OpenRTM::PORT_OK) return status == OpenRTM::BUFFER_EMPTY;
            const std::uint8_t* begin = data->get_buffer();
            round.emplace_back(begin, begin + data->length());
        }
        return false;
    }

    const RtcInlet inlet_;
    const std::endian order_;
    Repeats repeats_{inlet_};
    OpenRTM::OutPortCdr_var peer_;
};

}  // namespace

std::unique_ptr<Connector> make_push_inlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms) {
    return std::make_unique<PushInlet>(orb, inlet, terms);
}

std::unique_ptr<Connector> make_pull_inlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcInlet& inlet,
                                           const Terms& terms) {
    const OpenRTM::OutPortCdr_var peer = peer_of<OpenRTM::OutPortCdr>(orb, reference);
    if (CORBA::is_nil(peer)) return nullptr;
    return std::make_unique<PullInlet>(peer.in(), inlet, terms.order);
}

}  // namespace nezumi::openrtm
