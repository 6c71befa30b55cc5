// Follows the tokens of each scenario's function from its parameters to its end.
#include "bindings/scenario/method_scan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

using Kind = Token::Kind;

bool is_name(const Token& token, std::string_view name) { return token.kind == Kind::name && token.text == name; }

class Scan {
public:
    Scan(std::string_view text, const std::string& shown, const std::vector<std::string_view>& methods)
        : lexer_(without_preamble(text)), shown_(shown), methods_(methods) {
        next();
    }

    std::vector<Error> run() {
        while (at_.kind != Kind::end) {
            const bool begins = is_name(at_, "scenario");
            next();
            if (begins && at_.is("(")) look_at_scenario();
        }
        return std::move(errors_);
    }

private:
    void next() {
        before_ = at_;
        at_ = lexer_.next();
    }

    // From the bracket after `scenario` to the end of its function.
    void look_at_scenario() {
        int depth = 0;
        for (; at_.kind != Kind::end; next()) {
            if (at_.is("(") || at_.is("{")) ++depth;
            if ((at_.is(")") || at_.is("}")) && --depth == 0) return;
            if (depth == 1 && at_.is("function")) break;
        }
        next();
        if (!at_.is("(")) return;
        next();
        if (at_.kind != Kind::name) return;
        const std::string_view object = at_.text;
        while (at_.kind != Kind::end && !at_.is(")")) next();
        next();
        look_at_body(object);
    }

    void look_at_body(std::string_view object) {
        bool declares = false;  // names, in a statement or as parameters
        for (int blocks = 1; at_.kind != Kind::end; next()) {
            if (at_.is("function") || at_.is("do") || at_.is("if") || at_.is("repeat")) ++blocks;
            if ((at_.is("end") || at_.is("until")) && --blocks == 0) return;
            if (at_.is("local") || at_.is("for") || at_.is("function")) {
                declares = true;
            } else if (at_.is("=") || at_.is("in") || at_.is(")") || (at_.kind == Kind::keyword && declares)) {
                declares = false;
            }
            if (!is_name(at_, object) || before_.is(".") || before_.is(":")) continue;
            if (declares) return;
            next();
            if (!at_.is(":")) continue;
            next();
            if (at_.kind == Kind::name && !std::binary_search(methods_.begin(), methods_.end(), at_.text)) {
                errors_.push_back({unknown_method(object, at_.text, methods_), {shown_, at_.line, at_.column}});
            }
        }
    }

    Lexer lexer_;
    const std::string& shown_;
    const std::vector<std::string_view>& methods_;
    Token before_;
    Token at_;
    std::vector<Error> errors_;
};

}  // namespace

std::string unknown_method(std::string_view object, std::string_view name,
                           const std::vector<std::string_view>& methods) {
    const std::string text = fmt::format("{} has no '{}'", object, shown(name));
    if (name == "seed") return text + ": the seed of a run is that of the session, which nezumi test --seed N sets";
    return text + did_you_mean(name, methods);
}

std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods) {
    return Scan(text, shown, methods).run();
}

}  // namespace nezumi
