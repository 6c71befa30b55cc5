// Positions in the editor, object references and properties of connections are left out: they say nothing here.
#include "bindings/openrtm/system_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "bindings/openrtm/profile_xml.hpp"
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
    return {std::string(attribute_of(node, "instanceName")), std::string(port.substr(port.rfind('.') + 1))};
}

ProfiledComponent component_in(const pugi::xml_node& node) {
    Id id = id_in(attribute_of(node, "id"));
    ProfiledComponent component{.type = std::move(id.type),
                                .instance = std::string(attribute_of(node, "instanceName")),
                                .set = std::string(attribute_of(node, "activeConfigurationSet")),
                                .vendor = std::move(id.vendor),
                                .category = std::move(id.category),
                                .version = std::move(id.version)};
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
    const auto root = open_profile(text, shown_file, "RtsProfile", document);
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
            profile.connections.push_back({end_in(element_of(node, "sourceDataPort")),
                                           end_in(element_of(node, "targetDataPort")),
                                           std::string(attribute_of(node, "dataType"))});
        } else if (name == "ServicePortConnectors") {
            profile.remarks.push_back(
                fmt::format("connection of service ports '{}'", shown(attribute_of(node, "name"))));
        } else if (name == "Groups") {
            profile.remarks.push_back(fmt::format("group '{}'", shown(attribute_of(node, "groupId"))));
        }
    }
    if (profile.components.empty()) return failure("has no components", {shown_file});
    return profile;
}

}  // namespace nezumi::openrtm
