// The reader of Lua's syntax: it agrees with Lua itself, knows what each name means, and where a text breaks off.
#include <catch2/catch.hpp>
#include <filesystem>
#include <random>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/whole_file.hpp"
#include "tests/fuzz/lua_syntax.hpp"

using namespace nezumi;

namespace {

using Kind = SyntaxNode::Kind;

std::vector<std::string> texts_of_files(std::string_view ending) {
    std::vector<std::string> texts;
    for (const char* const folder : {"behaviors", "engine", "tests", "docs"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == ending) texts.push_back(read_whole(entry.path(), "").value());
        }
    }
    return texts;
}

// Every string of a C++ source: many are Lua.
std::vector<std::string> strings_of(const std::string& source) {
    std::vector<std::string> strings;
    for (std::size_t at = 0; at < source.size(); ++at) {
        if (source.compare(at, 3, "R\"(") == 0) {
            const std::size_t end = std::min(source.find(")\"", at), source.size());
            strings.push_back(source.substr(at + 3, end - at - 3));
            at = end + 1;
        } else if (source[at] == '"') {
            std::string text;
            for (++at; at < source.size() && source[at] != '"' && source[at] != '\n'; ++at) {
                if (source[at] == '\\' && ++at < source.size() && source[at] == 'n') {
                    text += '\n';
                } else if (at < source.size()) {
                    text += source[at];
                }
            }
            strings.push_back(std::move(text));
        }
    }
    return strings;
}

// "line:column" of the first token that is refused; "" where there is none.
std::string refused_at(std::string_view text) {
    const SyntaxTree tree(text);
    if (tree.error() == nullptr) return "";
    return std::to_string(tree.error()->line) + ":" + std::to_string(tree.error()->column);
}

bool ends_early(std::string_view text) { return SyntaxTree(text).ends_early(); }

// What each name of the text means: the column of its declaration, or "global".
std::string meanings(std::string_view text) {
    const SyntaxTree tree(text);
    REQUIRE(tree.error() == nullptr);
    std::string all;
    for (const SyntaxNode& node : tree.nodes()) {
        if (!node.is(Kind::name)) continue;
        const std::string meant = node.variable != nullptr ? std::to_string(node.variable->place->column) : "global";
        all += (all.empty() ? "" : " ") + std::string(node.word_text()) + "=" + meant;
    }
    return all;
}

}  // namespace

TEST_CASE("the parser accepts and refuses the same files and texts as Lua", "[lua][syntax]") {
    const LuaReference lua;
    std::size_t taken = 0;
    std::size_t refused = 0;
    const auto compare = [&](std::string_view text) {
        INFO(text);
        REQUIRE(lua.agrees(text));
        ++(lua.says(text).empty() ? taken : refused);
    };
    for (const std::string& text : texts_of_files(".lua")) compare(without_preamble(text));
    CHECK(taken > 100);
    for (const std::string& source : texts_of_files(".cpp")) {
        for (const std::string& text : strings_of(source)) compare(text);
    }
    CHECK(taken > 3000);
    CHECK(refused > 3000);
}

TEST_CASE("the parser accepts and refuses the same randomly changed texts as Lua", "[lua][syntax]") {
    const LuaReference lua;
    const std::string_view words[] = {"and",
                                      "break",
                                      "do",
                                      "else",
                                      "elseif",
                                      "end",
                                      "false",
                                      "for",
                                      "function",
                                      "goto",
                                      "if",
                                      "in",
                                      "local",
                                      "nil",
                                      "not",
                                      "or",
                                      "repeat",
                                      "return",
                                      "then",
                                      "true",
                                      "until",
                                      "while",
                                      "x",
                                      "y",
                                      "::",
                                      "::x::",
                                      "goto x",
                                      "<const>",
                                      "<close>",
                                      "...",
                                      "..",
                                      ".",
                                      ":",
                                      ",",
                                      ";",
                                      "=",
                                      "==",
                                      "~=",
                                      "~",
                                      "!",
                                      "#",
                                      "(",
                                      ")",
                                      "{",
                                      "}",
                                      "[",
                                      "]",
                                      "[[",
                                      "]]",
                                      "'a'",
                                      "'\\q'",
                                      "'\\x1'",
                                      "'\\u{12}'",
                                      "'\\u{80000000}'",
                                      "'\\256'",
                                      "'\\z \n '",
                                      "1",
                                      "0x",
                                      "1e",
                                      "1e5",
                                      "3x",
                                      "0x1p4",
                                      "0x.p1",
                                      ".5",
                                      "5.",
                                      "1..2",
                                      "--[[",
                                      "--[==[",
                                      "-- c\n",
                                      "\n",
                                      "local x <const> = 1",
                                      "x = 1",
                                      "local x",
                                      "function x()",
                                      "+",
                                      "^",
                                      "<",
                                      "<<",
                                      "//",
                                      "\xff",
                                      "\r"};
    const std::vector<std::string> files = texts_of_files(".lua");
    std::mt19937 random(7);
    const auto draw = [&random](std::size_t below) { return static_cast<std::size_t>(random() % below); };
    int taken = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::string text;
        if (round % 2 == 0) {
            for (std::size_t n = draw(12); n > 0; --n) text.append(words[draw(std::size(words))]) += ' ';
        } else {
            const std::string& whole = files[draw(files.size())];
            text = whole.substr(draw(whole.size()), draw(400));
            for (std::size_t n = draw(3); n > 0 && !text.empty(); --n) {
                const std::string_view word = words[draw(std::size(words))];
                text.replace(draw(text.size()), draw(3), " " + std::string(word) + " ");
            }
        }
        INFO(text);
        REQUIRE(lua.agrees(text));
        if (lua.says(text).empty()) ++taken;
    }
    CHECK(taken > 500);
}

