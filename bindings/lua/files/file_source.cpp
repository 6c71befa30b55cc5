// Scans Lua for table constructors and notes where each field stands.
#include "bindings/lua/files/file_source.hpp"

#include <algorithm>
#include <utility>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {

struct FileSource::Node {
    std::string key;  // of a field; of a call the word
    int line = 0;
    int column = 0;
    std::vector<std::unique_ptr<Node>> children;

    const Node* child(std::string_view name) const {
        const auto found =
            std::find_if(children.begin(), children.end(), [&](const auto& node) { return node->key == name; });
        return found == children.end() ? nullptr : found->get();
    }
    Node* add(std::string name, int at_line, int at_column) {
        children.push_back(std::make_unique<Node>());
        Node& node = *children.back();
        node.key = std::move(name);
        node.line = at_line;
        node.column = at_column;
        return &node;
    }
};

namespace {

bool is_string(const Token& token) {
    return token.kind == Token::Kind::literal &&
           (token.text.front() == '"' || token.text.front() == '\'' || token.text.front() == '[');
}

// What a short string literal says, but for its escapes.
std::string_view unquoted(std::string_view literal) {
    return literal.size() >= 2 ? literal.substr(1, literal.size() - 2) : literal;
}

}  // namespace

class FileSource::Scanner {
public:
    Scanner(std::string_view text, Node& calls) : lexer_(text), calls_(calls) {}

    void run() {
        for (Token token = lexer_.next(); token.kind != Token::Kind::end; token = lexer_.next()) {
            if (token.is("{")) {
                open_table(token);
            } else if (token.is("(") || token.is("[")) {
                frames_.push_back({Frame::Kind::round, nullptr, caller(), 0});
            } else if (token.is("}") || token.is(")") || token.is("]")) {
                close(token);
            } else if (token.is("function") || token.is("if") || token.is("do") || token.is("repeat")) {
                frames_.push_back({Frame::Kind::block, nullptr, {}, 0});
            } else if (token.is("end") || token.is("until")) {
                if (!frames_.empty() && frames_.back().kind == Frame::Kind::block) frames_.pop_back();
            } else if (token.is("=") && in_table()) {
                note_key();
            } else if ((token.is(",") || token.is(";")) && in_table()) {
                end_element();
            }
            before_ = std::exchange(last_, token);
            if (in_table() && frames_.back().fresh && !last_.is("{") && !last_.is(",") && !last_.is(";")) {
                frames_.back().fresh = false;
                frames_.back().first = last_;
            }
        }
    }

private:
    struct Frame {
        enum class Kind { round, table, block } kind;
        Node* node;             // of a table: where its fields go; may be null
        Token word;             // of a round bracket: whose call it is
        int elements;           // of a table: how many elements are complete
        bool fresh = true;      // of a table: the next token begins an entry
        bool keyed = false;     // of a table: this entry has a key
        Token first{};          // of a table: the first token of this entry
        Node* value = nullptr;  // of a table: the node of this entry, when it is known
    };

    bool in_table() const { return !frames_.empty() && frames_.back().kind == Frame::Kind::table; }

    // The word that is called by what comes next: `word {`, `word "name" {`, `word("name") {`, `word(`.
    Token caller() const {
        if (last_.kind == Token::Kind::name) return last_;
        if (is_string(last_) && before_.kind == Token::Kind::name) return before_;
        if (last_.is(")")) return closed_;
        return {};
    }

    void open_table(const Token& brace) {
        Token word = caller();
        Node* node = nullptr;
        if (word.kind != Token::Kind::name && !frames_.empty() && frames_.back().kind == Frame::Kind::round)
            word = frames_.back().word;
        const bool called = word.kind == Token::Kind::name && !last_.is("=");
        if (called) {
            node = calls_.add(std::string(word.text), word.line, word.column);
        } else if (in_table()) {
            node = entry_node(brace);
        }
        frames_.push_back({Frame::Kind::table, node, {}, 0});
    }

    // The node of the entry that is being read: its key's, or a new one for an element.
    Node* entry_node(const Token& token) {
        Frame& table = frames_.back();
        if (table.node == nullptr) return nullptr;
        if (table.value == nullptr) {
            const Token& at = table.fresh ? token : table.first;
            table.value = table.node->add("[" + std::to_string(table.elements + 1) + "]", at.line, at.column);
        }
        return table.value;
    }

    void note_key() {
        Frame& table = frames_.back();
        const bool bracketed = last_.is("]");
        const Token& key = bracketed ? closed_ : last_;
        table.keyed = true;
        if (table.node == nullptr || (key.kind != Token::Kind::name && !is_string(key))) return;
        table.value =
            table.node->add(std::string(is_string(key) ? unquoted(key.text) : key.text), key.line, key.column);
    }

    void end_element() {
        Frame& table = frames_.back();
        if (!table.keyed) {
            if (!table.fresh) entry_node(last_);
            ++table.elements;
        }
        table.fresh = true;
        table.keyed = false;
        table.value = nullptr;
    }

    void close(const Token& token) {
        if (frames_.empty() || frames_.back().kind == Frame::Kind::block) return;
        if (token.is("}") && in_table() && !frames_.back().fresh && !frames_.back().keyed) entry_node(last_);
        // After `]` the key within, after `)` the word that was called.
        closed_ = token.is("]") ? last_ : frames_.back().word;
        frames_.pop_back();
    }

    Lexer lexer_;
    Node& calls_;
    std::vector<Frame> frames_;
    Token last_;
    Token before_;
    Token closed_;
};

std::string to_text(const FieldPath& path) {
    std::string text;
    for (const std::string& part : path) {
        if (!text.empty() && !part.starts_with('[')) text += '.';  // a person's own name may be empty
        text += part;
    }
    return text;
}

FileSource::FileSource(std::string_view text, std::string shown)
    : shown_(std::move(shown)), calls_(std::make_unique<Node>()) {
    Scanner(text, *calls_).run();
}

FileSource::~FileSource() = default;
FileSource::FileSource(FileSource&&) noexcept = default;
FileSource& FileSource::operator=(FileSource&&) noexcept = default;

Place FileSource::find(std::string_view word, const Place& call, const FieldPath& path) const {
    if (call.file != shown_) return call;
    const Node* best = nullptr;
    std::size_t best_depth = 0;
    for (const auto& candidate : calls_->children) {
        if (candidate->key != word || candidate->line != call.line) continue;
        const Node* node = candidate.get();
        std::size_t depth = 0;
        for (const Node* child = node; depth < path.size(); ++depth, node = child) {
            child = node->child(path[depth]);
            if (child == nullptr) break;
        }
        if (best == nullptr || depth > best_depth) {
            best = node;
            best_depth = depth;
        }
    }
    if (best == nullptr || best_depth == 0) return call;
    return {call.file, best->line, best->column};
}

}  // namespace nezumi
