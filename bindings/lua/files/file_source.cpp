// Scans Lua for table constructors and notes where each field stands.
#include "bindings/lua/files/file_source.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

bool is_string(const Token& token) {
    return token.kind == Token::Kind::literal &&
           (token.text.front() == '"' || token.text.front() == '\'' || token.text.front() == '[');
}

// What a short string literal says, but for its escapes.
std::string_view unquoted(std::string_view literal) {
    return literal.size() >= 2 ? literal.substr(1, literal.size() - 2) : literal;
}

// What a literal says; nothing when that is not plain.
std::optional<FileValue> value_of(const Token& token) {
    if (token.is("nil")) return FileValue{};
    if (token.is("true") || token.is("false")) return FileValue{token.is("true")};
    if (token.kind != Token::Kind::literal) return std::nullopt;
    if (is_string(token)) {
        if (token.text.front() == '[' || token.text.find('\\') != std::string_view::npos) return std::nullopt;
        return FileValue{std::string(unquoted(token.text))};
    }
    double number = 0;
    const char* const end = token.text.data() + token.text.size();
    const auto read = std::from_chars(token.text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    return FileValue{number};
}

std::optional<double> number_of(const FileValue& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
    if (const auto* number = std::get_if<double>(&value.data)) return *number;
    return std::nullopt;
}

// Whether a literal gives this value; null: no value.
bool gives(const FileValue& literal, const FileValue* value) {
    if (value == nullptr || literal.is_nil()) return value == nullptr && literal.is_nil();
    if (const auto number = number_of(literal)) return number_of(*value) == number;
    if (const auto* text = literal.text()) return value->text() != nullptr && *value->text() == *text;
    const auto* truth = std::get_if<bool>(&value->data);
    return truth != nullptr && *truth == std::get<bool>(literal.data);
}

}  // namespace

struct FileSource::Node {
    std::string key;  // of a field; of a call the word
    int line = 0;
    int column = 0;
    std::vector<std::unique_ptr<Node>> children;
    std::optional<FileValue> literal;  // of a field that is one; of a call the name before its table
    bool is_table = false;             // of a field: it is a table, as calls are, and nothing else
    bool has_more = false;             // of a table: not all of its keys can be read off the text

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

    // Whether a call of this text may have been given this.
    bool may_be(const GivenTable& given) const {
        if (literal && !given.name.empty() && *literal->text() != given.name) return false;
        return given.table == nullptr || may_give(given.table);
    }

private:
    // Whether the text of a field may give this value: its literals do, and it has all that a table has. Null: none.
    bool may_give(const FileValue* value) const {
        if (literal && !is_table) return gives(*literal, value);
        if (!is_table) return true;
        const FileTable* table = value != nullptr ? value->table() : nullptr;
        if (table == nullptr) return false;
        std::size_t elements = 0;
        bool may_go_on = false;
        for (const auto& each : children) {
            const bool is_element = each->key.starts_with('[');
            const bool is_there = is_element && elements < table->elements.size();
            if (!each->may_give(is_there ? &table->elements[elements] : table->find(each->key))) return false;
            if (!is_element) continue;
            ++elements;
            may_go_on = !each->literal && !each->is_table;  // a call that comes last gives many
        }
        return has_more || ((may_go_on || table->elements.size() <= elements) &&
                            std::all_of(table->fields.begin(), table->fields.end(),
                                        [&](const FileField& field) { return child(field.name) != nullptr; }));
    }
};

class FileSource::Scanner {
public:
    Scanner(std::string_view text, Node& calls) : lexer_(text), calls_(calls) {}

    void run() {
        for (Token token = lexer_.next(); token.kind != Token::Kind::end; token = lexer_.next()) {
            if (token.is("{")) {
                open_table(token);
            } else if (token.is("(") || token.is("[")) {
                frames_.push_back({Frame::Kind::round, nullptr, caller()});
            } else if (token.is("}") || token.is(")") || token.is("]")) {
                close(token);
            } else if (token.is("function") || token.is("if") || token.is("do") || token.is("repeat")) {
                frames_.push_back({Frame::Kind::block});
            } else if (token.is("end") || token.is("until")) {
                if (!frames_.empty() && frames_.back().kind == Frame::Kind::block) frames_.pop_back();
            } else if (token.is("=") && in_table()) {
                note_key();
            } else if (token.is(",") || token.is(";")) {
                end_entry();
            }
            before_ = std::exchange(last_, token);
            if (!frames_.empty()) frames_.back().note(last_);
        }
    }

private:
    // What is called, and the text that it is given first; of a key in brackets the text alone.
    struct Call {
        Token word{}, name{};
    };
    // An entry is a field of a table, or an argument within a round bracket.
    struct Frame {
        enum class Kind { round, table, block } kind;
        Node* node = nullptr;   // of a table: where its fields go; may be null
        Call call{};            // of a round bracket: whose it is
        int elements = 0;       // how many elements, or arguments, are complete
        bool fresh = true;      // the next token begins an entry
        bool keyed = false;     // of a table: this entry has a key
        int tokens = 0;         // of this entry, behind its key; a bracket with what is within counts as one
        Token first{};          // the first token of this entry
        Node* value = nullptr;  // of a table: the node of this entry, when it is known

