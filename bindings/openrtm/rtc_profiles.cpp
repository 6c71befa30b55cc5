// Sets, widgets and bounds have the names and the form that OpenRTM-aist's tools use.
#include "bindings/openrtm/rtc_profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "bindings/openrtm/rtm_wiring.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

std::string path_of(const Component& component, const Port& port) { return component.name() + "." + port.name(); }

// "Obstacle" of "IDL:Seen/Obstacle:1.0".
std::string short_name(const std::string& id) {
    const std::string name = id.substr(id.rfind('/') == id.npos ? id.find(':') + 1 : id.rfind('/') + 1);
    return name.substr(0, name.find(':'));
}

void add_port(RtcProfile& profile, const Component& component, const Port& port, const ParameterValues& rename) {
    const MessageType& type = *port.type();
    const std::string id = rtm_type_id(type);
    if (id.empty()) return;
    RtcPort added{.path = path_of(component, port),
                  .name = port.name(),
                  .type = type.is_compiled() ? type.name : short_name(id),
                  .is_in = port.direction() == Direction::in,
                  .id = type.is_compiled() ? "" : id};
    if (const auto other = rename.find(added.path); other != rename.end())
        added.name = other->second.get<std::string>();
    profile.ports.push_back(std::move(added));
}

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (!text.empty() && begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

// Reads a value; false if the text is not a value of its type.
bool read_rtc(const std::string& text, const ValuePlace& out) {
    const std::string_view whole = trimmed(text);
    switch (out.type->kind) {
        case Type::Kind::text: out.as<std::string>() = text; return true;
        case Type::Kind::boolean:
            out.as<bool>() = whole == "true" || whole == "1";
            return out.as<bool>() || whole == "false" || whole == "0";
        case Type::Kind::sequence: {
            const std::vector<std::string> parts = parts_of(text);
            out.resize(parts.size());
            bool fits = true;
            auto part = parts.begin();
            for_each_element(out, [&](const ValuePlace& element) { return fits = read_rtc(*part++, element); });
            return fits;
        }
        default:
            return visit_number(out, [&]<class T>(T& number) {
                if constexpr (std::is_same_v<T, bool>) {
                    return false;
                } else {
                    const auto read = number_in<T>(whole);
                    if (read) number = *read;
                    return read.has_value();
                }
            });
    }
}

// "-1.5<=x<=1.5", "(low,high)"; "" for none.
std::string constraint_of(const ParameterSpec& spec) {
    if (!spec.choices.empty()) {
        std::string text;
        for (const Value& choice : spec.choices) text += (text.empty() ? "" : ",") + to_rtc_text(choice);
        return "(" + text + ")";
    }
    if (!spec.min && !spec.max) return "";
    return fmt::format("{}x{}", spec.min ? fmt::format("{}<=", *spec.min) : "",
                       spec.max ? fmt::format("<={}", *spec.max) : "");
}

// The values that parameters have when this set is used; "" means no set.
Texts values_of(const Component& component, const std::string& set) {
    const auto values = component.sets.find(set);
    Texts texts;
    for (const auto& parameter : component.parameters().all()) {
        const std::string& name = parameter.spec.name;
        const Value* value = &parameter.spec.initial;
        if (const auto given = component.configured.find(name); given != component.configured.end())
            value = &given->second;
        if (values != component.sets.end()) {
            if (const auto own = values->second.find(name); own != values->second.end()) value = &own->second;
        }
        if (component.set_in_use() == set) value = &parameter.value;
        texts.emplace_back(name, to_rtc_text(*value));
    }
    return texts;
}

template <class Say>
Texts told_of(const Component& component, const Say& say) {
    Texts texts;
    for (const auto& parameter : component.parameters().all()) {
        const std::string text = say(parameter.spec);
        if (!text.empty()) texts.emplace_back(parameter.spec.name, text);
    }
    return texts;
}

}  // namespace

