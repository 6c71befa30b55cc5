// What the properties of a connection between data ports ask for.
#pragma once

#include <bit>
#include <optional>

#include <rtm.hh>

namespace nezumi::openrtm {

/// How messages of a connection go.
struct Terms {
    /// When an out-port sends: each message at once, the latest as soon as the peer has taken the one before, or the
    /// latest so often.
    enum class Subscription { flush, newest, periodic };

    bool push = true;  ///< else the in-port fetches
    Subscription subscription = Subscription::flush;
    bool keeps_all = false;  ///< messages that came between are sent as well
    double rate = 0;         ///< [Hz] of `periodic`
    std::endian order = std::endian::little;
};

/// Nothing where they ask for what is not there: another interface or serializer than CORBA's CDR.
std::optional<Terms> terms_of(const SDOPackage::NVList& properties);

}  // namespace nezumi::openrtm
