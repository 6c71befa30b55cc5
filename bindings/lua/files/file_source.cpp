// Visits the table arguments of calls, and stores the location of each field.
#include "bindings/lua/files/file_source.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/number_in.hpp"
#include "engine/records/file_table.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

// The value of a literal; nothing for strings with escapes or in long brackets, and for other tokens.
std::optional<Value> value_of(const Token& token) {
    if (token.is("nil")) return Value{};
    if (token.is("true") || token.is("false")) return Value{token.is("true")};
    if (token.kind == Token::Kind::string) {
        if (token.text.front() == '[' || token.text.find('\\') != std::string_view::npos) return std::nullopt;
        return Value{std::string(token.inside())};
    }
    const auto number = number_in<double>(token.text);
    if (token.kind != Token::Kind::number || !number) return std::nullopt;
    return Value{*number};
}

// The value of an expression: a literal, or a number with a minus sign.
std::optional<Value> value_of(const SyntaxNode& expression) {
    if (expression.is(Kind::literal)) return value_of(*expression.first);
    if (!expression.is(Kind::unary) || !expression.word->is("-") || !expression.child->is(Kind::literal))
        return std::nullopt;
    const auto value = value_of(*expression.child->first);
    const auto number = value ? number_of(*value) : std::nullopt;
    return number ? std::optional(Value{-*number}) : std::nullopt;
}

// The tables that an expression may have as its value: itself, or operands of it.
std::vector<const SyntaxNode*> tables_of(const SyntaxNode& expression) {
    std::vector<const SyntaxNode*> tables;
    std::vector<const SyntaxNode*> waiting{&expression};
    while (!waiting.empty()) {
        const SyntaxNode& node = *waiting.back();
        waiting.pop_back();
        if (node.is(Kind::table)) tables.push_back(&node);
        if (!node.is(Kind::binary)) continue;
        waiting.push_back(node.last);
        waiting.push_back(node.child);
    }
    return tables;
}

// Whether a literal has this value. `value` is null if there is none, which equals the literal nil.
bool gives(const Value& literal, const Value* value) {
    if (value == nullptr || literal.is_nothing()) return value == nullptr && literal.is_nothing();
    if (const auto number = number_of(literal)) return number_of(*value) == number;
    if (const auto* text = literal.get_if<std::string>())
        return value->get_if<std::string>() != nullptr && *value->get_if<std::string>() == *text;
    const auto* truth = value->get_if<bool>();
    return truth != nullptr && *truth == literal.get<bool>();
}

}  // namespace

struct FileSource::Node {
    std::string key;  // the name of a field, or the word of a call
    int line = 0;
    int column = 0;
    std::vector<std::unique_ptr<Node>> children;
    std::optional<Value> literal;  // the value of a field that is a literal; of a call the name before its table
    bool is_table = false;         // of a field: it is a table or a call, and nothing else
    bool has_more = false;         // of a table: the text does not show all of its keys

    const Node* child(std::string_view name) const {
        const auto found =
            std::find_if(children.begin(), children.end(), [&](const auto& node) { return node->key == name; });
        return found == children.end() ? nullptr : found->get();
    }
    Node* add(std::string name, const Token& place) {
        children.push_back(std::make_unique<Node>());
        Node& node = *children.back();
        node.key = std::move(name);
        node.line = place.line;
        node.column = place.column;
        return &node;
    }

    // Whether this call in the text may be the one that had these arguments.
    bool may_be(const GivenTable& given) const {
        if (literal && !given.name.empty() && *literal->get_if<std::string>() != given.name) return false;
        return given.table == nullptr || may_give(given.table);
    }

private:
    // Whether the text of a field may have this value: its literals are equal, and all fields of a table are there.
    // `value` is null if the field has no value.
    bool may_give(const Value* value) const {
        if (literal && !is_table) return gives(*literal, value);
        if (!is_table) return true;
        const FileTable* table = value != nullptr ? value->get_if<FileTable>() : nullptr;
        if (table == nullptr) return false;
        std::size_t elements = 0;
        bool may_go_on = false;
        for (const auto& each : children) {
            const bool is_element = each->key.starts_with('[');
            const bool is_there = is_element && elements < table->elements.size();
            if (!each->may_give(is_there ? &table->elements[elements] : table->find(each->key))) return false;
            if (!is_element) continue;
            ++elements;
            may_go_on = !each->literal && !each->is_table;  // a call in the last position may return several values
        }
        return has_more || ((may_go_on || table->elements.size() <= elements) &&
                            std::all_of(table->fields.begin(), table->fields.end(),
                                        [&](const FileField& field) { return child(field.name) != nullptr; }));
    }
};

// Stores the table arguments of calls, and their fields.
class FileSource::Reader {
public:
    static void read_call(const SyntaxNode& call, Node& calls) {
        const SyntaxNode& called = *call.child;
        const SyntaxNode* const given = call.last;
        // `robot "m" { }`: word and name belong to the call that gets the table.
        const bool is_second = called.is(Kind::call) || called.is(Kind::method_call);
        const SyntaxNode& first = is_second ? called : call;
        const Token* const word = first.is(Kind::method_call) ? first.word : first.child->word;
        const bool has_word =
            first.is(Kind::method_call) || first.child->is(Kind::name) || first.child->is(Kind::member);
        if (!has_word || word == nullptr || given == &called) return;
        const SyntaxNode* const name = first.last->child;
        for (const SyntaxNode& argument : *given) {
            for (const SyntaxNode* const table : tables_of(argument)) {
                Node* const node = calls.add(std::string(word->text), *word);
                node->is_table = true;
                if (name != nullptr && name->string()) node->literal = value_of(*name);
                read_table(*table, *node);
            }
        }
    }

private:
    static void read_table(const SyntaxNode& table, Node& into) {
        int elements = 0;
        for (const SyntaxNode& entry : table) {
            const SyntaxNode& value = *entry.last;
            std::string key;
            const Token* place = value.first;
            if (entry.is(Kind::element)) {
                key = "[" + std::to_string(++elements) + "]";
            } else {
                const auto text = entry.is(Kind::field) ? std::optional(entry.word_text()) : entry.child->string();
                if (!text) {
                    into.has_more = true;
                    continue;
                }
                key = *text;
                place = entry.is(Kind::field) ? entry.word : entry.child->first;
            }
            Node& node = *into.add(std::move(key), *place);
            node.is_table = value.is(Kind::table);
            node.literal = value_of(value);
            for (const SyntaxNode* const each : tables_of(value)) read_table(*each, node);
        }
    }
};

FileSource::FileSource(std::string_view text, std::string shown)
    : shown_(std::move(shown)), calls_(std::make_unique<Node>()) {
    const SyntaxTree tree(without_preamble(text));
    for (const SyntaxNode& node : tree.nodes()) {
        if (node.is(Kind::call) || node.is(Kind::method_call)) Reader::read_call(node, *calls_);
    }
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
    // Lua knows only the line; the arguments tell which of several calls it was.
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
