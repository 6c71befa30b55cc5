// The words of peers, for tests whose system files use them.
#pragma once

#include "bindings/dds/network_word.hpp"
#include "bindings/dds/ros/ros_word.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

inline PeerWords peer_words() { return {&dds::network_word(), &dds::ros_word(), &openrtm::rtm_word()}; }

}  // namespace nezumi
