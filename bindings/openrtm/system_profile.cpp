// Positions in the editor and references to objects are left out, because nezumi does not use them.
#include "bindings/openrtm/system_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "bindings/openrtm/profile_xml.hpp"
#include "bindings/openrtm/profile_yaml.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

// "RTC:Vendor:Category:Type:1.0.0"; the id of a system has no category.
struct Id {
    std::string vendor, category, type, version;
};

Id id_in(std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    const std::size_t count = parts.size();
    if (count < 3) return {};
    return {parts[1], count > 4 ? parts[2] : "", parts[count - 2], parts[count - 1]};
}

ProfiledEnd end_in(const pugi::xml_node& node) {
    const std::string_view port = attribute_of(node, "portName");  // "ConsoleIn0.out"
    ProfiledEnd end{std::string(attribute_of(node, "instanceName")), std::string(port.substr(port.rfind('.') + 1))};
    for (const ProfileProperty& property : properties_of(node)) {
        if (property.name == "COMPONENT_PATH_ID") end.path = property.value;
    }
    return end;
}

// True for properties that refer to an object of an earlier run. They are left out, because the object no longer
// exists.
bool is_reference(std::string_view property) { return property.ends_with("_ior") || property.ends_with("_ref"); }

ProfiledConnection connection_in(const pugi::xml_node& node, std::string_view source, std::string_view target) {
    ProfiledConnection connection{.from = end_in(element_of(node, source)),
                                  .to = end_in(element_of(node, target)),
                                  .type = std::string(attribute_of(node, "dataType")),
                                  .name = std::string(attribute_of(node, "name")),
                                  .id = std::string(attribute_of(node, "connectorId"))};
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> terms{
        {{"interfaceType", "dataport.interface_type"},
         {"dataflowType", "dataport.dataflow_type"},
         {"subscriptionType", "dataport.subscription_type"},
         {"dataType", "dataport.data_type"}}};
    auto& properties = connection.properties;
    for (const auto& [attribute, property] : terms) {
        const std::string_view value = attribute_of(node, attribute);
        if (!value.empty()) properties.emplace_back(property, value);
    }
    for (ProfileProperty& property : properties_of(node)) {
        const auto said = std::find_if(properties.begin(), properties.end(),
                                       [&](const auto& each) { return each.first == property.name; });
        if (said == properties.end() && !property.name.empty() && !is_reference(property.name))
            properties.emplace_back(std::move(property.name), std::move(property.value));
    }
    return connection;
}

ProfiledComponent component_in(const pugi::xml_node& node) {
    Id id = id_in(attribute_of(node, "id"));
    ProfiledComponent component{.type = std::move(id.type),
                                .instance = std::string(attribute_of(node, "instanceName")),
                                .set = std::string(attribute_of(node, "activeConfigurationSet")),
                                .vendor = std::move(id.vendor),
                                .category = std::move(id.category),
                                .version = std::move(id.version),
                                .path = std::string(attribute_of(node, "pathUri")),
                                .is_required = attribute_of(node, "isRequired") != "false"};
    for (const pugi::xml_node& port : elements_of(node, "DataPorts")) {
        const std::string_view name = attribute_of(port, "name");  // "ConsoleIn0.out"
        component.ports.emplace_back(name.substr(name.rfind('.') + 1));
    }
    const std::string_view rate = attribute_of(element_of(node, "ExecutionContexts"), "rate");
    std::from_chars(rate.data(), rate.data() + rate.size(), component.rate);
    if (!std::isfinite(component.rate) || component.rate < 0) component.rate = 0;
    for (const pugi::xml_node& set : elements_of(node, "ConfigurationSets")) {
        auto& [name, values] = component.sets.emplace_back(std::string(attribute_of(set, "id")), 0);
        for (const pugi::xml_node& value : elements_of(set, "ConfigurationData"))
            values.emplace_back(attribute_of(value, "name"), attribute_of(value, "data"));
    }
    return component;
}

}  // namespace

Expected<SystemProfile> read_system_profile(std::string_view text, const std::string& shown_file) {
    pugi::xml_document document;
    const auto root = is_yaml_profile(text) ? open_yaml_profile(text, shown_file, document)
                                            : open_profile(text, shown_file, "RtsProfile", document);
    if (!root) return Unexpected(root.error());
    SystemProfile profile{.name = id_in(attribute_of(*root, "id")).type,
                          .doc = std::string(trimmed(without_html_breaks(attribute_of(*root, "abstract"), "\n")))};
    for (const pugi::xml_node& node : elements_of(*root)) {
        const std::string_view name = local_name(node.name());
        if (name == "Components") {
            profile.components.push_back(component_in(node));
            if (const std::string_view kind = attribute_of(node, "compositeType"); !kind.empty() && kind != "None")
                profile.remarks.push_back(fmt::format("component '{}': it is composite ({})",
                                                      shown(profile.components.back().instance), shown(kind)));
        } else if (name == "DataPortConnectors") {
            profile.connections.push_back(connection_in(node, "sourceDataPort", "targetDataPort"));
        } else if (name == "ServicePortConnectors") {
            profile.service_connections.push_back(connection_in(node, "sourceServicePort", "targetServicePort"));
        } else if (name == "Groups") {
            profile.remarks.push_back(fmt::format("group '{}'", shown(attribute_of(node, "groupId"))));
        }
    }
    if (profile.components.empty()) return failure("has no components", {shown_file});
    return profile;
}

const ProfiledComponent* component_at(const SystemProfile& profile, const ProfiledEnd& end) {
    const ProfiledComponent* found = nullptr;
    for (const ProfiledComponent& each : profile.components) {
        if (each.instance != end.instance) continue;
        if (!end.path.empty() && each.path == end.path) return &each;
        if (found == nullptr) found = &each;
    }
    return found;
}

}  // namespace nezumi::openrtm
