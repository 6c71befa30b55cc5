// The word `argument` of system files: its value comes from `--set NAME=VALUE`, or is its default.
#include <fmt/format.h>

#include <utility>

#include "bindings/lua/files/start_values.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "engine/base/names.hpp"
#include "engine/components/quotes_hint.hpp"
#include "engine/records/fields.hpp"

namespace nezumi {
namespace {

// "argument 'n' (integer): ..." from "parameter 'n' (integer): ...", because both have the same checks.
std::string as_argument(const Error& error) {
    constexpr std::string_view parameter = "parameter ";
    const std::string& text = error.message;
    return text.starts_with(parameter) ? "argument " + text.substr(parameter.size()) : text;
}

}  // namespace

void SystemWords::give_arguments(const std::vector<std::string>& set) {
    for (const std::string& text : set) {
        if (!sets_argument(text)) continue;
        const auto equals = text.find('=');
        given_.insert_or_assign(text.substr(0, equals), Argument{"--set " + shown(text), text.substr(equals + 1)});
    }
}

Expected<Value> SystemWords::argument(const WordCall& call, const Value& name, const Value& otherwise,
                                      const Value& options) {
    const std::string* text = name.get_if<std::string>();
    if (text == nullptr || !is_identifier(*text))
        return failure(fmt::format("argument: expected a name and a default, as in argument(\"n\", 5), got {}",
                                   text == nullptr ? nezumi::kind_of(name) : "'" + shown(*text) + "'"),
                       call.place);
    const std::string what = fmt::format("argument '{}'", *text);
    ParameterSpec spec{.name = *text};
    auto initial = to_parameter(otherwise);
    if (!initial) return failure(fmt::format("{}: its default: {}", what, initial.error().message), call.place);
    spec.initial = std::move(*initial);
    FieldCheck check(what, call.word, call.place, call.source);
    Fields fields(check, options);
    double bound = 0;
    if (fields.number("min", bound)) spec.min = bound;
    if (fields.number("max", bound)) spec.max = bound;
    fields.text("doc", spec.doc);
    fields.done();
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    const auto [before, is_new] = asked_.try_emplace(*text, call.place);
    if (!is_new)
        return failure(fmt::format("{}: is declared already, at {}:{}", what, before->second.file, before->second.line),
                       call.place);
    const auto given = given_.find(*text);
    if (given == given_.end()) {
        auto value = check_value(spec, spec.initial);
        if (!value) return failure(as_argument(value.error()) + ", in its default", call.place);
        return value;
    }
    auto read = read_option_value(given->second.text, project_, given->second.option);
    if (!read) return failure(fmt::format("{}: {}", what, read.error().message), {given->second.option});
    auto value = check_value(spec, *read);
    if (!value)
        return failure(as_argument(value.error()) + quotes_hint(spec, *read, given->second.option),
                       {given->second.option});
    return value;
}

Expected<void> SystemWords::check_arguments() const {
    for (const auto& [name, argument] : given_) {
        if (asked_.contains(name)) continue;
        std::vector<std::string_view> asked;
        for (const auto& [each, place] : asked_) asked.emplace_back(each);
        const std::string near = did_you_mean(name, asked);
        const std::string all =
            !near.empty()   ? near
            : asked.empty() ? std::string(": a parameter is COMPONENT.PARAMETER=VALUE, as in controller.speed_x=0.3")
                            : fmt::format(" (it has {})", fmt::join(asked, ", "));
        return failure(fmt::format("{} has no argument '{}'{}", spec_.file, name, all), {argument.option});
    }
    return {};
}

}  // namespace nezumi
