// Push and pull, each from both sides.
#include "bindings/openrtm/orb/connector.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include <data_port.hh>
#include "bindings/openrtm/orb/message_queue.hpp"
#include "bindings/openrtm/orb/servants.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// As many messages wait for a peer as in a buffer of OpenRTM-aist.
constexpr std::size_t most_waiting = 8;
// How often [Hz] a peer is asked for a message.
constexpr double fetch_rate = 100;

std::size_t capacity_for(const Terms& terms) {
    return terms.subscription == Terms::Subscription::flush || terms.keeps_all || !terms.push ? most_waiting : 1;
}

class InPortObject final : public POA_OpenRTM::InPortCdr {
public:
    InPortObject(RtcInlet inlet, std::endian order) : inlet_(std::move(inlet)), order_(order) {}
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override {
        const std::span<const std::uint8_t> bytes(data.get_buffer(), data.length());
        const std::lock_guard lock(mutex_);
        if (closed_) return OpenRTM::PORT_ERROR;
        switch (inlet_.site.put(inlet_.path, inlet_.from, bytes, order_)) {
            case PutAnswer::taken: return OpenRTM::PORT_OK;
            case PutAnswer::malformed: return OpenRTM::PORT_ERROR;
            case PutAnswer::unknown: break;
        }
        return OpenRTM::UNKNOWN_ERROR;
    }
    /// Waits for a message that is being taken: none comes after this.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }

private:
    const RtcInlet inlet_;
    const std::endian order_;
    Mutex mutex_;  // of what follows, and held while a message is taken; never while a peer is called
    bool closed_ = false;
};

class OutPortObject final : public POA_OpenRTM::OutPortCdr {
public:
    OutPortObject() : queue_(most_waiting) {}
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override {
        OpenRTM::CdrData_var answer = new OpenRTM::CdrData;
        Bytes message;
        const bool is_there = queue_.take(message);
        answer->length(static_cast<CORBA::ULong>(message.size()));
        std::copy(message.begin(), message.end(), answer->get_buffer());
        data = answer._retn();
        return is_there ? OpenRTM::PORT_OK : OpenRTM::BUFFER_EMPTY;
    }
    void put(std::span<const std::uint8_t> bytes) { queue_.put(bytes); }

private:
    MessageQueue queue_;
};

template <class Object>
std::string reference_of(CORBA::ORB_ptr orb, Object& object) {
    const CORBA::Object_var reference = object._this();
    const CORBA::String_var text = orb->object_to_string(reference);
    return text.in();
}

class PushInlet final : public Connector {
public:
    PushInlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms)
        : object_(new InPortObject(inlet, terms.order)), reference_(reference_of(orb, *object_.in())) {}
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

class PullOutlet final : public Connector {
public:
    explicit PullOutlet(CORBA::ORB_ptr orb)
        : object_(new OutPortObject), reference_(reference_of(orb, *object_.in())) {}
    ~PullOutlet() override { deactivate(*object_.in()); }
    PullOutlet(const PullOutlet&) = delete;
    PullOutlet& operator=(const PullOutlet&) = delete;
    void publish(std::span<const std::uint8_t> bytes) override { object_->put(bytes); }
    std::string reference() const override { return reference_; }

private:
    PortableServer::Servant_var<OutPortObject> object_;
    std::string reference_;
};

// Calls a peer until it is gone; one that hangs costs nobody else anything.
class Caller : public Connector {
public:
    explicit Caller(const Terms& terms) : terms_(terms), queue_(capacity_for(terms)) {}
    bool is_lost() const override { return lost_; }

protected:
    template <class Call>
    void start(const Call& call) {
        thread_ = start_thread(call);
    }
    void end() {
        queue_.end();
        if (thread_.joinable()) thread_.join();
    }
    // Returns what the peer says. Whoever does not answer in time may do so the next time.
    template <class Call>
    OpenRTM::PortStatus ask(const Call& call) {
        try {
            return call();
        } catch (const CORBA::TIMEOUT&) {
            return OpenRTM::BUFFER_TIMEOUT;
        } catch (const CORBA::Exception&) {
            lost_ = true;
        }
        return OpenRTM::UNKNOWN_ERROR;
    }

    const Terms terms_;
    MessageQueue queue_;
    std::atomic<bool> lost_ = false;

private:
    std::thread thread_;
};

