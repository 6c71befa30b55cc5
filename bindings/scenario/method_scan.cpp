// Follows a scenario through the tokens of a file: from the function that gets it, under further names, into the
// functions that are handed it.
#include "bindings/scenario/method_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "bindings/lua/sandbox/lexer.hpp"

namespace nezumi {
namespace {

using Kind = Token::Kind;

class Scan {
public:
    Scan(std::string_view text, const std::string& shown, const std::vector<std::string_view>& methods)
        : shown_(shown), methods_(methods) {
        Lexer lexer(without_preamble(text));
        do tokens_.push_back(lexer.next());
        while (tokens_.back().kind != Kind::end);
    }

    std::vector<Error> run() {
        find_functions();
        for (std::size_t i = 0; i < size(); ++i) {
            if (is_call(i, "scenario")) follow_scenario(i + 1);
        }
        while (!objects_.empty()) {
            const Object object = objects_.back();
            objects_.pop_back();
            look_at(object);  // which finds further ones
        }
        const auto by_place = [](const Error& a, const Error& b) {
            return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
        };
        std::sort(errors_.begin(), errors_.end(), by_place);
        return std::move(errors_);
    }

private:
    /// A name that is a scenario from a token on to the end of its block.
    struct Object {
        std::string_view name;
        std::size_t from;
    };
    struct Function {
        std::vector<std::string_view> parameters;
        std::size_t body;  // the token after the parameters
    };

    std::size_t size() const { return tokens_.size() - 1; }
    // The end for whatever lies beyond it, as for what is before the start.
    const Token& at(std::size_t i) const { return tokens_[std::min(i, size())]; }
    const Token& before(std::size_t i) const { return i == 0 ? tokens_.back() : at(i - 1); }
    bool is_name(std::size_t i) const {
        return at(i).kind == Kind::name && !before(i).is(".") && !before(i).is(":") && !before(i).is("goto");
    }
    bool is_name(std::size_t i, std::string_view name) const { return is_name(i) && at(i).text == name; }
    bool is_call(std::size_t i, std::string_view name) const {
        return is_name(i, name) && at(i + 1).is("(") && !before(i).is("function");
    }
    bool opens_block(std::size_t i) const {
        return at(i).is("function") || at(i).is("do") || at(i).is("if") || at(i).is("repeat");
    }
    bool closes_block(std::size_t i) const { return at(i).is("end") || at(i).is("until"); }
    // An `else` ends a block and begins one.
    bool ends_branch(std::size_t i) const { return at(i).is("else") || at(i).is("elseif"); }

    // The token that ends the block in which `i` lies.
    std::size_t end_of_block(std::size_t i) const {
        for (int blocks = 1; i < size(); ++i) {
            if (opens_block(i)) ++blocks;
            if ((closes_block(i) && --blocks == 0) || (ends_branch(i) && blocks == 1)) break;
        }
        return i;
    }

    // Where each argument of a call begins, `i` being its bracket, and last the bracket that ends it.
    std::vector<std::size_t> arguments(std::size_t i) const {
        std::vector<std::size_t> begins{i + 1};
        for (int depth = 0; i < size(); ++i) {
            const bool opens = at(i).is("(") || at(i).is("{") || at(i).is("[") || opens_block(i);
            const bool closes = at(i).is(")") || at(i).is("}") || at(i).is("]") || closes_block(i);
            if (opens) ++depth;
            if (closes && --depth == 0) break;
            if (depth == 1 && at(i).is(",")) begins.push_back(i + 1);
        }
        begins.push_back(i);
        return begins;
    }

    // `i`: the bracket before the parameters.
    Function function_at(std::size_t i) const {
        Function function{{}, i};
        if (!at(i).is("(")) return function;
        for (; i < size() && !at(i).is(")"); ++i) {
            if (at(i).kind == Kind::name) function.parameters.push_back(at(i).text);
        }
        function.body = i + 1;
        return function;
    }

    // `function NAME(` and `NAME = function(`. Of a name that several have it is not known which is meant.
    void find_functions() {
        std::set<std::string_view> several;
        const auto add = [&](std::string_view name, std::size_t bracket) {
            if (!functions_.emplace(name, function_at(bracket)).second) several.insert(name);
        };
        for (std::size_t i = 0; i < size(); ++i) {
            if (at(i).is("function") && is_name(i + 1) && at(i + 2).is("(")) add(at(i + 1).text, i + 2);
            if (is_name(i) && at(i + 1).is("=") && at(i + 2).is("function")) add(at(i).text, i + 3);
        }
        for (const std::string_view name : several) functions_.erase(name);
    }

    // `bracket`: the one after `scenario`. Its last argument is a function, or the name of one.
    void follow_scenario(std::size_t bracket) {
        const auto places = arguments(bracket);
        const std::size_t last = places[places.size() - 2];
        if (at(last).is("function")) {
            follow(function_at(last + 1), 0);
        } else if (last + 1 == places.back()) {
            follow(last, 0);
        }
    }

