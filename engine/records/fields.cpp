// Checks of fields, and their messages.
#include "engine/records/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/list.hpp"

namespace nezumi {
namespace {

const FileTable& empty_table() {
    static const FileTable table;
    return table;
}

// The error if the value is not a number for this field, or "".
std::string read_number(const Value& value, const Rule& rule, std::string_view unit, double& out) {
    const auto number = number_of(value);
    if (!number) return fmt::format("expected {}, got {}", words_for(rule), kind_of(value));
    out = *number;
    return check_number(out, rule, unit);
}

}  // namespace

void FieldCheck::keep(int gravity, Error error) {
    if (gravity <= gravity_) return;
    gravity_ = gravity;
    error_ = std::move(error);
}

void FieldCheck::unknown(const FieldPath& path, std::string_view hint) {
    keep(3, {fmt::format("{}: unknown {} '{}'{}", what_, noun_, to_text(path), hint), place_of(path)});
}

void FieldCheck::wrong(const FieldPath& path, std::string_view text) {
    keep(2, {fmt::format("{}: {} '{}' {}", what_, noun_, to_text(path), text), place_of(path)});
}

void FieldCheck::explain(const FieldPath& path, std::string_view text) {
    keep(2, {fmt::format("{}: {} '{}': {}", what_, noun_, to_text(path), text), place_of(path)});
}

void FieldCheck::missing(const FieldPath& path, std::string_view expected) {
    keep(1,
         {fmt::format("{}: {} '{}' is missing: expected {}", what_, noun_, to_text(path), expected), place_of(path)});
}

void FieldCheck::wrong_at(const FieldPath& path, std::string_view text) {
    keep(2, {fmt::format("{}: {}", what_, text), place_of(path)});
}

void FieldCheck::wrong(Error error) { keep(2, std::move(error)); }

Expected<void> FieldCheck::result() const {
    if (ok()) return {};
    return Unexpected(error_);
}

Fields::Fields(FieldCheck& check, const Value& value, FieldPath path)
    : check_(check), table_(value.get_if<FileTable>()), path_(std::move(path)) {
    if (table_ != nullptr) return;
    table_ = &empty_table();
    if (value.is_nothing()) return;
    const std::string text = fmt::format("{}expected a table, got {}",
                                         path_.empty() && check_.noun() == "option" ? "options " : "", kind_of(value));
    path_.empty() ? check_.wrong_at(path_, text) : check_.wrong(path_, text);
}

FieldPath Fields::path_of(std::string_view name) const {
    FieldPath path = path_;
    path.emplace_back(name);
    return path;
}

const Value* Fields::field(std::string_view name) {
    add_once(asked_, name);
    return table_->find(name);
}

bool Fields::boolean(std::string_view name, bool& out) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    if (const bool* truth = value->get_if<bool>()) {
        out = *truth;
        return true;
    }
    check_.wrong(path_of(name), fmt::format("expected true or false, got {}", kind_of(*value)));
    return false;
}

bool Fields::number(std::string_view name, double& out, const Rule& rule, std::string_view unit) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    double number = 0;
    const std::string problem = read_number(*value, rule, unit, number);
    if (problem.empty()) {
        out = number;
        return true;
    }
    check_.wrong(path_of(name), problem);
    return false;
}

bool Fields::whole(std::string_view name, std::int64_t& out, std::int64_t min, std::int64_t max) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    const auto* whole = value->get_if<std::int64_t>();
    const auto* number = value->get_if<double>();
    std::string got = kind_of(*value);
    if (whole != nullptr && *whole >= min && *whole <= max) {
        out = *whole;
        return true;
    }
    if (number != nullptr && *number == std::floor(*number) && *number >= static_cast<double>(min) &&
        *number <= static_cast<double>(max)) {
        out = static_cast<std::int64_t>(*number);
        return true;
    }
    if (whole != nullptr) got = fmt::format("{}", *whole);
    if (number != nullptr) got = fmt::format("{}", *number);
    check_.wrong(path_of(name), fmt::format("expected a whole number from {} to {}, got {}", min, max, got));
    return false;
}

bool Fields::text(std::string_view name, std::string& out) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    if (const std::string* text = value->get_if<std::string>()) {
        out = *text;
        return true;
    }
    check_.wrong(path_of(name), fmt::format("expected a string, got {}", kind_of(*value)));
    return false;
}

bool Fields::coordinates(std::string_view name, std::vector<double>& out, std::size_t least, std::size_t most,
                         NumberRange range) {
    constexpr std::string_view axes[] = {"x", "y", "z"};
    const Value* value = field(name);
    if (value == nullptr) return false;
    const FileTable* table = value->get_if<FileTable>();
    const std::string_view shape = most == 2 ? "{ x, y }" : "{ x, y, z }";
    if (table == nullptr) {
        check_.wrong(path_of(name), fmt::format("expected {}, got {}", shape, kind_of(*value)));
        return false;
    }
    const bool by_name = table->elements.empty();
    FieldPath path = path_of(name);
    path.emplace_back();
    std::size_t found = 0;
    for (std::size_t i = 0; i < most; ++i) {
        const Value* axis = by_name ? table->find(axes[i]) : i < table->elements.size() ? &table->elements[i] : nullptr;
        if (axis == nullptr) break;
        path.back() = by_name ? std::string(axes[i]) : fmt::format("[{}]", i + 1);
        double number = 0;
        if (const std::string problem = read_number(*axis, {.range = range}, "", number); !problem.empty()) {
            check_.wrong(path, problem);
            return false;
        }
        out.push_back(number);
        ++found;
    }
    const std::size_t size = by_name ? table->fields.size() : table->elements.size();
    if (found < least || size != found || (!by_name && !table->fields.empty())) {
        for (const auto& [key, unused] : table->fields) {
            if (by_name && std::find(std::begin(axes), std::begin(axes) + most, key) != std::begin(axes) + most)
                continue;
            path.back() = key;
            check_.unknown(path, fmt::format(": expected {}", shape));
            return false;
        }
        check_.wrong(path_of(name), fmt::format("expected {} numbers {}, got {}", most, shape, by_name ? found : size));
        return false;
    }
    return true;
}

