// One pass over the text.
#include "engine/messages/idl_lexer.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// A line of a comment without slashes, stars and tags.
std::string_view plain_line(std::string_view line) {
    line = trimmed(line, " \t\r\n*/!<");
    for (const std::string_view tag : {"@brief", "\\brief"}) {
        if (line.starts_with(tag)) line = trimmed(line.substr(tag.size()));
    }
    return line;
}

void add_lines(std::string& comment, std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = plain_line(text.substr(0, end));
        if (!line.empty()) comment += (comment.empty() ? "" : " ") + std::string(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

}  // namespace

void IdlLexer::to_end_of_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

bool IdlLexer::skip_comment(std::string& comment) {
    const std::string_view rest = text_.substr(at_);
    const std::size_t begin = at_;
    if (rest.starts_with("//")) {
        to_end_of_line();
        add_lines(comment, text_.substr(begin, at_ - begin));
        return true;
    }
    if (!rest.starts_with("/*")) return false;
    const std::size_t end = text_.find("*/", at_ + 2);
    is_cut_off_ = end == std::string_view::npos;
    at_ = end == std::string_view::npos ? text_.size() : end + 2;
    const std::string_view all = text_.substr(begin, at_ - begin);
    line_ += static_cast<int>(std::count(all.begin(), all.end(), '\n'));
    add_lines(comment, all);
    return true;
}

void IdlLexer::skip_conditional() {
    for (int depth = 1; depth > 0 && at_ < text_.size();) {
        ++at_;
        ++line_;
        const std::size_t begin = at_;
        to_end_of_line();
        const std::string_view line = trimmed(text_.substr(std::min(begin, text_.size()), at_ - std::min(begin, at_)));
        if (line.starts_with("#if")) ++depth;
        if (line.starts_with("#endif") || (line.starts_with("#else") && depth == 1)) --depth;
    }
}

std::string_view IdlLexer::read_directive() {
    const std::size_t begin = at_;
    to_end_of_line();
    std::string_view line = trimmed(text_.substr(begin + 1, at_ - begin - 1));
    // Skips text that is only for certain compilers.
    if (line.starts_with("ifdef") || line.starts_with("if ")) skip_conditional();
    if (!line.starts_with("include")) return {};
    line = trimmed(line.substr(7));
    const std::size_t end = line.find_first_of("\">", 1);
    return end == std::string_view::npos ? "" : line.substr(1, end - 1);
}

void IdlLexer::skip(std::string& comment) {
    int empty_lines = 0;
    while (at_ < text_.size() && include_.empty()) {
        const char c = text_[at_];
        if (c == '\n') {
            ++line_;
            ++at_;
            // A comment that is followed by an empty line documents nothing.
            if (++empty_lines > 1) comment.clear();
        } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            ++at_;
        } else if (c == '#') {
            include_ = read_directive();
            comment.clear();
        } else if (skip_comment(comment)) {
            empty_lines = 0;
        } else {
            return;
        }
    }
}

IdlToken IdlLexer::next() {
    IdlToken token;
    skip(token.comment);
    token.line = line_;
    if (!include_.empty()) {
        token.kind = IdlToken::Kind::include;
        token.text = include_;
        include_ = {};
        return token;
    }
    if (is_cut_off_) {
        token.kind = IdlToken::Kind::wrong;
        token.text = "the end of a comment";
        return token;
    }
    if (at_ >= text_.size()) return token;
    const std::size_t begin = at_;
    const char c = text_[at_++];
    if (c == '"' || c == '\'') {
        while (at_ < text_.size() && text_[at_] != c && text_[at_] != '\n') at_ += text_[at_] == '\\' ? 2 : 1;
        at_ = std::min(at_, text_.size());
        if (at_ == text_.size() || text_[at_] != c) {
            token.kind = IdlToken::Kind::wrong;
            token.text = "the end of a string";
            return token;
        }
        ++at_;
        token.kind = IdlToken::Kind::text;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 ||
               (c == '.' && at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)) {
        const auto goes_on = [&](char each) {
            const char before = text_[at_ - 1];
            return is_word(each) || each == '.' || ((each == '-' || each == '+') && (before == 'e' || before == 'E'));
        };
        while (at_ < text_.size() && goes_on(text_[at_])) ++at_;
        token.kind = IdlToken::Kind::number;
    } else if (is_word(c)) {
        while (at_ < text_.size() && is_word(text_[at_])) ++at_;
        token.kind = IdlToken::Kind::word;
    } else {
        if (c == ':' && at_ < text_.size() && text_[at_] == ':') ++at_;
        token.kind = IdlToken::Kind::sign;
    }
    token.text = text_.substr(begin, at_ - begin);
    return token;
}

std::string IdlLexer::comment_behind() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string comment;
    std::size_t place = text_.find_first_not_of(" \t\r", at_);
    if (place == std::string_view::npos || place >= end || text_[place] != '/') return comment;
    // A comment that continues on the next line belongs to the next token.
    if (text_.substr(place).starts_with("/*") && text_.find("*/", place) > end) return comment;
    const std::size_t before = std::exchange(at_, place);
    if (!skip_comment(comment)) at_ = before;
    return comment;
}

}  // namespace nezumi