TEST_CASE("errors of Lua's compiler beyond the grammar have their locations", "[lua][syntax]") {
    const LuaReference lua;
    const std::pair<const char*, const char*> texts[] = {
        {"break", "1:1"},
        {"do local function f() break end end", "1:23"},
        {"while x do break end break", "1:22"},
        {"goto on", "1:6"},
        {"do goto on end local x ::on:: f()", "1:9"},
        {"do goto on local x ::on:: end", ""},
        {"repeat goto on local x ::on:: until x", "1:13"},
        {"::on:: do ::on:: end", "1:13"},
        {"do ::on:: end ::on::", ""},
        {"::on:: ; ::on::", "1:12"},
        {"local x <const> = 1 x = 2", "1:23"},
        {"local x <const> = 1 function x() end", "1:31"},
        {"local x <const> = 1 return function() x = 2 end", "1:41"},
        {"local x <odd> = 1", "1:10"},
        {"local x <close>, y <close> = 1", "1:21"},
        {"return function() return ... end", "1:26"},
        {"return ...", ""},
        {"f() = 1", "1:5"},
        {"(x) = 1", "1:5"},
        {"x", "1:2"},
        {"return 1 x()", "1:10"},
        {"for x = 1 do end", "1:11"},
        {"for x, y = 1, 2 do end", "1:10"},
        {"if x = 3 then end", "1:6"},
        {"x += 1", "1:3"},
        {"x != 1", "1:3"},
        {"return '\\q'", "1:8"},
        {"return 3x", "1:8"},
    };
    for (const auto& [text, place] : texts) {
        INFO(text);
        CHECK(lua.agrees(text));
        CHECK(refused_at(text) == place);
    }
}

TEST_CASE("an incomplete text is distinguished from a wrong one", "[lua][syntax]") {
    for (const char* text : {"for i = 1, 3 do", "f(", "f(1", "x = {", "[[long", "x = [[long", "--[[ long", "if x then",
                             "function f()", "x = 1 +", "x = 'a", "a.", "a:b", "goto", "local", "x"}) {
        INFO(text);
        CHECK(ends_early(text));
    }
    for (const char* text : {"x = 1", "end", "x = = 1", "f(1))", "x = 'a\n", "break", "", "-- a"}) {
        INFO(text);
        CHECK_FALSE(ends_early(text));
    }
}

TEST_CASE("a comment at the end of a text is detected", "[lua][syntax]") {
    for (const char* text : {"-- a", "x = 1 --[a]", "--[[ a", "--[==[ a ]=]", "--"})
        CHECK(SyntaxTree(text).ends_in_comment());
    for (const char* text : {"", "-- a\n", "--[[ a ]]", "--[==[ a ]==]", "-- a\nx", "'-- a'"})
        CHECK_FALSE(SyntaxTree(text).ends_in_comment());
}

TEST_CASE("each name means the same variable as in Lua", "[lua][syntax]") {
    CHECK(meanings("local x = x x = 1") == "x=global x=7");
    CHECK(meanings("local x; do local x = x f(x) end f(x)") == "x=7 f=global x=19 f=global x=7");
    CHECK(meanings("local function f(f) f() end f()") == "f=18 f=16");
    CHECK(meanings("for i = i, 2 do f(i) end f(i)") == "i=global f=global i=5 f=global i=global");
    CHECK(meanings("repeat local x until x") == "x=14");
    CHECK(meanings("function t:m() return self end return self") == "t=global self=13 self=global");
}

TEST_CASE("only the console accepts a keyword after a dot as a name", "[lua][syntax]") {
    CHECK(refused_at("x = controller.in") == "1:16");
    const SyntaxTree tree("x = controller.in.value", SyntaxTree::Dialect::console);
    CHECK(tree.error() == nullptr);
    const auto chain = name_chain(*tree.root().child->last->child);
    REQUIRE(chain);
    CHECK(*chain == std::vector<std::string>{"controller", "in", "value"});
}

TEST_CASE("the text of a node is complete", "[lua][syntax]") {
    const SyntaxTree tree("local a = b.c [1] -- more\nreturn f(a, -1), { x = 2 }");
    std::vector<std::string> texts;
    for (const SyntaxNode& node : tree.nodes()) {
        if (node.is(Kind::subscript) || node.is(Kind::call) || node.is(Kind::unary) || node.is(Kind::field) ||
            node.is(Kind::local))
            texts.emplace_back(node.text());
    }
    CHECK(texts == std::vector<std::string>{"local a = b.c [1]", "b.c [1]", "f(a, -1)", "-1", "x = 2"});
}

TEST_CASE("the depth of nesting is limited", "[lua][syntax]") {
    const LuaReference lua;
    for (const std::string open : {"(", "{", "f(", "function() return ", "do ", "not ", "x.", "a..", "if x then "}) {
        for (const int depth : {10, 90, 100'000}) {
            std::string text = open == "do " || open == "if x then " ? "" : "return ";
            for (int i = 0; i < depth; ++i) text += open;
            INFO(open << " " << depth);
            CHECK(lua.agrees(text));
            CHECK(SyntaxTree(text).error() != nullptr);
        }
    }
    std::string chain = "return x";
    for (int i = 0; i < 100'000; ++i) chain += ".x";
    CHECK(SyntaxTree(chain).error() == nullptr);
    CHECK(lua.agrees(chain));
}
