// A system that runs, as the profile that RTSystemEditor and rtresurrect read.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "bindings/openrtm/profile_xml.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "bindings/openrtm/system_profile.hpp"

namespace nezumi::openrtm {
namespace {

// "controller" is the RTC "controller0".
std::string instance_of(const std::string& component) { return component + "0"; }

ProfiledComponent profiled(const RtcProfile& profile, const Component& component) {
    RtcSnapshot now = look_at(component);
    ProfiledComponent written{.type = profile.type,
                              .instance = instance_of(profile.component),
                              .set = std::move(now.set),
                              .rate = profile.rate,
                              .vendor = std::move(now.vendor),
                              .category = std::move(now.category),
                              .version = std::move(now.version),
                              .sets = std::move(now.sets)};
    for (const RtcPort& port : profile.ports) written.ports.push_back(port.name);
    return written;
}

// The component of another program, as far as a connection tells of it.
ProfiledComponent& other_component(SystemProfile& profile, const std::string& instance) {
    auto& all = profile.components;
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.instance == instance; });
    if (known != all.end()) return *known;
    const std::string type = instance.substr(0, instance.find_last_not_of("0123456789") + 1);
    return all.emplace_back(ProfiledComponent{.type = type, .instance = instance, .set = "default"});
}

ProfiledEnd other_end(SystemProfile& profile, const RtmPath& path) {
    const std::string instance = path.component.substr(path.component.rfind('/') + 1);
    auto& ports = other_component(profile, instance).ports;
    if (std::find(ports.begin(), ports.end(), path.port) == ports.end()) ports.push_back(path.port);
    return {instance, path.port};
}

std::string id_text(const ProfiledComponent& component) {
    return fmt::format("RTC:{}:{}:{}:{}", component.vendor, component.category, component.type, component.version);
}

std::string path_text(const std::string& instance) { return "localhost/" + instance + ".rtc"; }

using Attributes = std::vector<std::pair<const char*, std::string>>;

pugi::xml_node with(pugi::xml_node node, const Attributes& attributes) {
    for (const auto& [name, value] : attributes) node.append_attribute(name) = value.c_str();
    return node;
}

void write_component(const ProfiledComponent& component, std::size_t place, pugi::xml_node root) {
    pugi::xml_node node = with(root.append_child("rts:Components"), {{"xsi:type", "rtsExt:component_ext"},
                                                                     {"rts:id", id_text(component)},
                                                                     {"rts:pathUri", path_text(component.instance)},
                                                                     {"rts:instanceName", component.instance},
                                                                     {"rts:activeConfigurationSet", component.set},
                                                                     {"rts:compositeType", "None"},
                                                                     {"rts:isRequired", "true"}});
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
    // In the diagram they stand one below the other.
    with(node.append_child("rtsExt:Location"), {{"rtsExt:x", "100"},
                                                {"rtsExt:y", std::to_string(50 + 100 * place)},
                                                {"rtsExt:height", "-1"},
                                                {"rtsExt:width", "-1"},
                                                {"rtsExt:direction", "DOWN"}});
}

void write_end(const ProfiledEnd& end, const SystemProfile& profile, pugi::xml_node node) {
    const auto& all = profile.components;
    const auto component =
        std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.instance == end.instance; });
    with(node, {{"xsi:type", "rtsExt:target_port_ext"},
                {"rts:componentId", component == all.end() ? "" : id_text(*component)},
                {"rts:instanceName", end.instance},
                {"rts:portName", end.instance + "." + end.port}});
    with(node.append_child("rtsExt:Properties"),
         {{"rtsExt:name", "COMPONENT_PATH_ID"}, {"rtsExt:value", path_text(end.instance)}});
}

}  // namespace

SystemProfile profile_of_system(const System& system, const SystemSpec& spec) {
    SystemProfile profile{.name = std::filesystem::path(spec.file).stem().string()};
    const RtmSpec* rtm = RtmWord::find(spec);
    RtmSpec all = rtm != nullptr ? *rtm : RtmSpec{};
    all.exported.clear();
    for (const Component* component : system.components()) all.exported.push_back(component->name());
    std::map<std::string, std::pair<ProfiledEnd, std::string>> ports;  // end and type, by path
    if (const auto rtcs = profiles_of(system, all)) {
        for (const RtcProfile& rtc : *rtcs) {
            profile.components.push_back(profiled(rtc, *system.find(rtc.component)));
            for (const RtcPort& port : rtc.ports) {
                ports.insert_or_assign(port.path, std::pair{ProfiledEnd{instance_of(rtc.component), port.name},
                                                            "IDL:RTC/" + port.type + ":1.0"});
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
                *end = other_end(profile, *theirs);
            } else {
                is_known = false;  // of another host, or of a type that OpenRTM does not have
            }
        }
        if (is_known) profile.connections.push_back(std::move(written));
    }
    return profile;
}

Expected<std::string> write_system_profile(const SystemProfile& profile, const std::string& date) {
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
    pugi::xml_node parent = root;
    for (std::size_t i = 0; i < profile.connections.size(); ++i) {
        const auto& [from, to, type] = profile.connections[i];
        pugi::xml_node node =
            with(parent.append_child("rts:DataPortConnectors"),
                 {{"xsi:type", "rtsExt:dataport_connector_ext"},
                  {"rts:connectorId", fmt::format("nezumi_{}", i + 1)},
                  {"rts:name", fmt::format("{}.{}_{}.{}", from.instance, from.port, to.instance, to.port)},
                  {"rts:dataType", type},
                  {"rts:interfaceType", "corba_cdr"},
                  {"rts:dataflowType", "push"},
                  {"rts:subscriptionType", "new"}});
        write_end(from, profile, node.append_child("rts:sourceDataPort"));
        write_end(to, profile, node.append_child("rts:targetDataPort"));
    }
    return save_profile(document);
}

}  // namespace nezumi::openrtm
