// Splits an expression at `or`, `and`, `not` and the comparisons, by the precedence of Lua's operators.
#include "bindings/scenario/condition_source.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {
namespace {

using Tokens = std::vector<Token>;

struct Span {
    std::size_t begin;
    std::size_t end;
};

std::optional<Comparison::Operator> to_operator(const Token& token) {
    if (token.kind != Token::Kind::sign) return std::nullopt;
    using enum Comparison::Operator;
    for (const auto& [text, op] : {std::pair<std::string_view, Comparison::Operator>{"<", less},
                                   {"<=", less_equal},
                                   {">", greater},
                                   {">=", greater_equal},
                                   {"==", equal},
                                   {"~=", unequal}}) {
        if (token.text == text) return op;
    }
    return std::nullopt;
}

int depth_change(const Token& token) {
    if (token.kind != Token::Kind::sign) return 0;
    if (token.text == "(" || token.text == "[" || token.text == "{") return 1;
    return token.text == ")" || token.text == "]" || token.text == "}" ? -1 : 0;
}

// Collects comparisons, and the pieces of text that are put in the place of others.
class Rewriter {
public:
    Rewriter(const Tokens& tokens, std::string_view source, std::string_view hook)
        : tokens_(tokens), source_(source), hook_(hook) {}

    // `for_true`: the whole does not hold unless this part has the outcome that it needs; `for_false`: likewise.
    void visit(Span span, bool for_true, bool for_false, bool negated = false) {
        if (span.begin >= span.end) return;
        if (const auto parts = split(span, "or"); parts.size() > 1) {
            for (const Span part : parts) visit(part, negated && for_true, !negated && for_false, negated);
        } else if (const auto both = split(span, "and"); both.size() > 1) {
            for (const Span part : both) visit(part, !negated && for_true, negated && for_false, negated);
        } else if (compare(span, for_true, for_false, negated)) {
            return;
        } else if (tokens_[span.begin].is("not")) {
            visit({span.begin + 1, span.end}, for_true, for_false, !negated);
        } else if (tokens_[span.begin].is("(") && closing(span.begin) + 1 == span.end) {
            visit({span.begin + 1, span.end - 1}, for_true, for_false, negated);
        }
    }

    // The text between two places of the source, with what was put into it.
    std::string text(std::size_t begin, std::size_t end) {
        std::sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
        std::string out;
        for (const Edit& edit : edits_) {
            out.append(source_.substr(begin, edit.at - begin)).append(edit.text);
            begin = edit.at + edit.replaced;
        }
        return out.append(source_.substr(begin, end - begin));
    }

    std::vector<Comparison> comparisons;

    std::size_t begin_of(std::size_t token) const {
        return static_cast<std::size_t>(tokens_[token].text.data() - source_.data());
    }
    std::size_t end_of(std::size_t token) const { return begin_of(token) + tokens_[token].text.size(); }

private:
    struct Edit {
        std::size_t at;
        std::size_t replaced;
        std::string text;
    };

    std::vector<Span> split(Span span, std::string_view word) const {
        std::vector<Span> parts{{span.begin, span.end}};
        int depth = 0;
        for (std::size_t i = span.begin; i < span.end; ++i) {
            depth += depth_change(tokens_[i]);
            if (depth != 0 || !tokens_[i].is(word)) continue;
            parts.back().end = i;
            parts.push_back({i + 1, span.end});
        }
        return parts;
    }

    std::size_t closing(std::size_t open) const {
        int depth = 0;
        for (std::size_t i = open; i < tokens_.size(); ++i) {
            depth += depth_change(tokens_[i]);
            if (depth == 0) return i;
        }
        return tokens_.size();
    }

    std::string words(Span span) const {
        std::string out;
        for (std::size_t i = span.begin; i < span.end; ++i) {
            if (i > span.begin && end_of(i - 1) != begin_of(i)) out += ' ';
            out.append(tokens_[i].text);
        }
        return out;
    }

