// Reads system files as tests want them: from a text, as a file of the project's own sources.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/peer_words.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::system_files {

// Reads a text as the file behaviors/systems/s.lua of the project's own sources.
inline Expected<SystemSpec> read(std::string_view text, SystemFileOptions options = {}) {
    options.peer_words = peer_words();
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    return read_system_text(text, "behaviors/systems/s.lua", project, options);
}

inline SystemSpec system_of(std::string_view text) {
    auto spec = read(text);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

// The error without the folders of the file.
inline std::string system_error(std::string_view text) {
    const auto spec = read(text);
    if (!spec && spec.error().place.file == "behaviors/systems/s.lua") return describe(spec.error()).substr(18);
    return spec ? "no error" : describe(spec.error());
}

template <class T>
const T& entry(const SystemSpec& spec, std::size_t index) {
    REQUIRE(index < spec.entries.size());
    return std::get<T>(spec.entries[index]);
}

}  // namespace nezumi::system_files
