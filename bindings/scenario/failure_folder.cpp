// Characters that a shell or a file system could misinterpret become hyphens.
#include "bindings/scenario/failure_folder.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <system_error>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest = 100;  // [bytes]; file systems allow 255

bool is_kept(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           static_cast<unsigned char>(c) >= 0x80 || c == '.' || c == '=' || c == '_' || c == '-';
}

// Characters of every run's name, which can be removed without making two names equal: "drives [noise=true,
// speed=0.1]".
bool is_joint(char c) { return c == ' ' || c == ',' || c == '[' || c == ']'; }

bool is_inside_a_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

std::string run_file_name(const fs::path& file, std::string_view run, bool alone) {
    bool lossy = !alone;
    std::string out;
    const auto add = [&](std::string_view given) {
        char before = 0;
        for (const char c : given) {
            const bool kept = is_kept(c) && !(out.empty() && (c == '.' || c == '-'));
            // A hyphen may stand for a blank, unless it is a minus.
            lossy = lossy || (!kept && !is_joint(c)) || (c == '-' && before != '=');
            if (kept || (!out.empty() && out.back() != '-')) out += kept ? c : '-';
            before = c;
        }
    };
    add(file.stem().string());
    if (!out.empty()) out += '-';
    add(run);
    if (out.size() > longest) {
        std::size_t end = longest;
        while (is_inside_a_letter(out[end])) --end;
        out.resize(end);
        lossy = true;
    }
    while (out.ends_with('-')) out.pop_back();
    if (out.empty()) out = "run";
    const auto hash = static_cast<std::uint32_t>(mix(mix(0, file.generic_string()), run));
    return lossy ? fmt::format("{}-{:08x}", out, hash) : out;
}

Expected<std::string> make_failure_folder(const fs::path& folder) {
    std::error_code problem;
    fs::remove_all(folder, problem);
    if (!problem) fs::create_directories(folder, problem);
    if (problem) return failure(fmt::format("the folder {} can't be made: {}", folder.string(), problem.message()));
    return folder.string();
}

}  // namespace nezumi
