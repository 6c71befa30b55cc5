// One reader for all versions: version 0.1 has other names for some attributes, but only for those that are not used.
#include "bindings/openrtm/component_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "bindings/openrtm/profile_names.hpp"
#include "bindings/openrtm/profile_parameter.hpp"
#include "bindings/openrtm/profile_xml.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::openrtm {
namespace {

std::string plain(std::string_view text) { return std::string(trimmed(without_html_breaks(text, "\n"))); }

std::string in_one_line(std::string_view text) {
    std::string line(trimmed(without_html_breaks(text, " ")));
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return line;
}

// "RTC::TimedLong" becomes "TimedLong"; types of other modules keep the module: "Img/CameraImage".
std::string message_type_in(std::string_view type) {
    if (type.starts_with("::")) type.remove_prefix(2);
    if (type.starts_with("RTC::")) type.remove_prefix(5);
    std::string name;
    for (std::size_t at = 0; at < type.size(); ++at) {
        const bool ends_module = type.substr(at).starts_with("::");
        name += ends_module ? '/' : type[at];
        if (ends_module) ++at;
    }
    return name;
}

class ProfileReader {
public:
    ComponentProfile read(const pugi::xml_node& root) {
        read_basic_info(element_of(root, "BasicInfo"));
        read_actions(element_of(root, "Actions"));
        for (const pugi::xml_node& set : elements_of(root, "ConfigurationSet")) {
            for (const pugi::xml_node& each : elements_of(set, "Configuration")) {
                if (auto parameter = read_parameter(each, profile_.remarks))
                    profile_.parameters.push_back(std::move(*parameter));
            }
        }
        for (const pugi::xml_node& each : elements_of(root, "DataPorts")) read_port(each);
        for (const pugi::xml_node& each : elements_of(root, "ServicePorts")) read_service_port(each);
        for (const pugi::xml_node& each : elements_of(root, "Language")) read_language(each);
        return std::move(profile_);
    }

private:
    void remark(std::string_view what, std::string_view said) {
        if (const std::string line = in_one_line(said); !line.empty())
            profile_.remarks.push_back(fmt::format("{}: {}", what, line));
    }
    // Adds a remark, unless the value is `usual`, which RTCBuilder always writes.
    void remark_unless(const pugi::xml_node& node, const char* name, std::string_view usual) {
        if (const std::string_view said = attribute_of(node, name); said != usual) remark(name, said);
    }

    void read_basic_info(const pugi::xml_node& info) {
        const auto text = [&](const char* name) { return std::string(attribute_of(info, name)); };
        const pugi::xml_node doc = element_of(info, "Doc");
        profile_.name = text("name");
        profile_.version = text("version");
        profile_.vendor = text("vendor");
        profile_.category = text("category");
        profile_.doc = plain(text("description"));
        const std::string more = plain(attribute_of(doc, "description"));
        if (!more.empty() && more != profile_.doc) profile_.doc += (profile_.doc.empty() ? "" : "\n") + more;
        const std::string rate = text("executionRate");
        std::from_chars(rate.data(), rate.data() + rate.size(), profile_.rate);
        if (!std::isfinite(profile_.rate) || profile_.rate < 0) profile_.rate = 0;
        std::string executes = text("activityType");
        if (profile_.rate > 0) executes += fmt::format("{}at {} Hz", executes.empty() ? "" : " ", profile_.rate);
        if (!executes.empty()) remark("executes", executes + "; nezumi uses the system's rate");
        remark_unless(info, "componentType", "STATIC");
        remark_unless(info, "componentKind", "DataFlowComponent");
        remark_unless(info, "executionType", "PeriodicExecutionContext");
        remark_unless(info, "maxInstances", "1");
        for (const char* name : {"rtcType", "abstract", "hardwareProfile", "comment"}) remark_unless(info, name, "");
        for (const char* name : {"inout", "algorithm", "creator", "license", "reference"}) remark_unless(doc, name, "");
        for (const pugi::xml_node& log : elements_of(info, "VersionUpLogs")) remark("history", log.text().get());
        for (const auto& [name, value] : properties_of(info)) remark(in_one_line(name), value);
    }

    void read_actions(const pugi::xml_node& actions) {
        for (const ProfileCallback& callback : known_callbacks) {
            const pugi::xml_node node = element_of(actions, callback.element);
            const std::string_view implemented = attribute_of(node, "implemented");
            if (implemented != "true" && implemented != "1") continue;
            if (!callback.name.empty()) {
                profile_.callbacks.emplace_back(callback.name);
            } else if (std::string_view(callback.element) != "OnInitialize") {  // here the file's top level
                profile_.remarks.push_back(fmt::format("callback {}", callback.element));
            }
            const pugi::xml_node doc = element_of(node, "Doc");
            for (const char* name : {"description", "preCondition", "postCondition"}) {
                if (const std::string_view said = attribute_of(doc, name); !said.empty())
                    remark(fmt::format("callback {}, {}", callback.element, name), said);
            }
        }
    }

