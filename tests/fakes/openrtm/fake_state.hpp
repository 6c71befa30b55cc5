// State and configuration of the RTC that is a program of its own.
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include <rtm.hh>
#include "tests/fakes/openrtm/fake_port.hpp"

namespace nezumi::fakes {

/// An execution context. As in OpenRTM-aist 2.1 a state changes only while it runs and executes nothing else; an order
/// that has to wait is answered by RTC_ERROR. It is followed later, but a start forgets an activation.
class FakeContext final : public POA_RTC::ExecutionContextService {
public:
    explicit FakeContext(const FakePort& port) : port_(port) {}
    CORBA::Boolean is_running() override { return runs_; }
    RTC::ReturnCode_t start() override {
        if (runs_.exchange(true)) return RTC::PRECONDITION_NOT_MET;
        const std::lock_guard lock(mutex_);
        if (waiting_.first == RTC::ACTIVE_STATE) waiting_ = {};
        follow();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t stop() override { return runs_.exchange(false) ? RTC::RTC_OK : RTC::PRECONDITION_NOT_MET; }
    CORBA::Double get_rate() override { return port_.rate(); }
    RTC::ReturnCode_t set_rate(CORBA::Double) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t add_component(RTC::LightweightRTObject_ptr) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t remove_component(RTC::LightweightRTObject_ptr) override { return RTC::UNSUPPORTED; }
    RTC::ReturnCode_t activate_component(RTC::LightweightRTObject_ptr) override {
        return change(RTC::INACTIVE_STATE, RTC::ACTIVE_STATE, "activated");
    }
    RTC::ReturnCode_t deactivate_component(RTC::LightweightRTObject_ptr) override {
        return change(RTC::ACTIVE_STATE, RTC::INACTIVE_STATE, "deactivated");
    }
    RTC::ReturnCode_t reset_component(RTC::LightweightRTObject_ptr) override {
        return change(RTC::ERROR_STATE, RTC::INACTIVE_STATE, "reset");
    }
    RTC::LifeCycleState get_component_state(RTC::LightweightRTObject_ptr) override { return state_; }
    RTC::ExecutionKind get_kind() override { return RTC::PERIODIC; }
    RTC::ExecutionContextProfile* get_profile() override { return new RTC::ExecutionContextProfile; }
    /// Into ERROR.
    void fail() { state_ = RTC::ERROR_STATE; }
    /// Executes for long, as one that waits for a person, or no longer.
    void be_busy(bool is_busy) {
        is_busy_ = is_busy;
        const std::lock_guard lock(mutex_);
        follow();
    }

private:
    RTC::ReturnCode_t change(RTC::LifeCycleState from, RTC::LifeCycleState to, const char* said) {
        const std::lock_guard lock(mutex_);
        if (state_ != from) return RTC::PRECONDITION_NOT_MET;
        waiting_ = {to, said};
        return follow() ? RTC::RTC_OK : RTC::RTC_ERROR;
    }
    bool follow() {
        if (!runs_ || is_busy_) return false;
        if (waiting_.second != nullptr) {
            state_ = waiting_.first;
            print(waiting_.second);
        }
        waiting_ = {};
        return true;
    }
    const FakePort& port_;
    std::mutex mutex_;
    std::atomic<RTC::LifeCycleState> state_ = RTC::INACTIVE_STATE;
    std::atomic<bool> runs_ = true, is_busy_ = false;
    std::pair<RTC::LifeCycleState, const char*> waiting_{};
};

/// Two sets of one parameter, and what its widget is. As in OpenRTM-aist a value counts when its set is chosen, or
/// chosen again.
class FakeConfiguration final : public POA_SDOPackage::Configuration {
public:
    SDOPackage::ConfigurationSetList* get_configuration_sets() override {
        const std::lock_guard lock(mutex_);
        auto* list = new SDOPackage::ConfigurationSetList;
        list->length(static_cast<CORBA::ULong>(sets_.size() + 3));
        CORBA::ULong i = 0;
        for (const auto& [name, speed] : sets_) (*list)[i++] = set_of(name, speed);
        for (const auto& [name, text] : {std::pair{"__constraints__", "0<=x<=2"}, std::pair{"__type__", "double"},
                                         std::pair{"__widget__", "slider.0.1"}})
            (*list)[i++] = set_of(name, text);
        return list;
    }
    SDOPackage::ConfigurationSet* get_active_configuration_set() override {
        const std::lock_guard lock(mutex_);
        return new SDOPackage::ConfigurationSet(set_of(active_, sets_[active_]));
    }
    CORBA::Boolean set_configuration_set_values(const SDOPackage::ConfigurationSet& values) override {
        const std::string speed = property(values.configuration_data, "speed");
        const std::lock_guard lock(mutex_);
        if (speed == "-1" || !sets_.contains(values.id.in())) return false;
        sets_[values.id.in()] = speed;
        return true;
    }
    CORBA::Boolean activate_configuration_set(const char* id) override {
        const std::lock_guard lock(mutex_);
        if (!sets_.contains(id)) return false;
        active_ = id;
        print("uses " + active_ + " speed=" + sets_[active_]);
        return true;
    }
    CORBA::Boolean set_device_profile(const SDOPackage::DeviceProfile&) override { return false; }
    CORBA::Boolean add_service_profile(const SDOPackage::ServiceProfile&) override { return false; }
    CORBA::Boolean add_organization(SDOPackage::Organization_ptr) override { return false; }
    CORBA::Boolean remove_service_profile(const char*) override { return false; }
    CORBA::Boolean remove_organization(const char*) override { return false; }
    SDOPackage::ParameterList* get_configuration_parameters() override { return new SDOPackage::ParameterList; }
    SDOPackage::NVList* get_configuration_parameter_values() override { return new SDOPackage::NVList; }
    CORBA::Any* get_configuration_parameter_value(const char*) override { return new CORBA::Any; }
    CORBA::Boolean set_configuration_parameter(const char*, const CORBA::Any&) override { return false; }
    SDOPackage::ConfigurationSet* get_configuration_set(const char*) override {
        return new SDOPackage::ConfigurationSet;
    }
    CORBA::Boolean add_configuration_set(const SDOPackage::ConfigurationSet&) override { return false; }
    CORBA::Boolean remove_configuration_set(const char*) override { return false; }

private:
    static SDOPackage::ConfigurationSet set_of(const std::string& name, const std::string& speed) {
        SDOPackage::ConfigurationSet set;
        set.id = name.c_str();
        set.description = "";
        add_property(set.configuration_data, "speed", speed);
        return set;
    }

    std::mutex mutex_;
    std::map<std::string, std::string> sets_{{"default", "0.5"}, {"fast", "1"}};
    std::string active_ = "default";
};

}  // namespace nezumi::fakes
