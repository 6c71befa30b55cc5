// The terms of a connection between data ports, from its properties.
#pragma once

#include <bit>
#include <optional>
#include <string>

#include <rtm.hh>

namespace nezumi::openrtm {

/// How messages of a connection are sent.
struct Terms {
    /// When an out-port sends: each message immediately; the latest when the peer has taken the one before; or the
    /// latest periodically.
    enum class Subscription { flush, newest, periodic };

    bool push = true;  ///< the out-port sends; if false, the in-port fetches
    Subscription subscription = Subscription::flush;
    bool keeps_all = false;  ///< also sends the messages between two periods
    double rate = 0;         ///< [Hz] of `periodic`
    std::endian order = std::endian::little;
};

/// Reads the terms from a connection's properties. Nothing if they require another interface or serializer than CORBA's
/// CDR, because no other is supported.
std::optional<Terms> terms_of(const SDOPackage::NVList& properties);
/// Adds the terms of connections that we make: each message is pushed immediately. `type_id`: "IDL:RTC/TimedLong:1.0".
void add_own_terms(SDOPackage::NVList& properties, const std::string& type_id);

}  // namespace nezumi::openrtm
