// Message types made of definitions.
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

/// Keeps message types, each once: equal definitions are one type, whichever project they come from. It only grows:
/// values, ports and journals refer to a type for as long as they like. Any thread may call it.
class MessageCatalog {
public:
    MessageCatalog();
    ~MessageCatalog();
    MessageCatalog(const MessageCatalog&) = delete;
    MessageCatalog& operator=(const MessageCatalog&) = delete;

    /// That of this process. What it gives depends on the definition alone.
    static MessageCatalog& shared();

    /// Gives the payload of the message that a field names, or why there is none; the error has no place.
    using Payloads = std::function<Expected<const Type*>(const FieldDefinition& field)>;

    /// The message type of a definition. An error says the place of the field that it is about.
    Expected<const MessageType*> define(const MessageDefinition& definition, const Payloads& payloads);

    /// The type of this name that was defined last; null for none.
    const MessageType* find(std::string_view name);

private:
    struct Entry;

    Mutex mutex_;
    std::map<std::string, std::unique_ptr<Entry>> all_;  // by what makes them differ
    std::map<std::string, const MessageType*, std::less<>> last_;
};

/// What hosts call a message type between them: an identifier. Of one that a file defines it ends with a hash of its
/// fields, so that hosts whose definitions differ do not take one for the other.
std::string wire_name(const MessageType& type);

}  // namespace nezumi
