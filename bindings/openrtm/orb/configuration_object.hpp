// The parameters of a component as configuration sets.
#pragma once

#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

class ConfigurationObject final : public POA_SDOPackage::Configuration {
public:
    ConfigurationObject(RtcSite& site, std::string component) : site_(site), component_(std::move(component)) {}

    SDOPackage::ConfigurationSetList* get_configuration_sets() override;
    SDOPackage::ConfigurationSet* get_configuration_set(const char* id) override;
    SDOPackage::ConfigurationSet* get_active_configuration_set() override;
    CORBA::Boolean set_configuration_set_values(const SDOPackage::ConfigurationSet& values) override;
    CORBA::Boolean activate_configuration_set(const char* id) override;
    SDOPackage::NVList* get_configuration_parameter_values() override;
    CORBA::Any* get_configuration_parameter_value(const char* name) override;
    CORBA::Boolean set_configuration_parameter(const char* name, const CORBA::Any& value) override;

    // Not supported, because configuration sets come from the system file, and there are no organizations.
    SDOPackage::ParameterList* get_configuration_parameters() override { return new SDOPackage::ParameterList; }
    CORBA::Boolean add_configuration_set(const SDOPackage::ConfigurationSet& /*values*/) override { return false; }
    CORBA::Boolean remove_configuration_set(const char* /*id*/) override { return false; }
    CORBA::Boolean set_device_profile(const SDOPackage::DeviceProfile& /*profile*/) override { return false; }
    CORBA::Boolean add_service_profile(const SDOPackage::ServiceProfile& /*profile*/) override { return false; }
    CORBA::Boolean add_organization(SDOPackage::Organization_ptr /*item*/) override { return false; }
    CORBA::Boolean remove_service_profile(const char* /*id*/) override { return false; }
    CORBA::Boolean remove_organization(const char* /*id*/) override { return false; }

private:
    bool perform(RtcRequest request);
    Texts active_values();

    RtcSite& site_;
    const std::string component_;
};

}  // namespace nezumi::openrtm
