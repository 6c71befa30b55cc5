// Attributes are written in the order of RTCBuilder's schema.
#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <utility>

#include "bindings/openrtm/component_profile.hpp"
#include "bindings/openrtm/profile_names.hpp"
#include "bindings/openrtm/profile_parameter.hpp"
#include "bindings/openrtm/profile_xml.hpp"
#include "engine/base/list.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

// The IDL type, as the reader of profiles expects it: "RTC::TimedLong" for "TimedLong", "Img::CameraImage" for
// "Img/CameraImage".
std::string idl_type_of(const std::string& type) {
    if (type.find('/') == std::string::npos) return "RTC::" + type;
    std::string name;
    for (const char c : type) name += c == '/' ? "::" : std::string(1, c);
    return name;
}

void write_port(const ProfilePort& port, pugi::xml_node root) {
    const bool is_in = port.direction == Direction::in;
    pugi::xml_node node = root.append_child("rtc:DataPorts");
    node.append_attribute("xsi:type") = "rtcExt:dataport_ext";
    node.append_attribute("rtc:portType") = is_in ? "DataInPort" : "DataOutPort";
    node.append_attribute("rtc:name") = port.name.c_str();
    node.append_attribute("rtc:type") = idl_type_of(port.type).c_str();
    for (const char* empty :
         {"rtc:idlFile", "rtc:interfaceType", "rtc:dataflowType", "rtc:subscriptionType", "rtc:unit"})
        node.append_attribute(empty) = "";
    node.append_attribute("rtcExt:position") = is_in ? "LEFT" : "RIGHT";
    node.append_attribute("rtcExt:variableName") = port.name.c_str();
    node.append_child("rtcDoc:Doc").append_attribute("rtcDoc:description") = port.doc.c_str();
    if (port.queue > 0) add_property(node, queue_property, std::to_string(port.queue));
    if (!port.safe.empty()) add_property(node, safe_property, port.safe);
}

void write_basic_info(const ComponentProfile& profile, const std::string& date, pugi::xml_node root) {
    // The first line of `doc` is the description, the others are the documentation.
    const std::size_t line_end = std::min(profile.doc.find('\n'), profile.doc.size());
    std::string line = profile.doc.substr(0, line_end);
    std::string rest = profile.doc.substr(std::min(line_end + 1, profile.doc.size()));
    if (rest != trimmed(rest) || rest == line) {
        line = profile.doc;
        rest.clear();
    }
    pugi::xml_node info = root.append_child("rtc:BasicInfo");
    info.append_attribute("xsi:type") = "rtcExt:basic_info_ext";
    const std::pair<const char*, std::string> attributes[] = {
        {"rtc:name", profile.name},
        {"rtc:componentType", "STATIC"},
        {"rtc:activityType", "PERIODIC"},
        {"rtc:componentKind", "DataFlowComponent"},
        {"rtc:category", profile.category},
        {"rtc:description", line},
        {"rtc:executionRate", fmt::format("{:.1f}", profile.rate)},
        {"rtc:executionType", "PeriodicExecutionContext"},
        {"rtc:maxInstances", "1"},
        {"rtc:vendor", profile.vendor},
        {"rtc:version", profile.version},
        {"rtc:creationDate", date},
        {"rtc:updateDate", date},
        {"rtcExt:saveProject", profile.name}};
    for (const auto& [name, value] : attributes) info.append_attribute(name) = value.c_str();
    if (!rest.empty()) info.append_child("rtcDoc:Doc").append_attribute("rtcDoc:description") = rest.c_str();
}

void write_actions(const ComponentProfile& profile, pugi::xml_node root) {
    pugi::xml_node actions = root.append_child("rtc:Actions");
    for (const ProfileCallback& callback : known_callbacks) {
        const bool is_there = callback.name.empty() ? std::string_view(callback.element) == "OnInitialize"
                                                    : contains(profile.callbacks, callback.name);
        pugi::xml_node node = actions.append_child((std::string("rtc:") + callback.element).c_str());
        node.append_attribute("xsi:type") = "rtcDoc:action_status_doc";
        node.append_attribute("rtc:implemented") = is_there;
    }
}

}  // namespace

Expected<std::string> write_component_profile(const ComponentProfile& profile, const std::string& date) {
    pugi::xml_document document;
    pugi::xml_node root = begin_profile(document, "rtc:RtcProfile");
    root.append_attribute("rtc:version") = "0.3";
    root.append_attribute("rtc:id") =
        fmt::format("RTC:{}:{}:{}:{}", profile.vendor, profile.category, profile.name, profile.version).c_str();
    root.append_attribute("xmlns:rtc") = "http://www.openrtp.org/namespaces/rtc";
    root.append_attribute("xmlns:rtcExt") = "http://www.openrtp.org/namespaces/rtc_ext";
    root.append_attribute("xmlns:rtcDoc") = "http://www.openrtp.org/namespaces/rtc_doc";
    root.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
    write_basic_info(profile, date, root);
    write_actions(profile, root);
    if (!profile.parameters.empty()) {
        const pugi::xml_node set = root.append_child("rtc:ConfigurationSet");
        for (const ParameterSpec& spec : profile.parameters) write_parameter(spec, set);
    }
    for (const ProfilePort& port : profile.ports) write_port(port, root);
    return save_profile(document);
}

}  // namespace nezumi::openrtm
