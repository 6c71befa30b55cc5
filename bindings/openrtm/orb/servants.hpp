// The end of objects that peers call.
#pragma once

#include <omniORB4/CORBA.h>

namespace nezumi::openrtm {

/// Nobody reaches it any more; a call that is under way still finds it.
inline void deactivate(PortableServer::ServantBase& servant) {
    try {
        const PortableServer::POA_var poa = servant._default_POA();
        const PortableServer::ObjectId_var id = poa->servant_to_id(&servant);
        poa->deactivate_object(id);
    } catch (const CORBA::Exception&) {
        // The ORB has ended, and it with it.
        return;
    }
}

}  // namespace nezumi::openrtm
