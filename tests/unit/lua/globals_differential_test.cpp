// The reader's globals against Lua's own compiler, over random programs.
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <random>
#include <set>

#include "sandbox_support.hpp"

namespace nezumi {
namespace {

// The globals that Lua's own compiler sees, from a chunk's bytecode: every constant that GETTABUP
// and SETTABUP name. Reads Lua 5.4's format far enough for that.
class BytecodeReader {
public:
    explicit BytecodeReader(const std::string& bytecode) : bytes_(bytecode) { at_ = 4 + 1 + 1 + 6 + 3 + 8 + 8 + 1; }
    std::multiset<std::string> read() {
        function();
        return names_;
    }

private:
    std::size_t number() {
        std::size_t value = 0;
        for (;;) {
            const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
            value = value << 7 | (byte & 0x7f);
            if ((byte & 0x80) != 0) return value;
        }
    }
    std::string text() {
        const std::size_t size = number();
        if (size == 0) return {};
        at_ += size - 1;
        return bytes_.substr(at_ - (size - 1), size - 1);
    }
    void function() {
        text();
        number();
        number();
        at_ += 3;
        std::vector<std::uint32_t> code(number());
        std::memcpy(code.data(), &bytes_.at(at_), code.size() * 4);
        at_ += code.size() * 4;
        std::vector<std::string> constants(number());
        for (std::string& constant : constants) {
            switch (bytes_.at(at_++)) {
                case 3:
                case 19: at_ += 8; break;
                case 4:
                case 20: constant = text(); break;
                default: break;
            }
        }
        std::vector<bool> is_environment(number());
        at_ += is_environment.size() * 3;
        const std::size_t functions = number();
        for (std::size_t i = 0; i < functions; ++i) function();
        const std::size_t lines = number();
        at_ += lines;
        for (std::size_t n = number(); n > 0; --n) {
            number();
            number();
        }
        for (std::size_t n = number(); n > 0; --n) {
            text();
            number();
            number();
        }
        const std::size_t named = number();
        for (std::size_t i = 0; i < named; ++i) is_environment.at(i) = text() == "_ENV";
        for (std::size_t i = 0; i < code.size(); ++i) {
            constexpr std::uint32_t load_constant = 3, get_upvalue = 9, get_table_up = 11, set_table_up = 15;
            const std::uint32_t op = code[i] & 0x7f, a = code[i] >> 7 & 0xff, b = code[i] >> 16 & 0xff,
                                c = code[i] >> 24;
            if (op == get_table_up && is_environment.at(b)) names_.insert(constants.at(c));
            if (op == set_table_up && is_environment.at(a)) names_.insert(constants.at(b));
            if (op == get_upvalue && is_environment.at(b)) {
                REQUIRE((code.at(i + 1) & 0x7f) == load_constant);
                names_.insert(constants.at(code.at(i + 1) >> 15));
            }
        }
    }

