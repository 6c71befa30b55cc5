// A guard of regular files in place of a robot's nodes.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "hw/device/node.hpp"
#include "hw/guard/guard.hpp"

namespace nezumi::hw {

inline void guard_sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

inline std::string guarded_text(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// From now on the guard stops this file by "0".
inline bool guard_file(Guard& guard, std::size_t index, const std::filesystem::path& file) {
    Node node(file.string(), Access::write);
    return node.open() && guard.take_up(node, {.index = index, .text = "0", .proof = Proof::empty_write});
}

}  // namespace nezumi::hw
