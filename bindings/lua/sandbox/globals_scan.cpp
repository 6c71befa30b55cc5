// A parser that keeps nothing of a program but which names are local where.
#include "bindings/lua/sandbox/globals_scan.hpp"

#include <algorithm>
#include <functional>
#include <unordered_map>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

constexpr std::string_view environment = "_ENV";

class Scanner {
public:
    /// Names that are local at some place, each with how many declarations of it are visible.
    using Locals = std::unordered_map<std::string_view, int>;
    using Visitor = std::function<void(const GlobalUse&, const Locals&)>;

    Scanner(std::string_view source, Visitor visit) : lexer_(without_preamble(source)), visit_(std::move(visit)) {
        token_ = lexer_.next();
        ahead_ = lexer_.next();
    }

    void scan() {
        while (token_.kind != Token::Kind::end) {
            block();
            if (token_.kind != Token::Kind::end) take();  // a stray `end`: no Lua
        }
    }

private:
    // Lua refuses deeper nesting; this is for text that is no Lua.
    static constexpr int depth_limit = 1000;  // of expressions, tables, functions and blocks within each other

    Token take() {
        Token taken = token_;
        token_ = ahead_;
        ahead_ = lexer_.next();
        return taken;
    }
    bool at(std::string_view word) const { return token_.is(word); }
    bool accept(std::string_view word) {
        if (!at(word)) return false;
        take();
        return true;
    }
    void expect(std::string_view word) {
        if (!accept(word)) give_up();
    }
    void give_up() {
        token_ = ahead_ = Token{};
        lexer_ = Lexer({});
    }

    void declare(const Token& name) {
        if (name.text == environment) visit_({name.text, name.line, name.column, false}, locals_);
        declare(name.text);
    }
    void declare(std::string_view name) {
        ++locals_[name];
        declared_.push_back(name);
    }
    void use(const Token& name, bool assigned) {
        const auto found = locals_.find(name.text);
        const bool local = found != locals_.end() && found->second > 0;
        if (!local || name.text == environment) visit_({name.text, name.line, name.column, assigned}, locals_);
    }
    void close_scope(std::size_t declared_before) {
        for (; declared_.size() > declared_before; declared_.pop_back()) --locals_[declared_.back()];
    }

    bool block_ends() const {
        return token_.kind == Token::Kind::end || at("end") || at("else") || at("elseif") || at("until");
    }
    void statements() {
        if (++depth_ > depth_limit) give_up();
        while (!block_ends()) statement();
        --depth_;
    }
    void block() {
        const std::size_t before = declared_.size();
        statements();
        close_scope(before);
    }
    void block_and_end() {
        block();
        expect("end");
    }

    void statement() {
        if (accept(";") || accept("break")) return;
        if (accept("if")) return if_statement();
        if (accept("while")) {
            expression();
            expect("do");
            return block_and_end();
        }
        if (accept("do")) return block_and_end();
        if (accept("for")) return for_statement();
        if (accept("repeat")) return repeat_statement();
        if (accept("function")) return function_statement();
        if (accept("local")) return local_statement();
        if (accept("return")) {
            if (!block_ends() && !at(";")) expressions();
            return;
        }
        if (accept("goto")) {
            take();
            return;
        }
        if (accept("::")) {
            take();
            return expect("::");
        }
        expression_statement();
    }

    void if_statement() {
        do {
            expression();
            expect("then");
            block();
        } while (accept("elseif"));
        if (accept("else")) block();
        expect("end");
    }

    void for_statement() {
        std::vector<Token> names{take()};
        while (accept(",")) names.push_back(take());
        if (!accept("=")) expect("in");
        expressions();
        expect("do");
        const std::size_t before = declared_.size();
        for (const Token& name : names) declare(name);
        block_and_end();
        close_scope(before);
    }

    void repeat_statement() {
        const std::size_t before = declared_.size();
        statements();
        expect("until");
        expression();  // sees the block's locals
        close_scope(before);
    }

    void function_statement() {
        const Token name = take();
        bool plain = true;
        bool method = false;
        while (at(".") || at(":")) {
            method = take().text == ":";
            take();
            plain = false;
        }
        use(name, plain);
        function_body(method);
    }

    void local_statement() {
        if (accept("function")) {
            declare(take());
            return function_body(false);
        }
        std::vector<Token> names;
        do {
            names.push_back(take());
            if (accept("<")) {
                take();
                expect(">");
            }
        } while (accept(","));
        if (accept("=")) expressions();
        for (const Token& name : names) declare(name);
    }

    // A call, or an assignment: then names that stand alone left of the '=' are assigned.
    void expression_statement() {
        std::vector<Token> targets;
        do {
            if (token_.kind == Token::Kind::name && (ahead_.is("=") || ahead_.is(","))) {
                targets.push_back(take());
            } else {
                suffixed_expression();
            }
        } while (accept(","));
        for (const Token& name : targets) use(name, true);
        if (accept("=")) expressions();
    }

    void expressions() {
        do expression();
        while (accept(","));
    }

    void expression() {
        if (++depth_ > depth_limit) give_up();
        do {
            while (at("not") || at("-") || at("#") || at("~")) take();
            simple_expression();
        } while (accept_binary_operator());
        --depth_;
    }