    const std::string& bytes_;
    std::size_t at_;
    std::multiset<std::string> names_;
};

// Random programs that compile.
class ProgramWriter {
public:
    explicit ProgramWriter(unsigned seed) : random_(seed) {}
    std::string program() {
        text_.clear();
        block(0);
        return text_;
    }

private:
    std::size_t draw(std::size_t below) { return random_() % below; }
    void put(const std::string& text) { text_ += text + (draw(5) == 0 ? "\n" : " "); }
    std::string name() {
        static const std::string names[] = {
            "a", "b", "c", "d", "self", "x1", "_", "a_name_that_is_longer_than_forty_characters_so_it_is_long"};
        return names[draw(std::size(names))];
    }
    void block(int depth) {
        put("do");
        for (std::size_t n = draw(5); n > 0; --n) statement(depth + 1);
        put("end");
    }
    void names(std::size_t most) {
        put(name());
        for (std::size_t n = draw(most); n > 0; --n) put(", " + name());
    }
    void expressions(int depth) {
        expression(depth);
        if (draw(3) == 0) {
            put(",");
            expression(depth);
        }
    }
    void body(int depth) {
        put("(");
        if (draw(2) == 0) names(2);
        put(")");
        for (std::size_t n = draw(3); n > 0; --n) statement(depth + 1);
        if (draw(2) == 0) {
            put("return");
            expressions(depth + 1);
        }
        put("end");
    }
    void statement(int depth) {
        if (depth > 6) return put(";");
        switch (draw(13)) {
            case 0: return block(depth);
            case 1:
                put("local");
                names(3);
                put("=");
                expressions(depth);
                put(";");
                return;
            case 2: put("local function " + name()); return body(depth);
            case 3:
                put("function " + name() + (draw(3) == 0 ? "." + name() : "") + (draw(3) == 0 ? ":" + name() : ""));
                return body(depth);
            case 4:
                put("if");
                expression(depth);
                put("then");
                statement(depth + 1);
                put("else");
                statement(depth + 1);
                put("end");
                return;
            case 5:
                put("while");
                expression(depth);
                put("do");
                statement(depth + 1);
                put("end");
                return;
            case 6:
                put("repeat");
                statement(depth + 1);
                put("until");
                expression(depth);
                put(";");
                return;
            case 7:
                put("for " + name() + " =");
                expression(depth);
                put(",");
                expression(depth);
                put("do");
                statement(depth + 1);
                put("end");
                return;
            case 8:
                put("for");
                names(2);
                put("in");
                expressions(depth);
                put("do");
                statement(depth + 1);
                put("end");
                return;
            case 9:
                names(2);
                put("=");
                expressions(depth);
                put(";");
                return;
            case 10:
                put(name() + "." + name() + ", " + name() + " =");
                expressions(depth);
                put(";");
                return;
            case 11:
                put("local " + name() + " <const> = 1;");
                put("-- " + name() + "\n");
                return;
            default:
                put(name() + ":" + name() + "(");
                expressions(depth);
                put(");");
                return;
        }
    }
    void expression(int depth) {
        if (depth > 8) return put(name());
        switch (draw(12)) {
            case 0: put("function"); return body(depth);
            case 1:
                put("{ " + name() + " =");
                expression(depth + 1);
                put(", [");
                expression(depth + 1);
                put("] =");
                expression(depth + 1);
                put(";");
                expression(depth + 1);
                put("}");
                return;
            case 2:
                put("(");
                expression(depth + 1);
                put(")");
                return;
            case 3:
                put(name() + "." + name() + "[");
                expression(depth + 1);
                put("]");
                return;
            case 4: put(name() + " 'a " + name() + "'"); return;
            case 5:
                put("not");
                expression(depth + 1);
                return;
            case 6:
                expression(depth + 1);
                put("+");
                expression(depth + 1);
                return;
            case 7:
                expression(depth + 1);
                put("..");
                expression(depth + 1);
                put("==");
                expression(depth + 1);
                return;
            case 8: put("0x1F"); return;
            default: put(name()); return;
        }
    }
    std::mt19937 random_;
    std::string text_;
};

TEST_CASE("the globals that are found are exactly those that Lua's compiler finds", "[lua][syntax]") {
    ProgramWriter writer(12345);
    int compiled = 0;
    for (int round = 0; round < 3000; ++round) {
        const std::string source = writer.program();
        const auto chunk = compile(source, "a.lua");
        if (!chunk) continue;  // an assignment to a constant, too many levels
        ++compiled;
        std::set<std::string> expected;
        for (const std::string& name : BytecodeReader(chunk->bytecode).read()) expected.insert(name);
        std::set<std::string> found;
        const SyntaxTree tree(source);
        for (const GlobalUse& use : global_uses(tree)) {
            found.insert(std::string(use.name()));
            const Token& place = *use.node->first;
            const std::size_t line_start = [&] {
                std::size_t at = 0;
                for (int line = 1; line < place.line; ++line) at = source.find('\n', at) + 1;
                return at;
            }();
            REQUIRE(tree.offset(place) == line_start + static_cast<std::size_t>(place.column) - 1);
        }
        CAPTURE(source);
        REQUIRE(found == expected);
    }
    CHECK(compiled > 2000);
}

}  // namespace
}  // namespace nezumi
