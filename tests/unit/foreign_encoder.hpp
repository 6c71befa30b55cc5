// Compares nezumi's CDR with the encoder of another program, for each built-in and each installed message type.
#pragma once

#include <bit>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/messages/message_files.hpp"
#include "tests/unit/random_message.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi {

/// Calls `agrees(value, order)` with random values, in both byte orders, and prints a line for each type that differs.
/// `prepare` may make a value one that the other encoder has. The exit status of the program.
template <class Agrees, class Prepare>
int compare_shipped_types(const Agrees& agrees, const Prepare& prepare) {
    const MessageFiles files(Project::of(source_root() + "/behaviors/it.lua"),
                             [](const SourceText&, const Project&) { return failure("not here"); });
    std::vector<const MessageType*> all = files.all("it.lua");
    for (const MessageType& type : compiled_message_types()) all.push_back(&type);
    int wrong = 0;
    RandomMessages random(7);
    for (const MessageType* type : all) {
        for (int i = 0; i < 20; ++i) {
            Value value = make_payload(type);
            random.fill(value);
            prepare(value);
            for (const std::endian order : {std::endian::little, std::endian::big}) {
                try {
                    if (agrees(value, order)) continue;
                    std::printf("%s differs%s\n", type->name.c_str(), order == std::endian::big ? " (big-endian)" : "");
                } catch (const std::exception& error) {
                    std::printf("%s: %s\n", type->name.c_str(), error.what());
                }
                ++wrong;
            }
        }
    }
    std::printf("%zu message types, %d differences\n", all.size(), wrong);
    return wrong == 0 && all.size() > 100 ? 0 : 1;
}

}  // namespace nezumi