    bool accept_binary_operator() {
        static constexpr std::string_view operators[] = {"+",  "-", "*",  "/",  "//", "^",   "%",
                                                         "&",  "~", "|",  ">>", "<<", "..",  "<",
                                                         "<=", ">", ">=", "==", "~=", "and", "or"};
        return std::any_of(std::begin(operators), std::end(operators), [this](auto word) { return accept(word); });
    }

    void simple_expression() {
        if (token_.kind == Token::Kind::literal || at("nil") || at("true") || at("false") || at("...")) {
            take();
        } else if (accept("function")) {
            function_body(false);
        } else if (at("{")) {
            table();
        } else {
            suffixed_expression();
        }
    }

    void suffixed_expression() {
        if (accept("(")) {
            expression();
            expect(")");
        } else if (token_.kind == Token::Kind::name) {
            use(take(), false);
        } else {
            return give_up();
        }
        for (;;) {
            if (accept(".")) {
                take();
            } else if (accept("[")) {
                expression();
                expect("]");
            } else if (accept(":")) {
                take();
                arguments();
            } else if (at("(") || at("{") || token_.kind == Token::Kind::literal) {
                arguments();
            } else {
                return;
            }
        }
    }

    void arguments() {
        if (accept("(")) {
            if (!at(")")) expressions();
            expect(")");
        } else if (at("{")) {
            table();
        } else {
            take();  // a string
        }
    }

    void table() {
        if (++depth_ > depth_limit) give_up();
        expect("{");
        while (token_.kind != Token::Kind::end && !at("}")) {
            if (accept("[")) {
                expression();
                expect("]");
                expect("=");
            } else if (token_.kind == Token::Kind::name && ahead_.is("=")) {
                take();
                take();
            }
            expression();
            if (!accept(",")) accept(";");
        }
        expect("}");
        --depth_;
    }

    void function_body(bool method) {
        if (++depth_ > depth_limit) give_up();
        const std::size_t before = declared_.size();
        if (method) declare("self");
        expect("(");
        while (token_.kind != Token::Kind::end && !accept(")")) {
            if (!accept("...")) declare(take());
            accept(",");
        }
        block_and_end();
        close_scope(before);
        --depth_;
    }

    Lexer lexer_;
    Visitor visit_;
    Token token_;
    Token ahead_;
    Locals locals_;
    std::vector<std::string_view> declared_;
    int depth_ = 0;
};

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

// What is wrong with a use, or nothing.
std::string complaint(const GlobalUse& use, const Scanner::Locals& locals, const KnownGlobals& known) {
    if (use.name == environment) return "'_ENV' can't be used: globals are known by their names alone";
    if (contains(known.callbacks, use.name)) return {};
    if (contains(known.readable, use.name)) {
        if (!use.assigned) return {};
        return quoted(use.name) + " can't be assigned: it is a word of its own (write 'local " + std::string(use.name) +
               "' for a variable of that name)";
    }
    if (use.name.substr(0, 3) == "on_" && !known.callbacks.empty()) {
        std::string hint = did_you_mean(use.name, known.callbacks);
        if (!hint.empty()) return "unknown callback " + quoted(use.name) + hint;
        for (const std::string_view name : known.callbacks) hint += (hint.empty() ? "" : ", ") + std::string(name);
        return "unknown callback " + quoted(use.name) + " (there are " + hint + ")";
    }
    std::vector<std::string_view> candidates;
    for (const auto& [name, visible] : locals) {
        if (visible > 0) candidates.push_back(name);
    }
    std::sort(candidates.begin(), candidates.end());  // the same hint in every run
    candidates.insert(candidates.end(), known.readable.begin(), known.readable.end());
    candidates.insert(candidates.end(), known.callbacks.begin(), known.callbacks.end());
    std::string hint = did_you_mean(use.name, candidates);
    if (hint.empty() && use.assigned) hint = " (declare it first: local " + std::string(use.name) + ")";
    return "unknown global " + quoted(use.name) + hint;
}

bool comes_before(const Place& a, const Place& b) { return a.line != b.line ? a.line < b.line : a.column < b.column; }

}  // namespace

std::vector<GlobalUse> scan_globals(std::string_view source) {
    std::vector<GlobalUse> uses;
    Scanner(source, [&uses](const GlobalUse& use, const Scanner::Locals&) { uses.push_back(use); }).scan();
    std::stable_sort(uses.begin(), uses.end(), [](const GlobalUse& a, const GlobalUse& b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    return uses;
}

std::vector<Error> check_globals(std::string_view source, const std::string& file, const KnownGlobals& known) {
    constexpr std::size_t most = 1000;
    std::vector<Error> errors;
    Scanner(source, [&](const GlobalUse& use, const Scanner::Locals& locals) {
        if (errors.size() >= most) return;
        std::string text = complaint(use, locals, known);
        if (!text.empty()) errors.push_back({std::move(text), {file, use.line, use.column}});
    }).scan();
    std::stable_sort(errors.begin(), errors.end(),
                     [](const Error& a, const Error& b) { return comes_before(a.place, b.place); });
    return errors;
}

}  // namespace nezumi
