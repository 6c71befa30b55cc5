// The part of a connector that calls its peer on its own thread: a peer that hangs delays no other thread.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include <data_port.hh>
#include "bindings/openrtm/orb/connector.hpp"
#include "bindings/openrtm/orb/message_queue.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {

/// Queue length as in OpenRTM-aist's buffer.
inline constexpr std::size_t most_waiting = 8;

/// Calls a peer until it is gone.
class Caller : public Connector {
public:
    Caller(std::size_t capacity, bool of_velocities) : queue_(capacity, of_velocities) {}
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
    // Returns the peer's answer. After a timeout the peer may be called again.
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

    MessageQueue queue_;
    std::atomic<bool> lost_ = false;

private:
    std::thread thread_;
};

/// Converts a reference to a typed one without calling the peer. So a peer that hangs is noticed only at the first
/// message.
template <class Interface>
typename Interface::_ptr_type peer_of(CORBA::ORB_ptr orb, const std::string& reference) {
    try {
        const CORBA::Object_var object = orb->string_to_object(reference.c_str());
        return Interface::_unchecked_narrow(object);
    } catch (const CORBA::Exception&) {
        return Interface::_nil();
    }
}

template <class Object>
std::string reference_of(CORBA::ORB_ptr orb, Object& object) {
    const CORBA::Object_var reference = object._this();
    const CORBA::String_var text = orb->object_to_string(reference);
    return text.in();
}

}  // namespace nezumi::openrtm
