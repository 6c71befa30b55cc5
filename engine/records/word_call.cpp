// Makes the check for the arguments of a call.
#include "engine/records/word_call.hpp"

#include <fmt/format.h>

namespace nezumi {

FieldCheck check_of(const WordCall& call, const Value& fields, const std::string& name) {
    FieldCheck check(name.empty() ? call.word : fmt::format("{} '{}'", call.word, name), call.word, call.place,
                     call.source);
    check.set_given({name, &fields});
    return check;
}

}  // namespace nezumi
