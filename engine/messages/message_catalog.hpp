// Makes message types from definitions.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/mutex.hpp"
#include "engine/messages/definition.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {

/// Stores message types, each once: equal definitions give the same type, also from different projects. Types are never
/// removed, so values, ports and journals can keep pointers to them. May be called from any thread.
class MessageCatalog {
public:
    MessageCatalog();
    ~MessageCatalog();
    MessageCatalog(const MessageCatalog&) = delete;
    MessageCatalog& operator=(const MessageCatalog&) = delete;

    /// The catalog of this process. Its results depend only on the definitions.
    static MessageCatalog& shared();

    /// Returns the payload type of the message type that a field names. The error has no location.
    using Payloads = std::function<Expected<const Type*>(const FieldDefinition& field)>;

    /// Returns the message type of a definition. An error has the location of the wrong field.
    Expected<const MessageType*> define(const MessageDefinition& definition, const Payloads& payloads);

    /// The most recently defined type with this name; null if there is none.
    const MessageType* find(std::string_view name);

private:
    struct Entry;

    Mutex mutex_;
    std::map<std::string, std::unique_ptr<Entry>> all_;  // by `key_of` the definition
    std::map<std::string, const MessageType*, std::less<>> last_;
};

/// The name of a message type for other hosts. For a type from a file it ends with a hash of the fields, so that hosts
/// with different definitions of one name do not exchange messages.
std::string wire_name(const MessageType& type);

}  // namespace nezumi