Clock::duration period_of(double rate) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
}

class PushOutlet final : public Caller {
public:
    PushOutlet(OpenRTM::InPortCdr_ptr peer, const Terms& terms)
        : Caller(terms), peer_(OpenRTM::InPortCdr::_duplicate(peer)) {
        start([this] { run(); });
    }
    ~PushOutlet() override { end(); }
    PushOutlet(const PushOutlet&) = delete;
    PushOutlet& operator=(const PushOutlet&) = delete;
    void publish(std::span<const std::uint8_t> bytes) override {
        if (!lost_) queue_.put(bytes);
    }

private:
    void run() {
        const bool is_periodic = terms_.subscription == Terms::Subscription::periodic;
        Clock::time_point next = Clock::now();
        Bytes message;
        while (!lost_) {
            if (is_periodic) {
                if (!queue_.wait_until(next)) return;
                next = std::max(next + period_of(terms_.rate), Clock::now());
                if (!queue_.take(message)) continue;
            } else if (!queue_.wait(message)) {
                return;
            }
            const auto size = static_cast<CORBA::ULong>(message.size());
            const OpenRTM::CdrData data(size, size, message.data(), false);
            static_cast<void>(ask([&] { return peer_->put(data); }));
        }
    }

    OpenRTM::InPortCdr_var peer_;
};

class PullInlet final : public Caller {
public:
    PullInlet(OpenRTM::OutPortCdr_ptr peer, RtcInlet inlet, const Terms& terms)
        : Caller(terms), inlet_(std::move(inlet)), peer_(OpenRTM::OutPortCdr::_duplicate(peer)) {
        start([this] { run(); });
    }
    ~PullInlet() override { end(); }
    PullInlet(const PullInlet&) = delete;
    PullInlet& operator=(const PullInlet&) = delete;

private:
    void run() {
        Clock::time_point next = Clock::now();
        while (!lost_ && queue_.wait_until(next)) {
            next = std::max(next + period_of(fetch_rate), Clock::now());
            fetch_all();
        }
    }
    // No more at once than wait at a peer: one that is never empty must not keep this from its end.
    void fetch_all() {
        for (std::size_t fetched = 0; fetched < most_waiting; ++fetched) {
            OpenRTM::CdrData_var data;
            const auto status = ask([&] { return peer_->get(data.out()); });
            if (status != OpenRTM::PORT_OK) return;
            static_cast<void>(inlet_.site.put(inlet_.path, inlet_.from,
                                              {static_cast<const std::uint8_t*>(data->get_buffer()), data->length()},
                                              terms_.order));
        }
    }

    const RtcInlet inlet_;
    OpenRTM::OutPortCdr_var peer_;
};

// Asks nothing of the peer: a port that hangs would be heard of only then.
template <class Interface>
typename Interface::_ptr_type peer_of(CORBA::ORB_ptr orb, const std::string& reference) {
    try {
        const CORBA::Object_var object = orb->string_to_object(reference.c_str());
        return Interface::_unchecked_narrow(object);
    } catch (const CORBA::Exception&) {
        return Interface::_nil();
    }
}

}  // namespace

std::unique_ptr<Connector> make_push_inlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms) {
    return std::make_unique<PushInlet>(orb, inlet, terms);
}

std::unique_ptr<Connector> make_pull_outlet(CORBA::ORB_ptr orb, const Terms& /*terms*/) {
    return std::make_unique<PullOutlet>(orb);
}

std::unique_ptr<Connector> make_pull_inlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcInlet& inlet,
                                           const Terms& terms) {
    const OpenRTM::OutPortCdr_var peer = peer_of<OpenRTM::OutPortCdr>(orb, reference);
    if (CORBA::is_nil(peer)) return nullptr;
    return std::make_unique<PullInlet>(peer.in(), inlet, terms);
}

std::unique_ptr<Connector> make_push_outlet(CORBA::ORB_ptr orb, const std::string& reference, const Terms& terms) {
    const OpenRTM::InPortCdr_var peer = peer_of<OpenRTM::InPortCdr>(orb, reference);
    if (CORBA::is_nil(peer)) return nullptr;
    return std::make_unique<PushOutlet>(peer.in(), terms);
}

}  // namespace nezumi::openrtm
