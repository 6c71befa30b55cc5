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

    bool push = true;  ///< if false, the in-port fetches
    Subscription subscription = Subscription::flush;
    bool keeps_all = false;  ///< also sends the messages between two periods
    double rate = 0;         ///< [Hz] of `periodic`
    std::endian order = std::endian::little;
};

/// Returns nothing if they ask for an unsupported interface or serializer; only CORBA's CDR is supported.
std::optional<Terms> terms_of(const SDOPackage::NVList& properties);
/// Adds the terms of the connections that we make: each message immediately, pushed. `type`: "TimedLong".
void add_own_terms(SDOPackage::NVList& properties, const std::string& type_id);

}  // namespace nezumi::openrtm