    // The function with the name at `i` is given the scenario as its argument of this number, from 0.
    void follow(std::size_t i, std::size_t argument) {
        if (!is_name(i)) return;
        if (const auto found = functions_.find(at(i).text); found != functions_.end()) follow(found->second, argument);
    }
    void follow(const Function& function, std::size_t argument) {
        if (argument < function.parameters.size()) add({function.parameters[argument], function.body});
    }
    void add(Object object) {
        if (seen_.emplace(object.name, object.from).second) objects_.push_back(object);
    }

    // The names that the statement at `i` declares for what comes after it: `local a, b`, `local function a`.
    std::vector<std::string_view> declared_at(std::size_t i, std::size_t& after) const {
        std::vector<std::string_view> names;
        after = i + 1;
        if (at(after).is("function")) ++after;
        while (at(after).kind == Kind::name) {
            names.push_back(at(after).text);
            ++after;
            if (at(after).is("<")) after += 3;  // an attribute
            if (!at(after).is(",")) break;
            ++after;
        }
        return names;
    }

    // Where the part ends in which the name means something else, if it begins at `i`.
    std::optional<std::size_t> hidden_from(std::size_t i, std::string_view name) const {
        const auto has = [&](const std::vector<std::string_view>& names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        std::size_t after = i;
        if (at(i).is("local")) {
            if (has(declared_at(i, after))) return end_of_block(i + 1);
        } else if (at(i).is("for")) {
            if (!has(declared_at(i, after))) return std::nullopt;
            while (after < size() && !at(after).is("do")) ++after;
            return end_of_block(after + 1) + 1;
        } else if (at(i).is("function")) {
            while (after < size() && !at(after).is("(")) ++after;
            const Function function = function_at(after);
            if (has(function.parameters)) return end_of_block(function.body) + 1;
        }
        return std::nullopt;
    }

    void look_at(const Object& object) {
        int blocks = 1;
        int tables = 0;
        for (std::size_t i = object.from; i < size(); ++i) {
            if (const auto end = hidden_from(i, object.name)) {
                look_at_alias(i, object);  // as in `local s = s`
                i = *end - 1;
                continue;
            }
            if (opens_block(i)) ++blocks;
            if ((closes_block(i) && --blocks == 0) || (ends_branch(i) && blocks == 1)) return;
            tables += at(i).is("{") ? 1 : at(i).is("}") ? -1 : 0;
            look_at_alias(i, object);
            if (at(i).kind == Kind::name && at(i + 1).is("(")) look_at_call(i, object);
            if (!is_name(i, object.name)) continue;
            if (at(i + 1).is("=") && tables == 0) return;  // from here on it is something else
            if (at(i + 1).is(":")) look_at_method(object, at(i + 2));
        }
    }

    void look_at_method(const Object& object, const Token& method) {
        if (method.kind != Kind::name || std::binary_search(methods_.begin(), methods_.end(), method.text)) return;
        errors_.push_back({unknown_method(object.name, method.text, methods_), {shown_, method.line, method.column}});
    }

    // `local w = s`
    void look_at_alias(std::size_t i, const Object& object) {
        if (!at(i).is("local")) return;
        std::size_t sign = 0;
        const auto names = declared_at(i, sign);
        if (names.size() != 1 || !at(sign).is("=") || !is_name(sign + 1, object.name)) return;
        const Token& next = at(sign + 2);
        const bool goes_on = next.kind == Kind::literal || (next.kind == Kind::sign && !next.is(";"));
        const bool is_operand = next.is("and") || next.is("or");
        if (!goes_on && !is_operand) add({names.front(), sign + 2});
    }

    // `help(1, s)`
    void look_at_call(std::size_t i, const Object& object) {
        if (before(i).is("function") || functions_.count(at(i).text) == 0) return;
        const auto places = arguments(i + 1);
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            const bool is_alone = at(places[k] + 1).is(",") || places[k] + 1 == places.back();
            if (is_name(places[k], object.name) && is_alone) follow(i, k);
        }
    }

    const std::string& shown_;
    const std::vector<std::string_view>& methods_;
    std::vector<Token> tokens_;  // the last one is the end
    std::map<std::string_view, Function> functions_;
    std::vector<Object> objects_;  // to be looked at
    std::set<std::pair<std::string_view, std::size_t>> seen_;
    std::vector<Error> errors_;
};

}  // namespace

std::string unknown_method(std::string_view object, std::string_view name,
                           const std::vector<std::string_view>& methods) {
    const std::string text = fmt::format("{} has no '{}'", object, shown(name));
    if (name == "seed") return text + ": the option seed = N of the scenario gives its runs one, and s.seed reads it";
    return text + did_you_mean(name, methods);
}

std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods) {
    return Scan(text, shown, methods).run();
}

}  // namespace nezumi
