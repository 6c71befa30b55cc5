// The tokens of an OMG IDL file in order, with an error for the first token that does not fit.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/messages/idl_lexer.hpp"

namespace nezumi {

/// The current token of a parser. After the first error there are no more tokens.
class IdlTokens {
protected:
    using Kind = IdlToken::Kind;

    void fail(std::string text, int line = 0) {
        if (!error_) error_ = Error{std::move(text), {source_->shown, line > 0 ? line : token_.line}};
        token_ = {.kind = Kind::end, .line = token_.line};
    }
    void step() {
        if (error_) return;
        token_ = lexer_->next();
        if (token_.kind == Kind::wrong) fail(fmt::format("expected {}", token_.text));
    }
    bool is(std::string_view text) const {
        return (token_.kind == Kind::word || token_.kind == Kind::sign) && token_.text == text;
    }
    bool take(std::string_view text) {
        if (!is(text)) return false;
        step();
        return true;
    }
    std::string found() const { return token_.kind == Kind::end ? "the end" : fmt::format("'{}'", shown(token_.text)); }
    void expect(std::string_view text) {
        if (!take(text)) fail(fmt::format("expected '{}', got {}", text, found()));
    }
    std::string take_name() {
        if (token_.kind != Kind::word) return fail(fmt::format("expected a name, got {}", found())), "";
        std::string name(token_.text);
        step();
        return name;
    }

    const SourceText* source_ = nullptr;
    IdlLexer* lexer_ = nullptr;
    IdlToken token_;
    std::optional<Error> error_;
};

}  // namespace nezumi