    void read_port(const pugi::xml_node& node) {
        ProfilePort port;
        port.name = attribute_of(node, "name");
        const std::string_view direction = attribute_of(node, "portType");
        if (direction != "DataInPort" && direction != "DataOutPort") {
            profile_.remarks.push_back(fmt::format("port '{}': {} of type {}", shown(port.name), shown(direction),
                                                   shown(attribute_of(node, "type"))));
            return;
        }
        port.direction = direction == "DataInPort" ? Direction::in : Direction::out;
        port.type = message_type_in(attribute_of(node, "type"));
        port.idl_file = attribute_of(node, "idlFile");
        port.doc = doc_of(node);
        const auto more = [&](std::string_view what) {
            return fmt::format("port '{}', {}", shown(port.name), shown(what));
        };
        for (const char* name : {"interfaceType", "dataflowType", "subscriptionType", "subscriprionType", "comment"})
            remark(more(name), attribute_of(node, name));
        for (const pugi::xml_node& event : elements_of(node, "Event"))
            remark(more("event"), attribute_of(event, "name"));
        if (element_of(node, "Constraint")) profile_.remarks.push_back(more("a constraint"));
        for (const auto& [name, value] : properties_of(node)) {
            if (name == queue_property) {
                std::from_chars(value.data(), value.data() + value.size(), port.queue);
            } else if (name == safe_property) {
                port.safe = value;
            } else {
                remark(more(name), value);
            }
        }
        profile_.ports.push_back(std::move(port));
    }

    // The documentation of a port as one text: its description, then its unit, then the rest.
    static std::string doc_of(const pugi::xml_node& port) {
        const pugi::xml_node doc = element_of(port, "Doc");
        std::string text = without_html_breaks(attribute_of(doc, "description"), " ");
        const std::string_view unit = attribute_of(doc, "unit").empty() ? attribute_of(port, "unit")  //
                                                                        : attribute_of(doc, "unit");
        if (!unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", unit);
        for (const char* name : {"semantics", "number", "operation"}) {
            const std::string_view said = attribute_of(doc, name);
            const bool is_usual = std::string_view(name) == "number" && said == "1";
            if (!said.empty() && !is_usual)
                text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", name, without_html_breaks(said, " "));
        }
        return text;
    }

    void read_service_port(const pugi::xml_node& node) {
        const std::string port = fmt::format("service port '{}'", shown(attribute_of(node, "name")));
        const auto interfaces = elements_of(node, "ServiceInterface");
        if (interfaces.empty()) profile_.remarks.push_back(port);
        for (const pugi::xml_node& each : interfaces) {
            const std::string_view type = attribute_of(each, "type"), idl = attribute_of(each, "idlFile");
            remark(port, fmt::format("{} {}{}", attribute_of(each, "direction") == "Required" ? "requires" : "provides",
                                     type.empty() ? attribute_of(each, "name") : type,
                                     idl.empty() ? "" : fmt::format(" of {}", idl)));
        }
    }

    void read_language(const pugi::xml_node& node) {
        std::string_view kind = attribute_of(node, "kind");
        const auto own = elements_of(node);  // in version 0.1, the element's name is the language
        if (kind.empty() && !own.empty() && local_name(own.front().name()) != "targets")
            kind = local_name(own.front().name());
        remark("language", kind);
        for (const pugi::xml_node& target : elements_of(node, "targets")) {
            remark("operating system", attribute_of(target, "os"));
            for (const pugi::xml_node& library : elements_of(target, "libraries")) {
                remark("library", fmt::format("{} {} {}", attribute_of(library, "name"),
                                              attribute_of(library, "version"), attribute_of(library, "other")));
            }
        }
    }

    ComponentProfile profile_;
};

}  // namespace

Expected<ComponentProfile> read_component_profile(std::string_view text, const std::string& shown_file) {
    pugi::xml_document document;
    const auto root = open_profile(text, shown_file, "RtcProfile", document);
    if (!root) return Unexpected(root.error());
    ComponentProfile profile = ProfileReader().read(*root);
    if (profile.name.empty()) return failure("has no component: BasicInfo has no name", {shown_file});
    return profile;
}

}  // namespace nezumi::openrtm