Expected<std::vector<RtcProfile>> profiles_of(const System& system, const RtmSpec& rtm) {
    std::vector<RtcProfile> profiles;
    std::set<std::string, std::less<>> paths;
    for (const std::string& name : rtm.exported) {
        const Component* component = system.find(name);
        if (component == nullptr) continue;  // it was removed
        RtcProfile profile{.component = name, .type = component->type()};
        profile.rate = component->rate > 0 ? component->rate : system.settings().rate;
        for (const InPortBase* port : component->in_ports()) add_port(profile, *component, *port, rtm.rename);
        for (const OutPortBase* port : component->out_ports()) add_port(profile, *component, *port, rtm.rename);
        std::set<std::string, std::less<>> names;
        for (const RtcPort& port : profile.ports) {
            paths.insert(port.path);
            if (names.insert(port.name).second) continue;
            return failure(fmt::format("rtm: two ports of {} are called '{}'", name, port.name), rtm.place);
        }
        profiles.push_back(std::move(profile));
    }
    for (const auto& [path, other] : rtm.rename) {
        if (paths.contains(path) || system.find(path.substr(0, path.find('.'))) == nullptr) continue;
        return failure(fmt::format("rtm: field 'rename': there is no exported port '{}'{}", shown(path),
                                   did_you_mean(path, paths)),
                       rtm.place);
    }
    return profiles;
}

Expected<std::vector<RtcLink>> links_of(const System& system, const std::vector<ConnectionSpec>& connections) {
    std::vector<RtcLink> links;
    for (const ConnectionSpec& connection : connections) {
        const auto ends = rtm_ends(system, connection);
        if (!ends) return failure("connect: " + ends.error().message, connection.place);
        links.push_back({ends->ours, ends->theirs.component, ends->theirs.port});
    }
    return links;
}

RtcSnapshot look_at(const Component& component) {
    RtcSnapshot snapshot;
    snapshot.state = component.state() == LifeState::active     ? RtcState::active
                     : component.state() == LifeState::inactive ? RtcState::inactive
                                                                : RtcState::error;
    const ComponentAbout about = component.about();
    snapshot.description = about.description;
    snapshot.version = about.version;
    snapshot.vendor = about.vendor;
    snapshot.category = about.category;
    if (!component.set_in_use().empty()) snapshot.set = component.set_in_use();
    snapshot.sets.emplace_back(Component::no_set, values_of(component, ""));
    for (const auto& [name, values] : component.sets) snapshot.sets.emplace_back(name, values_of(component, name));
    snapshot.sets.emplace_back("__widget__", told_of(component, rtc_widget_of));
    snapshot.sets.emplace_back("__constraints__", told_of(component, constraint_of));
    snapshot.sets.emplace_back("__type__",
                               told_of(component, [](const ParameterSpec& spec) { return rtc_type_of(spec.initial); }));
    return snapshot;
}

std::string rtc_type_of(const Value& value) {
    const Type& single = value.type().single();
    const std::string_view name = single.kind == Type::Kind::boolean ? "bool"
                                  : single.is_integer()              ? "long"
                                  : single.is_floating()             ? "double"
                                                                     : "string";
    return &single == &value.type() ? std::string(name) : fmt::format("vector<{}>", name);
}

std::string rtc_widget_of(const ParameterSpec& spec) {
    if ((spec.widget == "slider" || spec.widget == "spin") && spec.step > 0)
        return fmt::format("{}.{}", spec.widget, spec.step);
    return spec.widget;
}

std::string to_rtc_text(const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::text: return value.as<std::string>();
        case Type::Kind::boolean: return value.as<bool>() ? "true" : "false";
        case Type::Kind::sequence: {
            std::string text;
            bool is_first = true;
            for_each_element(value, [&](const ValueView& element) {
                text += (std::exchange(is_first, false) ? "" : ",") + to_rtc_text(element);
                return true;
            });
            return text;
        }
        default: return visit_number(value, [](const auto& number) { return fmt::format("{}", number); });
    }
}

std::optional<Value> from_rtc_text(const std::string& text, const Value& like) {
    Value value(like.type());
    if (!read_rtc(text, value)) return std::nullopt;
    return value;
}

}  // namespace nezumi::openrtm
