// Reads anything as a message of ROS.
#include "engine/messages/msg_file.hpp"

#include <cstdint>
#include <string>

#include "tests/fuzz/defined_message.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const SourceText source{"fuzzed_msgs/Fuzzed.msg", "Fuzzed.msg",
                            std::string(reinterpret_cast<const char*>(data), size)};
    const auto definition = read_msg(source, "fuzzed_msgs");
    if (!definition) {
        check(definition.error());
        return 0;
    }
    check_definition(*definition, [](const FieldDefinition& field) -> Expected<const Type*> {
        if (const Type* compiled = compiled_payload(field.kind)) return compiled;
        return failure("there is no such message");
    });
    return 0;
}
