// After adding a component, the manager waits until the keeper's thread has exported it.
#include "bindings/openrtm/orb/manager_object.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <thread>

#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/servants.hpp"

namespace nezumi::openrtm {
namespace {

// The longest argument of `create_component`.
constexpr std::size_t most_letters = 4096;
// The number of names that are tried for a new component: "controller", "controller_2", ...
constexpr int most_names = 100;
// The longest time until a new component is exported.
constexpr std::chrono::milliseconds longest_export{2000};

// A requested component: its type "RobotController", and properties by name.
struct Wanted {
    std::string type{};
    std::string instance{};
    Texts values{};
};

Wanted wanted_of(std::string_view text) {
    const std::size_t mark = std::min(text.find('?'), text.size());
    std::string_view type = text.substr(0, mark);
    // The last but one part of "RTC:Vendor:Category:Type:1.0".
    if (const std::size_t last = type.rfind(':'); last != std::string_view::npos) {
        type = type.substr(0, last);
        type = type.substr(type.rfind(':') + 1);
    }
    Wanted wanted{.type = std::string(type)};
    std::string_view rest = text.substr(std::min(mark + 1, text.size()));
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('&'), rest.size());
        const std::string_view pair = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos) continue;
        const std::string_view name = pair.substr(0, equals), value = pair.substr(equals + 1);
        constexpr std::string_view parameter = "conf.default.";
        if (name == "instance_name") wanted.instance = value;
        if (name.starts_with(parameter)) wanted.values.emplace_back(name.substr(parameter.size()), value);
    }
    return wanted;
}

}  // namespace

RTM::Manager_ptr ManagerObject::begin() {
    self_ = _this();
    return self_.in();
}

void ManagerObject::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
}

std::vector<PortableServer::Servant_var<RtcObject>> ManagerObject::listed() {
    const std::lock_guard lock(mutex_);
    if (ended_) return {};
    return list_();
}

RTM::ModuleProfileList* ManagerObject::modules() {
    const std::vector<RtcModule> all = site_.modules();
    RTM::ModuleProfileList_var list = new RTM::ModuleProfileList;
    list->length(static_cast<CORBA::ULong>(all.size()));
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        SDOPackage::NVList& properties = list[i].properties;
        add_text(properties, "module_name", all[i].type);
        add_text(properties, "module_file_name", all[i].name + ".lua");
        add_text(properties, "implementation_id", all[i].type);
        add_text(properties, "type_name", all[i].type);
        add_text(properties, "language", "Lua");
        add_text(properties, "lang_type", "SCRIPT");
    }
    return list._retn();
}

RTC::ReturnCode_t ManagerObject::load_module(const char* name, const char* /*init*/) {
    std::string_view script = name;
    script = script.substr(script.rfind('/') + 1);
    if (constexpr std::string_view ending = ".lua"; script.ends_with(ending)) script.remove_suffix(ending.size());
    const std::vector<RtcModule> all = site_.modules();
    const bool is_known =
        std::any_of(all.begin(), all.end(), [&](const RtcModule& each) { return each.name == script; });
    return is_known ? RTC::RTC_OK : RTC::BAD_PARAMETER;
}

// Returns the name of the new component; "" if there is none.
std::string ManagerObject::make(const std::string& script, const std::string& wanted) {
    for (int i = 1; i <= most_names; ++i) {
        std::string name = i == 1 ? wanted : wanted + "_" + std::to_string(i);
        const RtcAnswer answer = site_.perform({.what = RtcRequest::What::create, .component = name, .script = script});
        if (answer == RtcAnswer::done) return name;
        if (answer != RtcAnswer::taken) return "";
    }
    return "";
}

RTC::RTObject_ptr ManagerObject::find_soon(const std::string& component) {
    const auto end = std::chrono::steady_clock::now() + longest_export;
    RTC::RTObject_var made;  // returned without a registered name if no name service answers in time
    while (std::chrono::steady_clock::now() < end) {
        for (const auto& rtc : listed()) {
            if (rtc->profile().component != component) continue;
            made = RTC::RTObject::_duplicate(rtc->reference());
            if (rtc->is_named()) return made._retn();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return made._retn();
}

RTC::RTObject_ptr ManagerObject::create_component(const char* text) {
    if (std::string_view(text).size() > most_letters) return RTC::RTObject::_nil();
    const Wanted wanted = wanted_of(text);
    const std::vector<RtcModule> all = site_.modules();
    const auto module = std::find_if(all.begin(), all.end(), [&](const RtcModule& each) {
        return each.type == wanted.type || each.name == wanted.type;
    });
    if (module == all.end()) {
        site_.tell(true, "rtm: a tool can't add '" + wanted.type + "': there is no such behaviour");
        return RTC::RTObject::_nil();
    }
    // The component "controller" is the RTC "controller0".
    std::string name = wanted.instance.empty() ? module->name : wanted.instance;
    if (!wanted.instance.empty()) name.resize(name.find_last_not_of("0123456789") + 1);
    name = make(module->name, name);
    if (name.empty()) return RTC::RTObject::_nil();
    if (!wanted.values.empty()) {
        const RtcAnswer set = site_.perform(
            {.what = RtcRequest::What::set, .component = name, .set = "default", .values = wanted.values});
        if (set != RtcAnswer::done)
            site_.tell(true, "rtm: " + name + " does not take the values that a tool has given");
    }
    return find_soon(name);
}

RTC::ReturnCode_t ManagerObject::delete_component(const char* instance) {
    for (const auto& rtc : listed()) {
        if (rtc->instance() == instance) return rtc->exit();
    }
    return RTC::BAD_PARAMETER;
}

RTC::RTCList* ManagerObject::components(std::string_view name) {
    RTC::RTCList_var list = new RTC::RTCList;
    for (const auto& rtc : listed()) {
        if (!name.empty() && rtc->instance() != name) continue;
        list->length(list->length() + 1);
        list[list->length() - 1] = RTC::RTObject::_duplicate(rtc->reference());
    }
    return list._retn();
}

RTC::ComponentProfileList* ManagerObject::get_component_profiles() {
    RTC::ComponentProfileList_var list = new RTC::ComponentProfileList;
    for (const auto& rtc : listed()) {
        const RTC::ComponentProfile_var profile = rtc->get_component_profile();
        list->length(list->length() + 1);
        list[list->length() - 1] = profile.in();
    }
    return list._retn();
}

RTM::ManagerProfile* ManagerObject::get_profile() {
    RTM::ManagerProfile_var profile = new RTM::ManagerProfile;
    add_text(profile->properties, "instance_name", instance_);
    add_text(profile->properties, "name", instance_);
    add_text(profile->properties, "language", "Lua");
    return profile._retn();
}

RTM::NVList* ManagerObject::get_configuration() {
    SDOPackage::NVList_var list = new SDOPackage::NVList;
    add_text(list, "manager.instance_name", instance_);
    add_text(list, "manager.language", "Lua");
    add_text(list, "manager.is_master", "YES");
    return list._retn();
}

RTC::ReturnCode_t ManagerObject::shutdown() { return code_of(site_.perform({.what = RtcRequest::What::end})); }

}  // namespace nezumi::openrtm