    bool compare(Span span, bool for_true, bool for_false, bool negated) {
        std::vector<std::size_t> found;
        int depth = 0;
        for (std::size_t i = span.begin; i < span.end; ++i) {
            depth += depth_change(tokens_[i]);
            if (depth == 0 && to_operator(tokens_[i])) found.push_back(i);
        }
        if (found.size() != 1 || found.front() == span.begin || found.front() + 1 == span.end) return !found.empty();
        const std::size_t op = found.front();
        Comparison comparison;
        comparison.left = words({span.begin, op});
        comparison.right = words({op + 1, span.end});
        comparison.op = *to_operator(tokens_[op]);
        comparison.unit = unit_of(comparison.left);
        if (comparison.unit.empty()) comparison.unit = unit_of(comparison.right);
        comparison.for_true = for_true;
        comparison.for_false = for_false;
        comparison.negated = negated;
        // The right side stands in parentheses, so that it gives one value.
        const std::string number = std::to_string(comparisons.size());
        edits_.push_back({begin_of(span.begin), 0, std::string(hook_) + "(" + number + ","});
        edits_.push_back({begin_of(op), tokens_[op].text.size(), ",("});
        edits_.push_back({end_of(span.end - 1), 0, "))"});
        comparisons.push_back(std::move(comparison));
        return true;
    }

    const Tokens& tokens_;
    std::string_view source_;
    std::string_view hook_;
    std::vector<Edit> edits_;
};

// The tokens from `function` to its `end`, when it is `function() return EXPRESSION end`.
std::optional<Span> simple_function(const Tokens& tokens, std::size_t at, int last_line) {
    if (at + 5 >= tokens.size() || !tokens[at + 1].is("(") || !tokens[at + 2].is(")") || !tokens[at + 3].is("return"))
        return std::nullopt;
    for (std::size_t i = at + 4; i < tokens.size(); ++i) {
        if (tokens[i].is("function")) return std::nullopt;  // may end anywhere
        if (!tokens[i].is("end")) continue;
        if (tokens[i].line != last_line) return std::nullopt;
        return Span{at, i + 1};
    }
    return std::nullopt;
}

template <class T>
std::string_view unit_in(std::string_view field) {
    std::string_view unit;
    const T example{};
    for_each_field(example, [&](const auto& described, const auto&) {
        if (described.name == field) unit = described.unit;
    });
    return unit;
}

}  // namespace

std::string_view to_text(Comparison::Operator op) {
    constexpr std::string_view texts[] = {"<", "<=", ">", ">=", "==", "~="};
    return texts[static_cast<std::size_t>(op)];
}

ObservedSource observe_comparisons(std::string_view source, int first_line, int last_line, std::string_view hook) {
    source = without_preamble(source);
    Lexer lexer(source);
    Tokens tokens;
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
        if (token.line > last_line) break;
        if (token.line >= first_line) tokens.push_back(token);
    }
    std::optional<Span> found;
    for (std::size_t i = 0; i < tokens.size() && tokens[i].line == first_line; ++i) {
        if (!tokens[i].is("function")) continue;
        const std::size_t open = i + 1 < tokens.size() && tokens[i + 1].kind == Token::Kind::name ? i + 2 : i + 1;
        const bool takes_nothing = open + 1 < tokens.size() && tokens[open].is("(") && tokens[open + 1].is(")");
        if (!takes_nothing) continue;
        if (found) return {};
        found = simple_function(tokens, i, last_line);
        if (!found) return {};
    }
    if (!found) return {};
    Rewriter rewriter(tokens, source, hook);
    Span expression{found->begin + 4, found->end - 1};
    if (tokens[expression.end - 1].is(";")) --expression.end;
    rewriter.visit(expression, true, true);
    if (rewriter.comparisons.empty()) return {};
    return {rewriter.text(rewriter.begin_of(found->begin), rewriter.end_of(found->end - 1)),
            std::move(rewriter.comparisons)};
}

std::string_view unit_of(std::string_view expression) {
    if (expression.find_first_of("*/^%") != std::string_view::npos) return "";
    while (!expression.empty() && expression.back() == ')') expression.remove_suffix(1);
    const std::size_t dot = expression.rfind('.');
    if (dot == std::string_view::npos) return "";
    const std::string_view field = expression.substr(dot + 1);
    if (field == "tm" || field == "age") return "s";
    if (field == "height") return "m";
    if (field == "tilt") return "rad";
    std::string_view unit = unit_in<Velocity2D>(field);
    if (unit.empty()) unit = unit_in<Pose2D>(field);
    if (unit.empty()) unit = unit_in<Point3D>(field);
    return unit;
}

}  // namespace nezumi
