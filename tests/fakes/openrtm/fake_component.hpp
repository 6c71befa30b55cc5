// The RTC of the program that is one: its ports, its context and its configuration.
#pragma once

#include <string>
#include <utility>

#include "tests/fakes/openrtm/fake_port.hpp"
#include "tests/fakes/openrtm/fake_state.hpp"

namespace nezumi::fakes {

/// As much of an RTC as others ask of it.
class FakeRtc final : public POA_OpenRTM::DataFlowComponent {
public:
    FakeRtc(std::string name, RTC::PortService_ptr reference, const FakePort& port)
        : name_(std::move(name)), port_(reference), context_(new FakeContext(port)) {}
    void fail() { context_->fail(); }
    void be_busy(bool is_busy) { context_->be_busy(is_busy); }

    RTC::PortServiceList* get_ports() override {
        auto* list = new RTC::PortServiceList;
        list->length(1);
        (*list)[0] = RTC::PortService::_duplicate(port_);
        return list;
    }
    RTC::ComponentProfile* get_component_profile() override {
        auto* profile = new RTC::ComponentProfile;
        profile->instance_name = name_.c_str();
        profile->type_name = "Fake";
        return profile;
    }
    CORBA::Boolean is_alive(RTC::ExecutionContext_ptr) override { return true; }
    RTC::ExecutionContext_ptr get_context(RTC::ExecutionContextHandle_t) override { return context_->_this(); }
    RTC::ExecutionContextList* get_owned_contexts() override {
        auto* list = new RTC::ExecutionContextList;
        list->length(1);
        (*list)[0] = context_->_this();
        return list;
    }
    RTC::ExecutionContextList* get_participating_contexts() override { return new RTC::ExecutionContextList; }
    RTC::ExecutionContextHandle_t get_context_handle(RTC::ExecutionContext_ptr) override { return 0; }
    RTC::ExecutionContextHandle_t attach_context(RTC::ExecutionContext_ptr) override { return 0; }
    RTC::ReturnCode_t detach_context(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t initialize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t finalize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t exit() override {
        print("exits");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t on_initialize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_finalize() override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_startup(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_shutdown(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_activated(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_deactivated(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_aborting(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_error(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_reset(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_execute(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_state_update(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t on_rate_changed(RTC::ExecutionContextHandle_t) override { return RTC::UNSUPPORTED; }
    char* get_sdo_id() override { return CORBA::string_dup(name_.c_str()); }
    char* get_sdo_type() override { return CORBA::string_dup("fake"); }
    SDOPackage::DeviceProfile* get_device_profile() override { return new SDOPackage::DeviceProfile; }
    SDOPackage::ServiceProfileList* get_service_profiles() override { return new SDOPackage::ServiceProfileList; }
    SDOPackage::ServiceProfile* get_service_profile(const char*) override { throw SDOPackage::NotAvailable("none"); }
    SDOPackage::SDOService_ptr get_sdo_service(const char*) override { throw SDOPackage::NotAvailable("none"); }
    SDOPackage::Configuration_ptr get_configuration() override { return configuration_->_this(); }
    SDOPackage::Monitoring_ptr get_monitoring() override { return SDOPackage::Monitoring::_nil(); }
    SDOPackage::OrganizationList* get_organizations() override { return new SDOPackage::OrganizationList; }
    SDOPackage::OrganizationList* get_owned_organizations() override { return new SDOPackage::OrganizationList; }
    SDOPackage::NVList* get_status_list() override { return new SDOPackage::NVList; }
    CORBA::Any* get_status(const char*) override { return new CORBA::Any; }

private:
    const std::string name_;
    RTC::PortService_ptr port_;
    PortableServer::Servant_var<FakeContext> context_;
    PortableServer::Servant_var<FakeConfiguration> configuration_{new FakeConfiguration};
};

}  // namespace nezumi::fakes
