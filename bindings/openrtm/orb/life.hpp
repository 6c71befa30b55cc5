// Tests whether an object of another program is alive.
#pragma once

#include <omniORB4/CORBA.h>

namespace nezumi::openrtm {

enum class Life {
    lives,
    silent,  ///< no answer in time: it may hang
    gone,
};

/// May wait for a second.
inline Life life_of(CORBA::Object_ptr object) {
    try {
        return object->_non_existent() ? Life::gone : Life::lives;
    } catch (const CORBA::TIMEOUT&) {
        return Life::silent;
    } catch (const CORBA::Exception&) {
        return Life::gone;
    }
}

}  // namespace nezumi::openrtm
