// Reads anything as a file in OMG IDL, which may include itself.
#include "engine/messages/idl_file.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

#include "tests/fuzz/defined_message.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const SourceText source{"fuzzed.idl", "fuzzed.idl", std::string(reinterpret_cast<const char*>(data), size)};
    const auto all = read_idl(source, [&](std::string_view name, const SourceText&) -> Expected<SourceText> {
        if (name == "time.idl") return SourceText{"time.idl", "time.idl", "module RTC { struct Time { long sec; }; };"};
        if (name == "fuzzed.idl") return source;
        return failure("there is no such file");
    });
    if (!all) {
        check(all.error());
        return 0;
    }
    for (const MessageDefinition& definition : *all) {
        require(!definition.fields.empty());
        check_definition(without_stamp(definition), [&](const FieldDefinition& field) -> Expected<const Type*> {
            const bool is_there =
                field.kind == wide_text ||
                std::any_of(all->begin(), all->end(), [&](const auto& each) { return each.name == field.kind; });
            require(is_there);
            return &type_of<Point2D>();
        });
    }
    return 0;
}
