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

/// What a system file says with one of these words. Immutable: all copies of a `SystemSpec` share it.
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

/// A call of such a word.
struct PeerCall {
    const WordCall& call;
    const Value& table;
    const Project& project;                   ///< finds files that the table names
    bool (*is_taken)(std::string_view name);  ///< whether the language of the file or the console has this name
};

/// A room that reaches peers implements their word. A program lists the words that its system files may use
/// (`LiveOptions::peer_words`); a word must outlive every system.
class PeerWord {
public:
    PeerWord() = default;
    virtual ~PeerWord() = default;
    PeerWord(const PeerWord&) = delete;
    PeerWord& operator=(const PeerWord&) = delete;

    virtual std::string_view name() const = 0;
    /// The structures of its table, its own first: for editors, the documentation and completion.
    virtual std::vector<RecordShape> records() const = 0;
    virtual Expected<std::shared_ptr<const PeerSpec>> read(const PeerCall& call) const = 0;
    /// A call that is read as the same; ends with a newline.
    virtual std::string text(const PeerSpec& spec) const = 0;
    /// Whether a written file has the call after its components; otherwise at its beginning.
    virtual bool follows_components() const { return false; }
    /// Whether a system with this word has a network (`Makers::network`).
    virtual bool needs_network() const { return false; }
    /// Checks what depends on the whole system. Called for systems without the word as well.
    virtual Expected<void> check(const SystemSpec& /*system*/) const { return {}; }
    /// Removes what is at this place, and everything that needs it. Returns whether there was anything.
    virtual bool remove_at(SystemSpec& /*system*/, const Place& /*place*/) const { return false; }
    /// Removes names of components that the system does not have.
    virtual void remove_missing(SystemSpec& /*system*/) const {}
    /// `who` has added this component to a running system. Called for each word that the system file uses.
    virtual void note_added(SystemSpec& /*system*/, std::string_view /*component*/, const Actor& /*who*/) const {}

    /// The form of a port of such a peer, as an end of a connection: "rtm:NAME.port". It begins with "WORD:". "": these
    /// peers have no ports of this kind.
    virtual std::string_view port_form() const { return ""; }
    /// Whether an end of a connection is such a port.
    bool has_port(std::string_view end) const;
    /// Checks the form of such an end.
    virtual Expected<void> check_port(std::string_view /*end*/) const { return {}; }
    /// Checks a connection with such a port, as `System::ForeignCheck`. `spec`: what the system file says with this
    /// word; may be null.
    virtual Expected<void> check_connection(const System& /*system*/, const PeerSpec* /*spec*/,
                                            const ConnectionSpec& /*connection*/) const {
        return {};
    }
    /// Checks what the peers would see of a system that is built, without reaching them.
    virtual Expected<void> check_built(const System& /*system*/, const PeerSpec& /*spec*/) const { return {}; }
};

/// The word whose peers have this port; null if there is none.
const PeerWord* word_of_port(const PeerWords& words, std::string_view end);

}  // namespace nezumi
