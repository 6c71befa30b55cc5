// Common functions of objects that peers call: deactivation, and return codes.
#pragma once

#include <omniORB4/CORBA.h>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

inline RTC::ReturnCode_t code_of(RtcAnswer answer) {
    switch (answer) {
        case RtcAnswer::done: return RTC::RTC_OK;
        case RtcAnswer::taken:
        case RtcAnswer::refused: return RTC::PRECONDITION_NOT_MET;
        case RtcAnswer::unknown: return RTC::BAD_PARAMETER;
        case RtcAnswer::busy: break;
    }
    return RTC::RTC_ERROR;
}

/// Makes the object unreachable for peers. A running call may still use it.
inline void deactivate(PortableServer::ServantBase& servant) {
    try {
        const PortableServer::POA_var poa = servant._default_POA();
        const PortableServer::ObjectId_var id = poa->servant_to_id(&servant);
        poa->deactivate_object(id);
    } catch (const CORBA::Exception&) {
        // The ORB has ended, so the object is unreachable already.
        return;
    }
}

}  // namespace nezumi::openrtm
