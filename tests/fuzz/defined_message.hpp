// What fuzzers ask of a definition that was read: it makes a type, or says in a line why not, and its values can be
// written, read and compared.
#pragma once

#include "engine/messages/message_catalog.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/limits.hpp"
#include "tests/fuzz/require.hpp"

namespace nezumi {

inline void check_definition(const MessageDefinition& definition, const MessageCatalog::Payloads& payloads) {
    MessageCatalog catalog;
    const auto type = catalog.define(definition, payloads);
    if (!type) return check(type.error());
    require(catalog.define(definition, payloads) == type);
    const Value value = make_payload(*type);
    Octets written;
    write_cdr(written, {}, value);
    Value again = make_payload(*type);
    require(read_cdr(written, {}, again).has_value());
    require(is_equal(again, value) || !is_finite(value));
    require(mix_payload(1, again) == mix_payload(1, value));
    require(find_misfit(value).size() < 2000);
}

}  // namespace nezumi
