// A component as an RTC: its profile, its execution context and its ports.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include <rtm.hh>
#include "bindings/openrtm/orb/configuration_object.hpp"
#include "bindings/openrtm/orb/port_object.hpp"

namespace nezumi::openrtm {

/// The execution context: the system's tick. It activates, deactivates and resets.
class ContextObject final : public POA_RTC::ExecutionContextService {
public:
    ContextObject(RtcSite& site, const RtcProfile& profile)
        : site_(site), component_(profile.component), rate_(profile.rate) {}
    void begin(RTC::RTObject_ptr owner) { owner_ = RTC::RTObject::_duplicate(owner); }

    CORBA::Boolean is_running() override { return true; }
    RTC::ReturnCode_t start() override { return RTC::PRECONDITION_NOT_MET; }
    RTC::ReturnCode_t stop() override { return RTC::UNSUPPORTED; }
    CORBA::Double get_rate() override { return rate_; }
    RTC::ReturnCode_t set_rate(CORBA::Double /*rate*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t add_component(RTC::LightweightRTObject_ptr /*rtc*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t remove_component(RTC::LightweightRTObject_ptr /*rtc*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t activate_component(RTC::LightweightRTObject_ptr rtc) override;
    RTC::ReturnCode_t deactivate_component(RTC::LightweightRTObject_ptr rtc) override;
    RTC::ReturnCode_t reset_component(RTC::LightweightRTObject_ptr rtc) override;
    RTC::LifeCycleState get_component_state(RTC::LightweightRTObject_ptr rtc) override;
    RTC::ExecutionKind get_kind() override { return RTC::PERIODIC; }
    RTC::ExecutionContextProfile* get_profile() override;

private:
    RTC::ReturnCode_t perform(RtcRequest::What what, RTC::LightweightRTObject_ptr rtc);
    bool is_owner(RTC::LightweightRTObject_ptr rtc) const;

    RtcSite& site_;
    const std::string component_;
    const double rate_;
    RTC::RTObject_var owner_;
};

class RtcObject final : public POA_OpenRTM::DataFlowComponent {
public:
    /// `context`: of this computer in the name service.
    RtcObject(const Home& home, RtcProfile profile, std::string instance, std::string context);

    /// Activates the RTC.
    RTC::RTObject_ptr begin();
    /// Sends velocity 0 to robots, because the connections of its ports will end.
    void stop();
    /// Disconnects its ports as `PortObject::withdraw` does, and deactivates it. May wait for peers.
    void withdraw(std::chrono::steady_clock::time_point deadline);

    const RtcProfile& profile() const { return profile_; }
    const std::string& instance() const { return instance_; }
    RTC::RTObject_ptr reference() const { return self_.in(); }
    /// True if the RTC is registered in a name service.
    bool is_named() const { return is_named_; }
    void note_named() { is_named_ = true; }
    /// The port with this path in the system; nullptr if there is none.
    PortObject* find_port(std::string_view path) const;
    const std::vector<PortableServer::Servant_var<PortObject>>& ports() const { return ports_; }

    RTC::ComponentProfile* get_component_profile() override;
    RTC::PortServiceList* get_ports() override;

    CORBA::Boolean is_alive(RTC::ExecutionContext_ptr executor) override;
    RTC::ExecutionContext_ptr get_context(RTC::ExecutionContextHandle_t handle) override;
    RTC::ExecutionContextList* get_owned_contexts() override;
    RTC::ExecutionContextList* get_participating_contexts() override { return new RTC::ExecutionContextList; }
    RTC::ExecutionContextHandle_t get_context_handle(RTC::ExecutionContext_ptr executor) override;

    char* get_sdo_id() override { return corba_string(instance_); }
    char* get_sdo_type() override { return corba_string(profile_.type); }
    SDOPackage::DeviceProfile* get_device_profile() override;
    SDOPackage::ServiceProfileList* get_service_profiles() override { return new SDOPackage::ServiceProfileList; }
    SDOPackage::ServiceProfile* get_service_profile(const char* id) override;
    SDOPackage::SDOService_ptr get_sdo_service(const char* id) override;
    SDOPackage::Configuration_ptr get_configuration() override;
    SDOPackage::Monitoring_ptr get_monitoring() override;
    SDOPackage::OrganizationList* get_organizations() override { return new SDOPackage::OrganizationList; }
    SDOPackage::OrganizationList* get_owned_organizations() override { return new SDOPackage::OrganizationList; }
    SDOPackage::NVList* get_status_list() override { return new SDOPackage::NVList; }
    CORBA::Any* get_status(const char* name) override;

    // These are refused, because only the system initializes and ends the component.
    RTC::ReturnCode_t initialize() override { return RTC::PRECONDITION_NOT_MET; }
    RTC::ReturnCode_t finalize() override { return RTC::PRECONDITION_NOT_MET; }
    /// Removes the component from the system.
    RTC::ReturnCode_t exit() override;
    RTC::ExecutionContextHandle_t attach_context(RTC::ExecutionContext_ptr /*executor*/) override { return -1; }
    RTC::ReturnCode_t detach_context(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_initialize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_finalize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_startup(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_shutdown(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_activated(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_deactivated(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_aborting(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_error(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_reset(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_execute(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_state_update(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_rate_changed(RTC::ExecutionContextHandle_t /*handle*/) override { return RTC::UNSUPPORTED; }

private:
    static char* corba_string(const std::string& text) { return CORBA::string_dup(text.c_str()); }

    RtcSite& site_;
    const RtcProfile profile_;
    const std::string instance_;
    const std::string name_;  // "pc.host_cxt/controller0.rtc"
    std::atomic<bool> is_named_ = false;
    std::vector<PortableServer::Servant_var<PortObject>> ports_;
    PortableServer::Servant_var<ContextObject> context_;
    PortableServer::Servant_var<ConfigurationObject> configuration_;
    // Set by `begin`:
    RTC::RTObject_var self_;
    RTC::ExecutionContextService_var context_reference_;
    SDOPackage::Configuration_var configuration_reference_;
    RTC::PortServiceList port_references_;
};

}  // namespace nezumi::openrtm
