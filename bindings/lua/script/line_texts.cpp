// Keeps of a line's values those that it names.
#include "bindings/lua/script/line_texts.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// Those that the line names, `config.speed` and such too.
std::vector<TracedLines::Value> named_in(std::string_view text, const std::vector<TracedLines::Value>& values) {
    std::vector<TracedLines::Value> named;
    Lexer lexer(text);
    std::string path;  // "config" or "config.speed", as far as it has come
    bool is_field = false;
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
        if (token.is(".") && !path.empty()) {
            is_field = true;
            continue;
        }
        const bool is_name = token.kind == Token::Kind::name;
        if (!is_name) {
            path = token.is(":") || token.is(".") ? "?" : "";  // what follows is no variable
            is_field = path == "?";
            continue;
        }
        if (is_field) {
            path += '.';
        } else {
            path.clear();
        }
        path += token.text;
        is_field = false;
        const auto is_it = [&](const TracedLines::Value& each) { return each.name == path; };
        const auto value = std::find_if(values.begin(), values.end(), is_it);
        if (value != values.end() && std::none_of(named.begin(), named.end(), is_it)) named.push_back(*value);
    }
    return named;
}

}  // namespace

void add_texts(TracedLines& traced, const Script& script) {
    std::map<std::string, std::string> texts;
    std::map<std::string, std::vector<std::string_view>> lines;
    for (TracedLines::Line& line : traced.lines) {
        if (!texts.contains(line.file)) {
            const std::string& text = texts[line.file] = script.text_of(line.file);
            lines[line.file] = lines_of(text);
        }
        const auto& all = lines[line.file];
        const auto index = static_cast<std::size_t>(line.line - 1);
        if (index >= all.size()) continue;
        line.text = trimmed(all[index]);
        if (!all[index].empty()) line.values = named_in(all[index], line.values);
    }
}

}  // namespace nezumi
