// The manager by which OpenRTM's tools add and remove behaviours of a system, and end its run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/rtc_object.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

/// Returns the components that are exported now.
using RtcLister = std::function<std::vector<PortableServer::Servant_var<RtcObject>>()>;

class ManagerObject final : public POA_RTM::Manager {
public:
    /// `instance`: its name in the name service, without the kind.
    ManagerObject(RtcSite& site, std::string instance, RtcLister list)
        : site_(site), instance_(std::move(instance)), list_(std::move(list)) {}

    RTM::Manager_ptr begin();
    /// From now on, no components are listed, and `list` is not called.
    void end();
    RTM::Manager_ptr reference() const { return self_.in(); }
    const std::string& instance() const { return instance_; }

    /// Only checks that the module exists: each behaviour is a module that counts as loaded.
    RTC::ReturnCode_t load_module(const char* name, const char* init) override;
    RTM::ModuleProfileList* get_loadable_modules() override { return modules(); }
    RTM::ModuleProfileList* get_loaded_modules() override { return modules(); }
    RTM::ModuleProfileList* get_factory_profiles() override { return modules(); }
    /// `text` is "RobotController?instance_name=controller0&conf.default.speed_x=0.2"; before the question mark there
    /// may also be an id "RTC:Vendor:Category:Type:1.0". The new component is INACTIVE. Returns nil if it can't be
    /// made; the log has the reason.
    RTC::RTObject_ptr create_component(const char* text) override;
    RTC::ReturnCode_t delete_component(const char* instance) override;
    RTC::RTCList* get_components() override { return components(""); }
    RTC::ComponentProfileList* get_component_profiles() override;
    RTC::RTCList* get_components_by_name(const char* name) override { return components(name); }
    RTM::ManagerProfile* get_profile() override;
    RTM::NVList* get_configuration() override;
    RTC::ReturnCode_t shutdown() override;

    // There is only one manager, and it can't be changed, because its settings come from the system file.
    CORBA::Boolean is_master() override { return true; }
    RTM::ManagerList* get_master_managers() override { return new RTM::ManagerList; }
    RTM::ManagerList* get_slave_managers() override { return new RTM::ManagerList; }
    RTC::ReturnCode_t unload_module(const char* /*name*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t set_configuration(const char* /*name*/, const char* /*value*/) override {
        return RTC::UNSUPPORTED;
    }
    RTC::ReturnCode_t add_master_manager(RTM::Manager_ptr /*manager*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t remove_master_manager(RTM::Manager_ptr /*manager*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t add_slave_manager(RTM::Manager_ptr /*manager*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t remove_slave_manager(RTM::Manager_ptr /*manager*/) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t fork() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t restart() override { return RTC::UNSUPPORTED; }
    CORBA::Object_ptr get_service(const char* /*name*/) override { return CORBA::Object::_nil(); }

private:
    std::vector<PortableServer::Servant_var<RtcObject>> listed();
    RTM::ModuleProfileList* modules();
    RTC::RTCList* components(std::string_view name);
    std::string make(const std::string& script, const std::string& wanted);
    RTC::RTObject_ptr find_soon(const std::string& component);

    RtcSite& site_;
    const std::string instance_;
    const RtcLister list_;
    RTM::Manager_var self_;
    Mutex mutex_;  // for the next one, and while `list_` is called
    bool ended_ = false;
};

}  // namespace nezumi::openrtm
