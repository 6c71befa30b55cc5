// At the same place, texts are inserted in the order in which they were added, before the token that is replaced.
#include "bindings/lua/syntax/text_edits.hpp"

#include <algorithm>
#include <utility>

namespace nezumi {

void TextEdits::replace(const Token& token, std::string text) {
    edits_.push_back({tree_.offset(token), token.text.size(), std::move(text)});
}

void TextEdits::remove(const Token* first, const Token* end) {
    for (; first != end; ++first) replace(*first, "");
}

void TextEdits::insert_before(const Token& token, std::string text) {
    edits_.push_back({tree_.offset(token), 0, std::move(text)});
}

void TextEdits::insert_after(const Token& token, std::string text) {
    edits_.push_back({tree_.offset(token) + token.text.size(), 0, std::move(text)});
}

std::string TextEdits::text() const {
    std::vector<Edit> sorted = edits_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Edit& a, const Edit& b) { return a.at != b.at ? a.at < b.at : a.size < b.size; });
    std::string text;
    std::size_t done = 0;
    for (const Edit& each : sorted) {
        text += tree_.source().substr(done, each.at - done);
        text += each.text;
        done = each.at + each.size;
    }
    return text += tree_.source().substr(done);
}

}  // namespace nezumi