        void note(const Token& token) {
            if (token.is("{") || token.is("(") || token.is("[") || token.is(",") || token.is(";")) return;
            if (std::exchange(fresh, false)) first = token;
            tokens = token.is("=") ? 0 : tokens + 1;
        }
    };

    bool in(Frame::Kind kind) const { return !frames_.empty() && frames_.back().kind == kind; }
    bool in_table() const { return in(Frame::Kind::table); }

    // Who is called by what comes next: `word {`, `word "name" {`, `word("name") {`, `word(`.
    Call caller() const {
        if (last_.kind == Token::Kind::name) return {last_};
        if (is_string(last_) && before_.kind == Token::Kind::name) return {before_, last_};
        if (last_.is(")")) return closed_;
        return {};
    }

    void open_table(const Token& brace) {
        Call call = caller();
        Node* node = nullptr;
        if (call.word.kind != Token::Kind::name && in(Frame::Kind::round)) call = frames_.back().call;
        const bool called = call.word.kind == Token::Kind::name && !last_.is("=");
        if (called) {
            node = calls_.add(std::string(call.word.text), call.word.line, call.word.column);
            node->is_table = true;
            if (is_string(call.name)) node->literal = value_of(call.name);
        } else if (in_table()) {
            node = entry_node(brace);
        }
        frames_.push_back({Frame::Kind::table, node});
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
        const Token& key = last_.is("]") ? closed_.name : last_;
        table.keyed = true;
        if (table.node == nullptr) return;
        if (key.kind != Token::Kind::name && !is_string(key)) {
            table.node->has_more = true;
            return;
        }
        table.value =
            table.node->add(std::string(is_string(key) ? unquoted(key.text) : key.text), key.line, key.column);
    }

    void end_entry() {
        if (in_table()) {
            end_field();
        } else if (in(Frame::Kind::round)) {
            end_argument();
        }
    }

    void end_argument() {
        Frame& bracket = frames_.back();
        if (++bracket.elements == 1 && bracket.tokens == 1 && is_string(last_)) bracket.call.name = last_;
        bracket.tokens = 0;
    }

    void end_field() {
        Frame& table = frames_.back();
        if (!table.keyed) {
            if (!table.fresh) entry_node(last_);
            ++table.elements;
        }
        if (table.value != nullptr) {
            table.value->is_table = table.tokens == 1 && last_.is("}");
            if (table.tokens == 1) table.value->literal = value_of(last_);
            if (table.tokens == 2 && before_.is("-")) table.value->literal = negative(value_of(last_));
        }
        table.fresh = true;
        table.keyed = false;
        table.tokens = 0;
        table.value = nullptr;
    }

    static std::optional<FileValue> negative(const std::optional<FileValue>& value) {
        const auto number = value ? number_of(*value) : std::nullopt;
        return number ? std::optional(FileValue{-*number}) : std::nullopt;
    }

    void close(const Token& token) {
        if (frames_.empty() || frames_.back().kind == Frame::Kind::block) return;
        if (in(Frame::Kind::round) || (token.is("}") && !frames_.back().fresh)) end_entry();
        closed_ = frames_.back().call;
        frames_.pop_back();
    }

    Lexer lexer_;
    Node& calls_;
    std::vector<Frame> frames_;
    Token last_;
    Token before_;
    Call closed_;
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

Place FileSource::find(std::string_view word, const Place& call, const FieldPath& path, const GivenTable& given) const {
    if (call.file != shown_) return call;
    std::vector<const Node*> begun;
    for (const auto& each : calls_->children) {
        if (each->key == word && each->line == call.line) begun.push_back(each.get());
    }
    // Lua only knows the line: which of several calls it was is seen by what it was given.
    if (begun.size() > 1) std::erase_if(begun, [&](const Node* each) { return !each->may_be(given); });
    if (begun.size() != 1) return call;
    const Node* const whole = begun.front();
    const Node* best = whole;
    for (const std::string& part : path) {
        const Node* const child = best->child(part);
        if (child == nullptr) break;
        best = child;
    }
    return best == whole ? call : Place{call.file, best->line, best->column};
}

}  // namespace nezumi
