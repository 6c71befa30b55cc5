// Values are read from the component's latest snapshot, and set by requests, which are checked like any other act.
#include "bindings/openrtm/orb/configuration_object.hpp"

#include <algorithm>

#include "bindings/openrtm/orb/properties.hpp"

namespace nezumi::openrtm {
namespace {

constexpr const char* no_set = "there is no configuration set of this name";
constexpr const char* no_parameter = "there is no parameter of this name";

SDOPackage::NVList list_of(const Texts& texts) {
    SDOPackage::NVList list;
    for (const auto& [name, text] : texts) add_text(list, name, text);
    return list;
}

SDOPackage::ConfigurationSet set_of(const std::string& id, const Texts& values) {
    SDOPackage::ConfigurationSet set;
    set.id = corba_text(id);
    set.description = corba_text("");
    set.configuration_data = list_of(values);
    return set;
}

const Texts* find(const RtcSnapshot& snapshot, std::string_view id) {
    const auto found =
        std::find_if(snapshot.sets.begin(), snapshot.sets.end(), [&](const auto& set) { return set.first == id; });
    return found != snapshot.sets.end() ? &found->second : nullptr;
}

}  // namespace

// Throws CORBA's exception for an invalid request. Returns whether it was executed.
bool ConfigurationObject::perform(RtcRequest request) {
    request.component = component_;
    switch (site_.perform(request)) {
        case RtcAnswer::done: return true;
        case RtcAnswer::taken:
        case RtcAnswer::refused: return false;
        case RtcAnswer::unknown: throw SDOPackage::InvalidParameter(no_parameter);
        case RtcAnswer::busy: break;
    }
    throw SDOPackage::NotAvailable("the system is busy");
}

Texts ConfigurationObject::active_values() {
    const RtcSnapshot snapshot = site_.snapshot(component_);
    const Texts* values = find(snapshot, snapshot.set);
    return values != nullptr ? *values : Texts{};
}

SDOPackage::ConfigurationSetList* ConfigurationObject::get_configuration_sets() {
    const RtcSnapshot snapshot = site_.snapshot(component_);
    SDOPackage::ConfigurationSetList_var list = new SDOPackage::ConfigurationSetList;
    for (const auto& [id, values] : snapshot.sets) {
        list->length(list->length() + 1);
        list[list->length() - 1] = set_of(id, values);
    }
    return list._retn();
}

SDOPackage::ConfigurationSet* ConfigurationObject::get_configuration_set(const char* id) {
    const RtcSnapshot snapshot = site_.snapshot(component_);
    const Texts* values = find(snapshot, id);
    if (values == nullptr) throw SDOPackage::InvalidParameter(no_set);
    return new SDOPackage::ConfigurationSet(set_of(id, *values));
}

SDOPackage::ConfigurationSet* ConfigurationObject::get_active_configuration_set() {
    const RtcSnapshot snapshot = site_.snapshot(component_);
    const Texts* values = find(snapshot, snapshot.set);
    return new SDOPackage::ConfigurationSet(set_of(snapshot.set, values != nullptr ? *values : Texts{}));
}

CORBA::Boolean ConfigurationObject::set_configuration_set_values(const SDOPackage::ConfigurationSet& values) {
    RtcRequest request{.what = RtcRequest::What::set, .set = values.id.in()};
    for (CORBA::ULong i = 0; i < values.configuration_data.length(); ++i) {
        const SDOPackage::NameValue& value = values.configuration_data[i];
        request.values.emplace_back(value.name.in(), text_of(value.value));
    }
    return perform(std::move(request));
}

CORBA::Boolean ConfigurationObject::activate_configuration_set(const char* id) {
    const RtcSnapshot snapshot = site_.snapshot(component_);
    if (find(snapshot, id) == nullptr) throw SDOPackage::InvalidParameter(no_set);
    return perform({.what = RtcRequest::What::use, .set = id});
}

SDOPackage::NVList* ConfigurationObject::get_configuration_parameter_values() {
    return new SDOPackage::NVList(list_of(active_values()));
}

CORBA::Any* ConfigurationObject::get_configuration_parameter_value(const char* name) {
    for (const auto& [each, text] : active_values()) {
        if (each != name) continue;
        CORBA::Any_var value = new CORBA::Any;
        value.inout() <<= text.c_str();
        return value._retn();
    }
    throw SDOPackage::InvalidParameter(no_parameter);
}

CORBA::Boolean ConfigurationObject::set_configuration_parameter(const char* name, const CORBA::Any& value) {
    return perform({.what = RtcRequest::What::set,
                    .set = site_.snapshot(component_).set,
                    .values = {{std::string(name), text_of(value)}}});
}

}  // namespace nezumi::openrtm
