// Completes the text before the cursor with names of the running system.
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "bindings/console/command_offers.hpp"
#include "bindings/console/console_commands.hpp"
#include "bindings/console/cursor_text.hpp"
#include "bindings/console/input_text.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) { return contains(words, word); }

Names table_keys(lua_State* L, int table) {
    Names names;
    if (push_behind_lock(L, table)) table = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        const std::string_view key = text_at(L, -2);
        if (is_identifier(key)) names.emplace_back(key);
    }
    return names;
}

// Follows a chain of names through Lua's globals to an object, without running any Lua.
class Walk {
public:
    explicit Walk(Session::Parts& parts, const Names& chain)
        : parts_(parts), lua_(parts.state->lua()), top_(lua_gettop(lua_)), chain_(chain) {
        if (chain.empty() || lua_checkstack(lua_, 20) == 0 || !begin()) return;
        while (lua_type(lua_, -1) == LUA_TTABLE && rest_ < chain.size()) {
            if (!push_raw(chain[rest_++])) return;
        }
        found_ = true;
    }
    ~Walk() { lua_settop(lua_, top_); }
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;

    /// The members of the object that the chain leads to: those after a dot, or after a colon if it is called. For
    /// plots, also the fields of a port's value: `plot(controller.out.vx)`.
    Names names(TreeNode::Called called, bool plotted = false) {
        if (found_ && lua_type(lua_, -1) == LUA_TTABLE) return table_keys(lua_, lua_gettop(lua_));
        if (const ObjectRef* ref = object(); ref != nullptr && ref->kind >= ObjectKind::hosts)
            return names_of_host(*ref, called, plotted);
        return parts_.at_system([&] {
            const auto node = this->node(plotted);
            if (!node) return Names{};
            if (node->kind() == TreeNode::Kind::system)
                return called == TreeNode::Called::no ? names_of(node->system()) : Names{};
            return plotted && node->kind() == TreeNode::Kind::port ? node->step("value")->children()
                                                                   : node->children(called);
        });
    }

    /// The tree's node for the chain; nothing if there is none.
    std::optional<TreeNode> node(bool plotted = false) const {
        auto node = start();
        for (std::size_t i = rest_; node && i < chain_.size(); ++i)
            node = plotted ? node->step(chain_[i]) : node->child(chain_[i]);
        return node ? std::make_optional(*node) : std::nullopt;
    }

private:
    // Pushes the value of the first name onto the stack, or finds a component with this name.
    bool begin() {
        rest_ = 1;
        lua_pushglobaltable(lua_);
        if (push_raw(chain_.front())) return true;
        push_commands_table(lua_);
        if (push_raw(chain_.front())) return true;
        rest_ = 0;
        return false;
    }

    const ObjectRef* object() const { return found_ ? to_object(lua_, -1) : nullptr; }

    Expected<TreeNode> start() const {
        if (rest_ == 0 && !chain_.empty()) return parts_.live.tree();
        const ObjectRef* ref = object();
        return ref != nullptr ? node_of(*ref) : failure("");
    }

    // This system knows the hosts and their components. For the members of a component it asks the host.
    Names names_of_host(const ObjectRef& ref, TreeNode::Called called, bool plotted) const {
        Names steps;
        if (ref.kind == ObjectKind::host) steps = {std::string(ref.component())};
        if (ref.kind == ObjectKind::remote)
            steps = {std::string(host_of(ref.component())), std::string(without_host(ref.component()))};
        if (!ref.port().empty()) steps.emplace_back(ref.port());
        steps.insert(steps.end(), chain_.begin() + static_cast<std::ptrdiff_t>(rest_), chain_.end());
        if (steps.size() < 2) {
            if (called == TreeNode::Called::yes) return {};
            return parts_.at_system([&] {
                if (steps.empty()) return host_names(parts_.live.system());
                const auto host = find_host(parts_.live.system(), steps[0]);
                return host ? component_names(*host) : Names{};
            });
        }
        Question question{.host = steps[0], .component = steps[1], .what = Question::What::names};
        for (std::size_t i = 2; i < steps.size(); ++i) question.name = join_path(question.name, steps[i]);
        if (plotted) question.values.values.emplace_back(true);
        const auto answer = ask_host(*parts_.objects, parts_.live, question);
        const std::size_t which = called == TreeNode::Called::yes ? 1 : 0;
        const auto* names = answer && answer->values.size() == 2 ? answer->values[which].get_if<Names>() : nullptr;
        return names != nullptr ? *names : Names{};
    }

