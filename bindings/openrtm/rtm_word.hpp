// `rtm` in system files: components that are exported as RTCs, and connections of their ports.
#pragma once

#include <string>
#include <string_view>

#include "bindings/openrtm/rtm_spec.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/actor.hpp"
#include "engine/system/peer_word_of.hpp"

namespace nezumi {

template <>
struct Describe<openrtm::RtmSpec> {
    static constexpr std::string_view name = "rtm";
    static constexpr std::string_view doc =
        "Components that are visible to OpenRTM-aist components and can be connected to them.";
    static constexpr FieldList fields{
        Setting{"nameserver",
                &openrtm::RtmSpec::nameservers,
                "",
                "\"HOST:PORT\" of the CORBA name service, or of several",
                {.fallback = "\"localhost:2809\""}},
        Setting{"export", &openrtm::RtmSpec::exported, "", "the components that appear as RTCs"},
        Setting{"interface",
                &openrtm::RtmSpec::interface,
                "",
                "this computer's address, at which others reach them; by default only this computer reaches them",
                {.adopt = openrtm::adopt_interface}},
        Setting{"rename", &openrtm::RtmSpec::rename, "", "the name of a port in OpenRTM, by `\"name.port\"`"},
        Setting{"manager", &openrtm::RtmSpec::manager, "",
                "tools such as RTSystemEditor may add and remove behaviours, and end the run"},
        Internal{&openrtm::RtmSpec::place},
    };
};

namespace openrtm {

/// The actor for acts of RTCs and OpenRTM's tools.
inline const Actor rtm_actor{Actor::Kind::network, "rtm"};

class RtmWord final : public PeerWordOf<RtmSpec> {
public:
    bool follows_components() const override { return true; }
    Expected<void> check(const SystemSpec& system) const override;
    void remove_missing(SystemSpec& system) const override;
    /// Exports a component that a tool of OpenRTM has added.
    void note_added(SystemSpec& system, std::string_view component, const Actor& who) const override;
    std::string_view port_form() const override { return "rtm:NAME.port"; }
    Expected<void> check_port(std::string_view end) const override;
    Expected<void> check_connection(const System& system, const PeerSpec* spec,
                                    const ConnectionSpec& connection) const override;
    Expected<void> check_built(const System& system, const PeerSpec& spec) const override;

protected:
    void complete(RtmSpec& given, Fields& fields, const PeerCall& call) const override;
    std::string text_of(const RtmSpec& given) const override;
};

const RtmWord& rtm_word();

}  // namespace openrtm
}  // namespace nezumi
