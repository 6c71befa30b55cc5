// Edits of a source text that keep the numbers of its lines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

/// Edits that do not overlap. Their texts must not contain line ends.
class TextEdits {
public:
    /// The tree must outlive the edits.
    explicit TextEdits(const SyntaxTree& tree) : tree_(tree) {}

    void replace(const Token& token, std::string text);
    /// Removes the tokens from `first` on, before `end`. Blanks and comments between them stay.
    void remove(const Token* first, const Token* end);
    void insert_before(const Token& token, std::string text);
    void insert_after(const Token& token, std::string text);

    bool empty() const { return edits_.empty(); }
    /// The text with all edits.
    std::string text() const;

private:
    struct Edit {
        std::size_t at;
        std::size_t size;
        std::string text;
    };

    const SyntaxTree& tree_;
    std::vector<Edit> edits_{};
};

}  // namespace nezumi
