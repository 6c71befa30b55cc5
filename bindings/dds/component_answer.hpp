// What a component of this host answers to what another host asks of it.
#pragma once

#include "engine/base/error.hpp"
#include "engine/system/network.hpp"
#include "engine/system/questions.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// What the component is and how it stands, as a table: type, status, version, rate, set, sets, error, config.
PlainData look_at(const Component& component, const System& system);

/// The act that is asked for: anything but a look. The error says what is wrong with what it was given.
Expected<Act> act_of(Question::What what, const std::string& name, PlainData values, const Component& component);

/// Performs it, or looks, as what `who` does. `writable`: whoever asks may change something. The answer is a look, the
/// results of a command, the set in use, or the status that follows.
Expected<PlainData> answer(const Question& question, const System& system, bool writable, const ActDoor& act,
                           const Actor& who);

}  // namespace nezumi::dds
