// Stacks of visible variables and labels.
#include "bindings/lua/syntax/scopes.hpp"

#include <algorithm>

namespace nezumi {

void Scopes::open_function(bool takes_more) {
    functions_.push_back({takes_more, labels_.size()});
    blocks_.push_back({false, true, visible_.size(), labels_.size(), jumps_.size()});
}

void Scopes::close_function(const Token* at) {
    close_block(at);
    functions_.pop_back();
}

void Scopes::open_block(bool is_loop) {
    blocks_.push_back({is_loop, false, visible_.size(), labels_.size(), jumps_.size()});
}

void Scopes::close_block(const Token* at) {
    const Block block = blocks_.back();
    for (; visible_.size() > block.locals; visible_.pop_back()) {
        visible_.back()->to = at;
        by_name_[visible_.back()->name].pop_back();
    }
    if (block.is_loop) resolve_jumps("break", block.locals);
    labels_.resize(block.labels);
    blocks_.pop_back();
    for (std::size_t i = block.jumps; i < jumps_.size(); ++i) jumps_[i].locals = block.locals;
    if (!block.is_function) return;
    for (std::size_t i = block.jumps; i < jumps_.size(); ++i) refuse(jumps_[i].name);
    jumps_.resize(block.jumps);
}

LocalName* Scopes::declare(std::string_view name, const Token* place, const Token* from, bool constant) {
    LocalName* const local = &locals_.emplace_back(LocalName{name, place, from, nullptr, constant});
    visible_.push_back(local);
    by_name_[name].push_back(local);
    return local;
}

const LocalName* Scopes::find(std::string_view name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() || found->second.empty() ? nullptr : found->second.back();
}

void Scopes::add_goto(const Token* name) {
    const auto begin = labels_.begin() + static_cast<std::ptrdiff_t>(functions_.back().first_label);
    const auto is_it = [name](const Label& label) { return label.name == name->text; };
    if (std::find_if(begin, labels_.end(), is_it) == labels_.end()) jumps_.push_back({name, visible_.size()});
}

void Scopes::add_break(const Token* keyword) { jumps_.push_back({keyword, visible_.size()}); }

void Scopes::add_label(const Token* name, bool is_last) {
    const auto begin = labels_.begin() + static_cast<std::ptrdiff_t>(functions_.back().first_label);
    const auto is_it = [name](const Label& label) { return label.name == name->text; };
    if (std::find_if(begin, labels_.end(), is_it) != labels_.end()) refuse(name);
    // After the last statement, the variables of the block are no longer visible.
    const std::size_t locals = is_last ? blocks_.back().locals : visible_.size();
    labels_.push_back({name->text, locals});
    resolve_jumps(name->text, locals);
}

void Scopes::refuse(const Token* token) {
    if (error_ == nullptr || token < error_) error_ = token;
}

// Resolves the jumps of the innermost block that wait for this label. The label must not be in the scope of a variable
// that the jump does not see.
void Scopes::resolve_jumps(std::string_view name, std::size_t locals) {
    std::size_t kept = blocks_.back().jumps;
    for (std::size_t i = kept; i < jumps_.size(); ++i) {
        if (jumps_[i].name->text != name) {
            jumps_[kept++] = jumps_[i];
        } else if (jumps_[i].locals < locals) {
            refuse(jumps_[i].name);
        }
    }
    jumps_.resize(kept);
}

}  // namespace nezumi
