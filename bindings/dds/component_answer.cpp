// Acts go through the one door; a look is data.
#include "bindings/dds/component_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nezumi::dds {

PlainData look_at(const Component& component, const System& system) {
    PlainData::Table config;
    for (const auto& each : component.parameters().all()) config.push_back({each.spec.name, each.value});
    std::sort(config.begin(), config.end(), [](const auto& a, const auto& b) {
        return a[0].template get<std::string>() < b[0].template get<std::string>();
    });
    std::vector<std::string> sets;
    for (const auto& [name, values] : component.sets) sets.push_back(name);

    PlainData data = PlainData::empty_table();
    const TableRef parameters = data.add(std::move(config));
    const auto set = [&](std::string_view key, Value value) { data.tables[0].push_back({key, std::move(value)}); };
    set("config", parameters);
    if (!component.last_error().message.empty()) set("error", describe(component.last_error()));
    set("rate", component.rate > 0 ? component.rate : system.settings().rate);
    if (!component.set_in_use().empty()) set("set", component.set_in_use());
    set("sets", std::move(sets));
    set("status", to_text(component.state()));
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
            if (values.values.size() != 1)
                return failure(fmt::format("parameter '{}': expected one value", shown(name)));
            return SetParameter{own, name, std::move(values.values.front())};
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
    after.values.emplace_back(question.what == Question::What::use ? std::string_view(is_there->set_in_use())
                                                                   : to_text(is_there->state()));
    return after;
}

}  // namespace nezumi::dds
