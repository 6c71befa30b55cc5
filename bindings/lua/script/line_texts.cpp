// Keeps only the values that a line names.
#include "bindings/lua/script/line_texts.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"
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

// The variables that each line of a text names, such as "config". For `config.speed` also "config.speed".
std::map<int, std::vector<std::string>> names_by_line(std::string_view text) {
    using Kind = SyntaxNode::Kind;
    std::map<int, std::vector<std::string>> named;
    const SyntaxTree tree(without_preamble(text));
    for (const SyntaxNode& node : tree.nodes()) {
        if (node.word == nullptr || !(node.is(Kind::name) || node.is(Kind::declaration))) continue;
        named[node.word->line].emplace_back(node.word_text());
        const SyntaxNode& outer = *node.parent;
        if (!outer.is(Kind::member) || outer.word == nullptr) continue;
        named[outer.word->line].push_back(std::string(node.word_text()) + "." + std::string(outer.word_text()));
    }
    return named;
}

// The values with one of the names, in the order of the names.
std::vector<TracedLines::Value> values_of(const std::vector<std::string>& names,
                                          const std::vector<TracedLines::Value>& values) {
    std::vector<TracedLines::Value> named;
    for (const std::string& name : names) {
        const auto is_it = [&](const TracedLines::Value& each) { return each.name == name; };
        const auto value = std::find_if(values.begin(), values.end(), is_it);
        if (value != values.end() && std::none_of(named.begin(), named.end(), is_it)) named.push_back(*value);
    }
    return named;
}

}  // namespace

void add_texts(TracedLines& traced, const Script& script) {
    struct Text {
        std::string text;
        std::vector<std::string_view> lines;
        std::map<int, std::vector<std::string>> names;
    };
    std::map<std::string, Text> texts;
    for (TracedLines::Line& line : traced.lines) {
        const auto [found, is_new] = texts.try_emplace(line.file);
        Text& text = found->second;
        if (is_new) {
            text.text = script.text_of(line.file);
            text.lines = lines_of(text.text);
            text.names = names_by_line(text.text);
        }
        const auto index = static_cast<std::size_t>(line.line - 1);
        if (index >= text.lines.size()) continue;
        line.text = trimmed(text.lines[index]);
        line.values = values_of(text.names[line.line], line.values);
    }
}

}  // namespace nezumi
