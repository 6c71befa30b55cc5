// Writes a running system as a profile that RTSystemEditor and rtresurrect can read.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include "bindings/openrtm/host_context.hpp"
#include "bindings/openrtm/profile_xml.hpp"
#include "bindings/openrtm/profile_yaml.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "bindings/openrtm/system_profile.hpp"
#include "engine/base/list.hpp"

namespace nezumi::openrtm {
namespace {

// "controller" is the RTC "controller0".
std::string instance_of(const std::string& component) { return component + "0"; }

// "localhost" of "localhost:2809": the usual port of a name service is left out.
std::string server_text(const RtmSpec& rtm) {
    const std::string& first = rtm.nameservers.front();
    return first.ends_with(usual_port) ? first.substr(0, first.size() - usual_port.size()) : first;
}

// The path in the name service. An RTC that is named without a computer is assumed to be on this one.
std::string path_text(const std::string& server, const std::string& component) {
    const std::string context = component.find('/') == std::string::npos ? own_context() + "/" : "";
    return fmt::format("{}/{}{}.rtc", server, context, component);
}

ProfiledComponent profiled(const RtcProfile& profile, const Component& component, const std::string& server) {
    RtcSnapshot now = look_at(component);
    ProfiledComponent written{.type = profile.type,
                              .instance = instance_of(profile.component),
                              .set = std::move(now.set),
                              .rate = profile.rate,
                              .vendor = std::move(now.vendor),
                              .category = std::move(now.category),
                              .version = std::move(now.version),
                              .path = path_text(server, instance_of(profile.component)),
                              .sets = std::move(now.sets)};
    for (const RtcPort& port : profile.ports) written.ports.push_back(port.name);
    return written;
}

// The component of another program. Only its name, path and type are known, from the names in its connections.
ProfiledComponent& other_component(SystemProfile& profile, const std::string& instance, std::string path) {
    auto& all = profile.components;
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.instance == instance; });
    if (known != all.end()) return *known;
    const std::string type = instance.substr(0, instance.find_last_not_of("0123456789") + 1);
    return all.emplace_back(ProfiledComponent{.type = type, .instance = instance, .set = "", .path = std::move(path)});
}

ProfiledEnd other_end(SystemProfile& profile, const RtmPath& path, const std::string& server) {
    const std::string instance = path.component.substr(path.component.rfind('/') + 1);
    auto& ports = other_component(profile, instance, path_text(server, path.component)).ports;
    add_once(ports, path.port);
    return {instance, path.port};
}

std::string id_text(const ProfiledComponent& component) {
    return fmt::format("RTC:{}:{}:{}:{}", component.vendor, component.category, component.type, component.version);
}

using Attributes = std::vector<std::pair<const char*, std::string>>;

pugi::xml_node with(pugi::xml_node node, const Attributes& attributes) {
    for (const auto& [name, value] : attributes) node.append_attribute(name) = value.c_str();
    return node;
}

void write_component(const ProfiledComponent& component, std::size_t place, pugi::xml_node root) {
    pugi::xml_node node =
        with(root.append_child("rts:Components"), {{"xsi:type", "rtsExt:component_ext"},
                                                   {"rts:id", id_text(component)},
                                                   {"rts:pathUri", component.path},
                                                   {"rts:instanceName", component.instance},
                                                   {"rts:compositeType", "None"},
                                                   {"rts:isRequired", component.is_required ? "true" : "false"}});
    if (!component.set.empty()) with(node, {{"rts:activeConfigurationSet", component.set}});
    for (const std::string& port : component.ports) {
        with(node.append_child("rts:DataPorts"),
             {{"xsi:type", "rtsExt:dataport_ext"}, {"rts:name", component.instance + "." + port}});
    }
    for (const auto& [name, values] : component.sets) {
        pugi::xml_node set = with(node.append_child("rts:ConfigurationSets"), {{"rts:id", name}});
        for (const auto& [parameter, text] : values)
            with(set.append_child("rts:ConfigurationData"), {{"rts:name", parameter}, {"rts:data", text}});
    }
    if (component.rate > 0) {
        with(node.append_child("rts:ExecutionContexts"), {{"xsi:type", "rtsExt:execution_context_ext"},
                                                          {"rts:id", "0"},
                                                          {"rts:kind", "PERIODIC"},
                                                          {"rts:rate", fmt::format("{}", component.rate)}});
    }
    // The editor's diagram shows the components one below the other.
    with(node.append_child("rtsExt:Location"), {{"rtsExt:x", "100"},
                                                {"rtsExt:y", std::to_string(50 + 100 * place)},
                                                {"rtsExt:height", "-1"},
                                                {"rtsExt:width", "-1"},
                                                {"rtsExt:direction", "DOWN"}});
}

void write_end(const ProfiledEnd& end, const SystemProfile& profile, pugi::xml_node node) {
    const ProfiledComponent* component = component_at(profile, end);
    const std::string known = component != nullptr ? component->path : "";
    with(node, {{"xsi:type", "rtsExt:target_port_ext"},
                {"rts:componentId", component == nullptr ? "" : id_text(*component)},
                {"rts:instanceName", end.instance},
                {"rts:portName", end.instance + "." + end.port}});
    with(node.append_child("rtsExt:Properties"),
         {{"rtsExt:name", "COMPONENT_PATH_ID"}, {"rtsExt:value", end.path.empty() ? known : end.path}});
}

