// Takes line by line while they begin with dashes.
#include "bindings/lua/script/first_comment.hpp"

#include <algorithm>

#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

constexpr std::size_t most = 2000;  // [bytes]

}  // namespace

std::string first_comment(std::string_view source) {
    source = without_preamble(source);
    std::string text;
    while (!source.empty()) {
        const std::size_t end = std::min(source.find('\n'), source.size());
        std::string_view line = trimmed(source.substr(0, end));
        source.remove_prefix(std::min(end + 1, source.size()));
        if (line.empty() && text.empty()) continue;
        if (!line.starts_with("--") || line.starts_with("--[[") || line.starts_with("--[=")) break;
        line.remove_prefix(std::min(line.find_first_not_of('-'), line.size()));
        line = trimmed(line);
        if (text.size() + line.size() >= most) break;
        if (!text.empty()) text += '\n';
        text += line;
    }
    return text.substr(0, text.find_last_not_of('\n') + 1);
}

}  // namespace nezumi
