// The description of an RTC, and the operations of its execution context.
#include "bindings/openrtm/orb/rtc_object.hpp"

#include <utility>

#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/servants.hpp"

namespace nezumi::openrtm {
namespace {

// The vendor of components that give none.
constexpr const char* vendor = "nezumi";
constexpr const char* version = "1.0";
constexpr const char* category = "nezumi";
// The handle of the only execution context.
constexpr RTC::ExecutionContextHandle_t own_handle = 0;

}  // namespace

bool ContextObject::is_owner(RTC::LightweightRTObject_ptr rtc) const {
    return !CORBA::is_nil(rtc) && owner_->_is_equivalent(rtc);
}

RTC::ReturnCode_t ContextObject::perform(RtcRequest::What what, RTC::LightweightRTObject_ptr rtc) {
    if (!is_owner(rtc)) return RTC::BAD_PARAMETER;
    return code_of(site_.perform({.what = what, .component = component_}));
}

RTC::ReturnCode_t ContextObject::activate_component(RTC::LightweightRTObject_ptr rtc) {
    return perform(RtcRequest::What::activate, rtc);
}

RTC::ReturnCode_t ContextObject::deactivate_component(RTC::LightweightRTObject_ptr rtc) {
    return perform(RtcRequest::What::deactivate, rtc);
}

RTC::ReturnCode_t ContextObject::reset_component(RTC::LightweightRTObject_ptr rtc) {
    return perform(RtcRequest::What::reset, rtc);
}

RTC::LifeCycleState ContextObject::get_component_state(RTC::LightweightRTObject_ptr rtc) {
    if (!is_owner(rtc)) return RTC::CREATED_STATE;
    switch (site_.snapshot(component_).state) {
        case RtcState::inactive: return RTC::INACTIVE_STATE;
        case RtcState::active: return RTC::ACTIVE_STATE;
        case RtcState::error: break;
    }
    return RTC::ERROR_STATE;
}

RTC::ExecutionContextProfile* ContextObject::get_profile() {
    RTC::ExecutionContextProfile_var profile = new RTC::ExecutionContextProfile;
    profile->kind = RTC::PERIODIC;
    profile->rate = rate_;
    profile->owner = RTC::RTObject::_duplicate(owner_);
    return profile._retn();
}

RtcObject::RtcObject(const Home& home, RtcProfile profile, std::string instance, std::string context)
    : site_(home.site),
      profile_(std::move(profile)),
      instance_(std::move(instance)),
      name_(std::move(context) + "/" + instance_ + ".rtc"),
      context_(new ContextObject(home.site, profile_)),
      configuration_(new ConfigurationObject(home.site, profile_.component)) {
    for (const RtcPort& port : profile_.ports) ports_.emplace_back(new PortObject(home, port));
}

RTC::RTObject_ptr RtcObject::begin() {
    const OpenRTM::DataFlowComponent_var self = _this();
    self_ = RTC::RTObject::_duplicate(self);
    context_->begin(self_);
    context_reference_ = context_->_this();
    configuration_reference_ = configuration_->_this();
    port_references_.length(static_cast<CORBA::ULong>(ports_.size()));
    for (CORBA::ULong i = 0; i < port_references_.length(); ++i)
        port_references_[i] = ports_[i]->begin(self_, instance_);
    return self_;
}

void RtcObject::stop() {
    for (const auto& port : ports_) port->stop();
}

void RtcObject::withdraw(std::chrono::steady_clock::time_point deadline) {
    for (const auto& port : ports_) port->withdraw(deadline);
    deactivate(*context_.in());
    deactivate(*configuration_.in());
    deactivate(*this);
}

PortObject* RtcObject::find_port(std::string_view path) const {
    for (const auto& port : ports_) {
        if (port->port().path == path) return port.in();
    }
    return nullptr;
}

RTC::ComponentProfile* RtcObject::get_component_profile() {
    RTC::ComponentProfile_var profile = new RTC::ComponentProfile;
    profile->instance_name = corba_string(instance_);
    profile->type_name = corba_string(profile_.type);
    const RtcSnapshot snapshot = site_.snapshot(profile_.component);
    profile->description = corba_string(snapshot.description.empty() ? profile_.type : snapshot.description);
    profile->version = corba_string(snapshot.version.empty() ? version : snapshot.version);
    profile->vendor = corba_string(snapshot.vendor.empty() ? vendor : snapshot.vendor);
    profile->category = corba_string(snapshot.category.empty() ? category : snapshot.category);
    profile->port_profiles.length(static_cast<CORBA::ULong>(ports_.size()));
    for (CORBA::ULong i = 0; i < profile->port_profiles.length(); ++i) {
        const RTC::PortProfile_var port = ports_[i]->get_port_profile();
        profile->port_profiles[i] = port.in();
    }
    add_text(profile->properties, "instance_name", instance_);
    add_text(profile->properties, "type_name", profile_.type);
    add_text(profile->properties, "implementation_id", profile_.type);
    add_text(profile->properties, "language", "nezumi");
    add_text(profile->properties, "naming.names", name_);
    return profile._retn();
}

RTC::PortServiceList* RtcObject::get_ports() { return new RTC::PortServiceList(port_references_); }

RTC::ReturnCode_t RtcObject::exit() {
    return code_of(site_.perform({.what = RtcRequest::What::exit, .component = profile_.component}));
}

CORBA::Boolean RtcObject::is_alive(RTC::ExecutionContext_ptr executor) {
    return !CORBA::is_nil(executor) && context_reference_->_is_equivalent(executor);
}

RTC::ExecutionContext_ptr RtcObject::get_context(RTC::ExecutionContextHandle_t handle) {
    if (handle != own_handle) return RTC::ExecutionContext::_nil();
    return RTC::ExecutionContext::_duplicate(context_reference_);
}

RTC::ExecutionContextList* RtcObject::get_owned_contexts() {
    RTC::ExecutionContextList_var list = new RTC::ExecutionContextList;
    list->length(1);
    list[0] = RTC::ExecutionContext::_duplicate(context_reference_);
    return list._retn();
}

RTC::ExecutionContextHandle_t RtcObject::get_context_handle(RTC::ExecutionContext_ptr executor) {
    return is_alive(executor) ? own_handle : -1;
}

SDOPackage::DeviceProfile* RtcObject::get_device_profile() {
    SDOPackage::DeviceProfile_var profile = new SDOPackage::DeviceProfile;
    profile->device_type = corba_string(profile_.type);
    profile->manufacturer = CORBA::string_dup(vendor);
    profile->model = corba_string(profile_.type);
    profile->version = CORBA::string_dup(version);
    return profile._retn();
}

SDOPackage::ServiceProfile* RtcObject::get_service_profile(const char* /*id*/) {
    throw SDOPackage::InvalidParameter("there are no services");
}

SDOPackage::SDOService_ptr RtcObject::get_sdo_service(const char* /*id*/) {
    throw SDOPackage::InvalidParameter("there are no services");
}

SDOPackage::Configuration_ptr RtcObject::get_configuration() {
    return SDOPackage::Configuration::_duplicate(configuration_reference_);
}

SDOPackage::Monitoring_ptr RtcObject::get_monitoring() {
    throw SDOPackage::InterfaceNotImplemented("there is no monitoring");
}

CORBA::Any* RtcObject::get_status(const char* /*name*/) {
    throw SDOPackage::InvalidParameter("there is no status of this name");
}

}  // namespace nezumi::openrtm