// A term of a connection: its attribute in the profile, its property in the connection, and its usual value.
struct ConnectionTerm {
    const char* attribute;
    std::string_view property;
    const char* usual;
};
constexpr std::array<ConnectionTerm, 3> connection_terms{
    {{"rts:interfaceType", "dataport.interface_type", "corba_cdr"},
     {"rts:dataflowType", "dataport.dataflow_type", "push"},
     {"rts:subscriptionType", "dataport.subscription_type", "new"}}};

void write_connection(const ProfiledConnection& connection, const SystemProfile& profile, bool is_data,
                      const std::string& id, pugi::xml_node root) {
    const auto& [from, to, type, name, own_id, properties] = connection;
    const std::string usual_name = fmt::format("{}.{}_{}.{}", from.instance, from.port, to.instance, to.port);
    pugi::xml_node node =
        with(root.append_child(is_data ? "rts:DataPortConnectors" : "rts:ServicePortConnectors"),
             {{"xsi:type", is_data ? "rtsExt:dataport_connector_ext" : "rtsExt:serviceport_connector_ext"},
              {"rts:connectorId", own_id.empty() ? id : own_id},
              {"rts:name", name.empty() ? usual_name : name}});
    if (is_data) {
        node.append_attribute("rts:dataType") = type.c_str();
        for (const ConnectionTerm& term : connection_terms) {
            const auto said = std::find_if(properties.begin(), properties.end(),
                                           [&](const auto& each) { return each.first == term.property; });
            node.append_attribute(term.attribute) = said == properties.end() ? term.usual : said->second.c_str();
        }
    }
    write_end(from, profile, node.append_child(is_data ? "rts:sourceDataPort" : "rts:sourceServicePort"));
    write_end(to, profile, node.append_child(is_data ? "rts:targetDataPort" : "rts:targetServicePort"));
    for (const auto& each : properties) {
        if (each.first == "dataport.data_type" && is_data) continue;
        if (is_data && std::any_of(connection_terms.begin(), connection_terms.end(),
                                   [&](const ConnectionTerm& term) { return term.property == each.first; }))
            continue;
        with(node.append_child("rtsExt:Properties"), {{"rtsExt:name", each.first}, {"rtsExt:value", each.second}});
    }
}

}  // namespace

SystemProfile profile_of_system(const System& system, const SystemSpec& spec) {
    SystemProfile profile{.name = std::filesystem::path(spec.file).stem().string()};
    profile.doc = profile.name + ", saved by nezumi";  // rtresurrect refuses a profile without this text
    const RtmSpec* rtm = RtmWord::find(spec);
    RtmSpec all = rtm != nullptr ? *rtm : RtmSpec{};
    all.exported.clear();
    const std::string server = server_text(all);
    for (const Component* component : system.components()) all.exported.push_back(component->name());
    std::map<std::string, std::pair<ProfiledEnd, std::string>> ports;  // end and type, by path
    if (const auto rtcs = profiles_of(system, all)) {
        for (const RtcProfile& rtc : *rtcs) {
            profile.components.push_back(profiled(rtc, *system.find(rtc.component), server));
            for (const RtcPort& port : rtc.ports) {
                ports.insert_or_assign(port.path,
                                       std::pair{ProfiledEnd{instance_of(rtc.component), port.name}, port.type_id()});
            }
        }
    }
    std::vector<ConnectionSpec> connections = system.connections();
    const std::vector<ConnectionSpec>& foreign = system.foreign_connections();
    connections.insert(connections.end(), foreign.begin(), foreign.end());
    for (const ConnectionSpec& connection : connections) {
        ProfiledConnection written;
        bool is_known = true;
        for (const auto& [path, end] : {std::pair{&connection.from, &written.from}, {&connection.to, &written.to}}) {
            const auto ours = ports.find(*path);
            const auto theirs = is_rtm_path(*path) ? rtm_path(*path) : Expected<RtmPath>(failure("none"));
            if (ours != ports.end()) {
                *end = ours->second.first;
                written.type = ours->second.second;
            } else if (theirs) {
                *end = other_end(profile, *theirs, server);
            } else {
                is_known = false;  // the port is of another host, or its type does not exist in OpenRTM
            }
        }
        if (is_known) profile.connections.push_back(std::move(written));
    }
    return profile;
}

Expected<std::string> write_system_profile(const SystemProfile& profile, const std::string& date,
                                           ProfileFormat format) {
    pugi::xml_document document;
    const pugi::xml_node root =
        with(begin_profile(document, "rts:RtsProfile"), {{"rts:id", "RTSystem:nezumi:" + profile.name + ":1.0"},
                                                         {"rts:version", "0.2"},
                                                         {"rts:abstract", profile.doc},
                                                         {"rts:creationDate", date},
                                                         {"rts:updateDate", date},
                                                         {"xmlns:rts", "http://www.openrtp.org/namespaces/rts"},
                                                         {"xmlns:rtsExt", "http://www.openrtp.org/namespaces/rts_ext"},
                                                         {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"}});
    for (std::size_t i = 0; i < profile.components.size(); ++i) write_component(profile.components[i], i, root);
    int id = 0;
    for (const bool is_data : {true, false}) {
        for (const ProfiledConnection& each : is_data ? profile.connections : profile.service_connections)
            write_connection(each, profile, is_data, fmt::format("nezumi_{}", ++id), root);
    }
    return format == ProfileFormat::yaml ? save_yaml_profile(document) : save_profile(document);
}

}  // namespace nezumi::openrtm
