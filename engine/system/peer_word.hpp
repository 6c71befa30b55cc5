// Words of system files that describe peers of the system: other hosts, and programs of another kind.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class Project;
class System;
struct Actor;
class Value;
struct RecordShape;
struct WordCall;

/// The description of peers in a system file by one of these words. Immutable: all copies of a `SystemSpec` share it.
class PeerSpec {
public:
    PeerSpec(const PeerWord& its_word, Place its_place) : word_(its_word), place_(std::move(its_place)) {}
    virtual ~PeerSpec() = default;
    PeerSpec(const PeerSpec&) = delete;
    PeerSpec& operator=(const PeerSpec&) = delete;

    const PeerWord& word() const { return word_; }
    const Place& place() const { return place_; }

private:
    const PeerWord& word_;
    const Place place_;
};

/// The call of such a word in a system file.
struct PeerCall {
    const WordCall& call;
    const Value& table;
    const Project& project;                   ///< finds files that the table names
    bool (*is_taken)(std::string_view name);  ///< whether the console or a library of Lua uses this name
};

/// Each library that connects to peers implements their word. A program lists the words that its system files may use
/// (`LiveOptions::peer_words`); a word must outlive every system.
class PeerWord {
public:
    PeerWord() = default;
    virtual ~PeerWord() = default;
    PeerWord(const PeerWord&) = delete;
    PeerWord& operator=(const PeerWord&) = delete;

    virtual std::string_view name() const = 0;
    /// The structures of the word's table, the structure of the table itself first: for editors, the documentation and
    /// completion.
    virtual std::vector<RecordShape> records() const = 0;
    virtual Expected<std::shared_ptr<const PeerSpec>> read(const PeerCall& call) const = 0;
    /// The text of a call that is read as the same description; ends with a newline.
    virtual std::string text(const PeerSpec& spec) const = 0;
    /// Whether a written file has the call after its components, and not at its beginning.
    virtual bool follows_components() const { return false; }
    /// Whether a system with this word has a network (`Makers::network`).
    virtual bool needs_network() const { return false; }
    /// Checks what depends on the whole description. Called for systems without the word as well.
    virtual Expected<void> check(const SystemSpec& /*system*/) const { return {}; }
    /// Removes the part of the description at this location, and everything that needs it. Returns whether there was
    /// such a part.
    virtual bool remove_at(SystemSpec& /*system*/, const Place& /*place*/) const { return false; }
    /// Removes the names of components that no longer exist from the description.
    virtual void remove_missing(SystemSpec& /*system*/) const {}
    /// Called after `who` has added this component to a running system, for each word that the system file uses.
    virtual void note_added(SystemSpec& /*system*/, std::string_view /*component*/, const Actor& /*who*/) const {}

    /// The form of a port of such a peer, as an end of a connection: "rtm:NAME.port". It begins with "WORD:". "": these
    /// peers have no ports of this kind.
    virtual std::string_view port_form() const { return ""; }
    /// Whether an end of a connection is such a port.
    bool has_port(std::string_view end) const;
    /// Checks the form of such an end.
    virtual Expected<void> check_port(std::string_view /*end*/) const { return {}; }
    /// Checks a connection with such a port, as `System::ForeignCheck` does. `spec`: the description of the peers in
    /// the system file; null if the file does not use this word.
    virtual Expected<void> check_connection(const System& /*system*/, const PeerSpec* /*spec*/,
                                            const ConnectionSpec& /*connection*/) const {
        return {};
    }
    /// Checks the parts of a built system that the peers would see, without connecting to them.
    virtual Expected<void> check_built(const System& /*system*/, const PeerSpec& /*spec*/) const { return {}; }
};

/// The word whose peers have this port; null if there is none.
const PeerWord* word_of_port(const PeerWords& words, std::string_view end);

}  // namespace nezumi
