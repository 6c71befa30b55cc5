// Deactivation of objects that peers call.
#pragma once

#include <omniORB4/CORBA.h>

namespace nezumi::openrtm {

/// The object can't be reached any more; a running call still uses it.
inline void deactivate(PortableServer::ServantBase& servant) {
    try {
        const PortableServer::POA_var poa = servant._default_POA();
        const PortableServer::ObjectId_var id = poa->servant_to_id(&servant);
        poa->deactivate_object(id);
    } catch (const CORBA::Exception&) {
        // The ORB has ended, and the object with it.
        return;
    }
}

}  // namespace nezumi::openrtm
