// Sets, widgets and bounds have the names and the form that OpenRTM-aist's tools know.
#include "bindings/openrtm/rtc_profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "engine/base/trimmed.hpp"
#include "engine/system/rtm_wiring.hpp"

namespace nezumi::openrtm {
namespace {

std::string path_of(const Component& component, const Port& port) { return component.name() + "." + port.name(); }

void add_port(RtcProfile& profile, const Component& component, const Port& port, const ParameterValues& rename) {
    if (!is_rtm_type(port.type_name())) return;
    RtcPort added{.path = path_of(component, port),
                  .name = port.name(),
                  .type = std::string(port.type_name()),
                  .is_in = port.direction() == Direction::in};
    if (const auto other = rename.find(added.path); other != rename.end())
        added.name = std::get<std::string>(other->second);
    profile.ports.push_back(std::move(added));
}

template <class T>
std::string joined(const std::vector<T>& values) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
        text += (i > 0 ? "," : "") + to_rtc_text(ParameterValue(static_cast<T>(values[i])));
    return text;
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

template <class T>
std::optional<ParameterValue> number_from(const std::string& text) {
    const std::string_view whole = trimmed(text);
    T number{};
    const auto read = std::from_chars(whole.data(), whole.data() + whole.size(), number);
    if (read.ec != std::errc() || read.ptr != whole.data() + whole.size()) return std::nullopt;
    return ParameterValue(number);
}

std::optional<ParameterValue> truth_from(const std::string& text) {
    const std::string_view whole = trimmed(text);
    if (whole == "true" || whole == "1") return ParameterValue(true);
    if (whole == "false" || whole == "0") return ParameterValue(false);
    return std::nullopt;
}

std::string type_of(const ParameterValue& value) {
    constexpr std::array<std::string_view, 8> types{"bool",         "long",         "double",         "string",
                                                    "vector<bool>", "vector<long>", "vector<double>", "vector<string>"};
    return std::string(types[value.index()]);
}

// "slider.0.01", "radio", ...; "" where the tool may choose.
std::string widget_of(const ParameterSpec& spec) {
    if ((spec.widget == "slider" || spec.widget == "spin") && spec.step > 0)
        return fmt::format("{}.{}", spec.widget, spec.step);
    return spec.widget;
}

// "-1.5<=x<=1.5", "(low,high)"; "" for none.
std::string constraint_of(const ParameterSpec& spec) {
    if (!spec.choices.empty()) {
        std::string text;
        for (const ParameterValue& choice : spec.choices) text += (text.empty() ? "" : ",") + to_rtc_text(choice);
        return "(" + text + ")";
    }
    if (!spec.min && !spec.max) return "";
    return fmt::format("{}x{}", spec.min ? fmt::format("{}<=", *spec.min) : "",
                       spec.max ? fmt::format("<={}", *spec.max) : "");
}

// The values that parameters would have with a set; "" is what holds without any.
Texts values_of(const Component& component, const std::string& set) {
    const auto values = component.sets.find(set);
    Texts texts;
    for (const auto& parameter : component.parameters().all()) {
        const std::string& name = parameter.spec.name;
        const ParameterValue* value = &parameter.spec.initial;
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
    const std::vector<std::string_view> known(paths.begin(), paths.end());
    for (const auto& [path, other] : rtm.rename) {
        if (paths.contains(path) || system.find(path.substr(0, path.find('.'))) == nullptr) continue;
        return failure(fmt::format("rtm: field 'rename' names no port that is exported: there is none '{}'{}",
                                   shown(path), did_you_mean(path, known)),
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
    snapshot.sets.emplace_back("__widget__", told_of(component, widget_of));
    snapshot.sets.emplace_back("__constraints__", told_of(component, constraint_of));
    snapshot.sets.emplace_back("__type__",
                               told_of(component, [](const ParameterSpec& spec) { return type_of(spec.initial); }));
    return snapshot;
}

std::string to_rtc_text(const ParameterValue& value) {
    return std::visit(
        []<class T>(const T& each) -> std::string {
            if constexpr (std::is_same_v<T, std::string>) {
                return each;
            } else if constexpr (std::is_same_v<T, bool>) {
                return each ? "true" : "false";
            } else if constexpr (std::is_arithmetic_v<T>) {
                return fmt::format("{}", each);
            } else {
                return joined(each);
            }
        },
        value);
}

std::optional<ParameterValue> from_rtc_text(const std::string& text, const ParameterValue& like) {
    return std::visit(
        [&]<class T>(const T& /*each*/) -> std::optional<ParameterValue> {
            if constexpr (std::is_same_v<T, std::string>) {
                return ParameterValue(text);
            } else if constexpr (std::is_same_v<T, bool>) {
                return truth_from(text);
            } else if constexpr (std::is_arithmetic_v<T>) {
                return number_from<T>(text);
            } else {
                using Element = typename T::value_type;
                T values;
                for (const std::string& part : parts_of(text)) {
                    const auto value = from_rtc_text(part, ParameterValue(Element{}));
                    if (!value) return std::nullopt;
                    values.push_back(std::get<Element>(*value));
                }
                return ParameterValue(std::move(values));
            }
        },
        like);
}

}  // namespace nezumi::openrtm