bool Fields::point(std::string_view name, Point2D& out, NumberRange range) {
    std::vector<double> v;
    if (!coordinates(name, v, 2, 2, range)) return false;
    out = {v[0], v[1]};
    return true;
}

bool Fields::point(std::string_view name, Point3D& out, NumberRange range, bool z_optional) {
    std::vector<double> v;
    if (!coordinates(name, v, z_optional ? 2 : 3, 3, range)) return false;
    out = {v[0], v[1], v.size() > 2 ? v[2] : out.z};
    return true;
}

bool Fields::choice(std::string_view name, std::size_t& out, std::span<const std::string_view> choices) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    const std::string* text = value->get_if<std::string>();
    const std::string got = text != nullptr ? "'" + *text + "'" : kind_of(*value);
    const auto found = text != nullptr ? std::find(choices.begin(), choices.end(), *text) : choices.end();
    if (found == choices.end()) {
        const std::string hint = text != nullptr ? did_you_mean(*text, {choices.begin(), choices.end()}) : "";
        check_.wrong(path_of(name), fmt::format("expected one of {}, got {}{}", fmt::join(choices, ", "), got, hint));
        return false;
    }
    out = static_cast<std::size_t>(found - choices.begin());
    return true;
}

bool Fields::names(std::string_view name, std::vector<std::string>& out) {
    const Value* value = field(name);
    if (value == nullptr) return false;
    std::vector<std::string> names;
    const FileTable* table = value->get_if<FileTable>();
    if (const std::string* text = value->get_if<std::string>()) names.push_back(*text);
    for (std::size_t i = 0; table != nullptr && table->fields.empty() && i < table->elements.size(); ++i) {
        const std::string* text = table->elements[i].get_if<std::string>();
        if (text != nullptr) names.push_back(*text);
    }
    const bool is_list = table != nullptr && table->fields.empty() && names.size() == table->elements.size();
    if (!value->is<std::string>() && !is_list) {
        check_.wrong(path_of(name), fmt::format("expected a name or a list of names, got {}",
                                                table == nullptr ? kind_of(*value) : "another table"));
        return false;
    }
    out = std::move(names);
    return true;
}

bool Fields::values(std::string_view name, ParameterValues& out) {
    Fields table = inner(name);
    for (const auto& [key, value] : table.all()) {
        table.field(key);
        auto read = to_parameter(value);
        if (read) {
            out.insert_or_assign(key, std::move(*read));
        } else {
            check_.wrong(table.path_of(key), read.error().message);
        }
    }
    table.done([](std::string_view) -> std::string { return ": expected NAME = VALUE"; });
    return has(name);
}

bool Fields::pose(std::string_view name, Pose2D& out) {
    Fields table = inner(name);
    table.number("x", out.position.x);
    table.number("y", out.position.y);
    table.number("heading", out.heading);
    table.done();
    return has(name);
}

void Fields::check_lengths(std::string_view name, const Rule& rule, std::string_view unit,
                           std::span<const double> lengths) {
    if (std::all_of(lengths.begin(), lengths.end(), [&](double each) { return each >= rule.least; })) return;
    if (rule.least > 0)
        check_.wrong(path_of(name), fmt::format("expected lengths of at least {} {}", rule.least, unit));
}

Fields Fields::inner(std::string_view name) {
    static const Value nothing;
    const Value* value = field(name);
    return Fields(check_, value != nullptr ? *value : nothing, path_of(name));
}

const std::vector<Value>& Fields::elements() {
    elements_asked_ = true;
    return table_->elements;
}

void Fields::require(std::string_view name, std::string_view expected) {
    if (field(name) == nullptr) check_.missing(path_of(name), expected);
}

void Fields::done(std::string (*hint)(std::string_view name)) {
    const std::vector<std::string_view> known(asked_.begin(), asked_.end());
    const auto refuse = [&](std::string_view key) {
        std::string more = hint != nullptr ? hint(key) : std::string();
        if (more.empty()) more = did_you_mean(key, known);
        if (more.empty() && known.empty()) more = fmt::format(": expected no {}s", check_.noun());
        if (more.empty()) more = fmt::format(": expected {}", fmt::join(known, ", "));
        check_.unknown(path_of(key), more);
    };
    for (const auto& [key, unused] : table_->fields) {
        if (!contains(asked_, key)) return refuse(key);
    }
    if (!table_->elements.empty() && !elements_asked_) refuse("[1]");
}

}  // namespace nezumi
