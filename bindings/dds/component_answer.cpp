// Acts go through the one door; a look is data.
#include "bindings/dds/component_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace nezumi::dds {
namespace {

// Begins a table; what is added to it must come in the order of its keys.
std::size_t add_table(PlainData& data) {
    data.tables.emplace_back();
    return data.tables.size() - 1;
}

template <class Sequence>
PlainData::Value add_list(PlainData& data, const Sequence& elements) {
    const std::size_t list = add_table(data);
    std::int64_t place = 0;
    for (const auto& element : elements) {
        using Element = typename Sequence::value_type;
        data.tables[list].emplace_back(PlainData::Value{++place}, PlainData::Value{static_cast<Element>(element)});
    }
    return PlainData::TableRef{list};
}

PlainData::Value add(PlainData& data, const ParameterValue& value) {
    return std::visit(
        [&]<class T>(const T& each) -> PlainData::Value {
            if constexpr (requires { typename T::iterator; } && !std::is_same_v<T, std::string>) {
                return add_list(data, each);
            } else {
                return each;
            }
        },
        value);
}

// The elements of an array, all of one type; integers among numbers are numbers.
Expected<ParameterValue> array_of(const PlainData::Table& table) {
    const auto all = [&]<class... T>(std::in_place_type_t<T>...) {
        return std::all_of(table.begin(), table.end(),
                           [](const auto& entry) { return (std::holds_alternative<T>(entry.second) || ...); });
    };
    std::int64_t place = 0;
    for (const auto& [key, value] : table) {
        const auto* at = std::get_if<std::int64_t>(&key);
        if (at == nullptr || *at != ++place) return failure("expected a value, or an array without gaps");
    }
    const auto collect = [&]<class T>(std::in_place_type_t<T>) {
        std::vector<T> elements;
        for (const auto& [key, value] : table) {
            if (const auto* integer = std::get_if<std::int64_t>(&value);
                integer != nullptr && std::is_arithmetic_v<T>) {
                if constexpr (std::is_arithmetic_v<T>) elements.push_back(static_cast<T>(*integer));
            } else {
                elements.push_back(std::get<T>(value));
            }
        }
        return ParameterValue{std::move(elements)};
    };
    if (all(std::in_place_type<bool>)) return collect(std::in_place_type<bool>);
    if (all(std::in_place_type<std::int64_t>)) return collect(std::in_place_type<std::int64_t>);
    if (all(std::in_place_type<std::int64_t>, std::in_place_type<double>)) return collect(std::in_place_type<double>);
    if (all(std::in_place_type<std::string>)) return collect(std::in_place_type<std::string>);
    return failure("expected elements of one type");
}

// The one value as a parameter's.
Expected<ParameterValue> parameter_of(const PlainData& data, const ParameterValue* present) {
    if (data.values.size() != 1) return failure("expected one value");
    const PlainData::Value& value = data.values.front();
    if (const auto* is = std::get_if<bool>(&value)) return ParameterValue{*is};
    if (const auto* is = std::get_if<std::int64_t>(&value)) return ParameterValue{*is};
    if (const auto* is = std::get_if<double>(&value)) return ParameterValue{*is};
    if (const auto* is = std::get_if<std::string>(&value)) return ParameterValue{*is};
    const auto* ref = std::get_if<PlainData::TableRef>(&value);
    if (ref == nullptr) return failure("expected a value, got nothing");
    const PlainData::Table& table = data.tables[ref->index];
    if (table.empty() && present != nullptr) {  // an array of nothing is one of whatever the parameter holds
        return std::visit(
            []<class T>(const T&) -> Expected<ParameterValue> {
                if constexpr (requires { typename T::iterator; }) return ParameterValue{T{}};
                return failure("expected a value, got an empty table");
            },
            *present);
    }
    return array_of(table);
}

}  // namespace

PlainData look_at(const Component& component, const System& system) {
    PlainData data;
    data.values.emplace_back(PlainData::TableRef{add_table(data)});
    const auto set = [&](std::string_view key, PlainData::Value value) {
        data.tables[0].emplace_back(std::string(key), std::move(value));
    };
    std::vector<const Parameters::Parameter*> parameters;
    for (const auto& each : component.parameters().all()) parameters.push_back(&each);
    std::sort(parameters.begin(), parameters.end(),
              [](const auto* a, const auto* b) { return a->spec.name < b->spec.name; });
    const std::size_t config = add_table(data);
    for (const auto* each : parameters) {
        PlainData::Value value = add(data, each->value);
        data.tables[config].emplace_back(each->spec.name, std::move(value));
    }
    set("config", PlainData::TableRef{config});
    if (!component.last_error().message.empty()) set("error", describe(component.last_error()));
    set("rate", component.rate > 0 ? component.rate : system.settings().rate);
    if (!component.set_in_use().empty()) set("set", component.set_in_use());
    std::vector<std::string> sets;
    for (const auto& [name, values] : component.sets) sets.push_back(name);
    PlainData::Value list = add_list(data, sets);
    set("sets", std::move(list));
    set("status", std::string(to_text(component.state())));
    set("type", component.type());
    set("version", std::int64_t{component.version()});
    return data;
}

Expected<Act> act_of(Question::What what, const std::string& name, PlainData values, const Component& component) {
    using What = Question::What;
    const std::string& own = component.name();
    switch (what) {
        case What::activate: return Activate{own};
        case What::deactivate: return Deactivate{own};
        case What::reset: return Reset{own};
        case What::use: return Use{own, name};
        case What::command: return Command{own, name, std::move(values)};
        case What::set: {
            const auto* parameter = component.parameters().find(name);
            auto value = parameter_of(values, parameter != nullptr ? &parameter->value : nullptr);
            if (!value) return failure(fmt::format("parameter '{}': {}", shown(name), value.error().message));
            return SetParameter{own, name, std::move(*value)};
        }
        case What::look: break;
    }
    return failure("this version knows no such request");
}

Expected<PlainData> answer(const Question& question, const System& system, bool writable, const ActDoor& act,
                           const Actor& who) {
    if (is_remote(question.component)) return failure("expected a component of this host");
    const auto component = system.component(question.component);
    if (!component) return Unexpected(component.error());
    if (question.what == Question::What::look) return look_at(**component, system);
    if (!writable) return failure("others may only look: a secret or open = true in the word network lets them write");
    const auto wanted = act_of(question.what, question.name, question.values, **component);
    if (!wanted) return Unexpected(wanted.error());
    auto done = act(*wanted, who);
    if (!done) return Unexpected(done.error());
    // As the methods of a component of one's own: a command has results, all else tells what follows.
    if (question.what == Question::What::command) return std::move(done->values);
    PlainData after;
    const Component* is_there = system.find(question.component);
    if (is_there == nullptr || question.what == Question::What::set) return after;
    after.values.emplace_back(question.what == Question::What::use ? is_there->set_in_use()
                                                                   : std::string(to_text(is_there->state())));
    return after;
}

}  // namespace nezumi::dds