    // Replaces the table on top of the stack by its field; removes it if there is no such field.
    bool push_raw(const std::string& name) const {
        if (push_behind_lock(lua_, -1)) lua_remove(lua_, -2);
        lua_pushnil(lua_);
        while (lua_next(lua_, -2) != 0) {
            if (lua_type(lua_, -2) == LUA_TSTRING && text_at(lua_, -2) == name) {
                lua_replace(lua_, -3);
                lua_pop(lua_, 1);
                return true;
            }
            lua_pop(lua_, 1);
        }
        lua_pop(lua_, 1);
        return false;
    }

    Session::Parts& parts_;
    lua_State* lua_;
    int top_;
    const Names& chain_;
    std::size_t rest_ = 0;  // index of the first name that is not a global or a command
    bool found_ = false;    // there is a value on top of the stack
};

// The fields of a table that is the value of a port, `port:write { v`, `inject("name.port", { v`, or the argument of a
// word of system files, `behavior "name" { s`.
Names field_names(Session::Parts& parts, const FieldAtCursor& field) {
    const TextAtCursor& call = field.call;
    Names chain;
    if (Names fields = field.path.empty() ? fields_of_table(call) : Names{}; !fields.empty()) return fields;
    if (call.callee.separator == ':' && call.argument == 1 && is_one_of(call.word, {"write", "inject", "hold"})) {
        chain = call.callee.chain;
    } else if (offer_at(call) == Offer::value) {
        chain = call.first_chain;
        const std::size_t dot = call.first.find('.');
        if (chain.empty() && dot != std::string::npos) chain = {call.first.substr(0, dot), call.first.substr(dot + 1)};
    }
    const Walk walk(parts, chain);
    return parts.at_system([&] {
        auto node = walk.node();
        if (!node || node->kind() != TreeNode::Kind::port) return Names{};
        Expected<TreeNode> place = node->child("value");
        for (std::size_t i = 0; place && i < field.path.size(); ++i) place = place->child(field.path[i]);
        return place ? place->children() : Names{};
    });
}

// The parameter sets of the component that a chain of names leads to.
Names set_names(Session::Parts& parts, const Names& chain) {
    const Walk walk(parts, chain);
    return parts.at_system([&] {
        Names sets;
        const auto node = walk.node();
        if (!node || node->kind() != TreeNode::Kind::component) return sets;
        for (const auto& [name, values] : node->component()->sets) sets.push_back(name);
        return sets;
    });
}

// The files for `behavior "name" { script = "`.
Names script_names(Session::Parts& parts) {
    const auto at = parts.at_system([&] {
        return std::make_optional(std::pair{parts.live.project(), parts.live.spec().file});
    });
    return at ? at->first.names(FileKind::script, at->second) : Names{};
}

}  // namespace

Completion complete(Session::Parts& parts, std::string_view text, std::size_t cursor) {
    text = text.substr(0, cursor);
    Completion completion{text.size(), {}};
    if (parts.state->is_lost()) return completion;
    const CursorText at_cursor(text);
    if (at_cursor.in_comment()) return completion;
    const TextAtCursor quoted = at_cursor.quoted();
    if (quoted.open && quoted.word == "use" && quoted.callee.separator == ':') {
        completion.from = quoted.from;
        completion.candidates = set_names(parts, quoted.callee.chain);
    } else if (quoted.open && quoted.word == "behavior" && quoted.field == "script") {
        completion.from = quoted.from;
        completion.candidates = script_names(parts);
    } else if (quoted.open) {
        completion.from = quoted.from;
        completion.candidates = parts.at_system([&] { return texts_at(parts.live.system(), quoted); });
    } else {
        const NameAtCursor name = at_cursor.name();
        completion.from = name.from;
        const FieldAtCursor field = name.separator == 0 ? at_cursor.field() : FieldAtCursor{};
        Names fields = field.open ? field_names(parts, field) : Names{};
        if (!fields.empty()) {
            completion.candidates = std::move(fields);
        } else if (name.separator == 0) {
            completion.candidates = names_in_scope(parts);
            if (name.from < text.size())
                completion.candidates.insert(completion.candidates.end(), lua_keywords().begin(), lua_keywords().end());
        } else if (!name.broken) {
            const TextAtCursor call = at_cursor.call();
            const auto called = name.separator == ':' ? TreeNode::Called::yes : TreeNode::Called::no;
            completion.candidates =
                Walk(parts, name.chain).names(called, takes_values(call.word) && call.callee.separator == 0);
        }
    }
    Names& all = completion.candidates;
    const std::string_view part = text.substr(completion.from);
    std::erase_if(all, [&](const std::string& name) { return !name.starts_with(part); });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return completion;
}

}  // namespace nezumi
