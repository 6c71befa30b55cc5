// The commands of the program that is an RTC: fake_rtc.cpp lists them.
#pragma once

#include <omniORB4/Naming.hh>

#include <sstream>
#include <string>

#include "tests/fakes/openrtm/fake_component.hpp"

namespace nezumi::fakes {

class Commands {
public:
    Commands(CORBA::ORB_ptr orb, const std::string& nameserver, FakePort& port, FakeRtc& self);

    void bind(const std::string& rtc, CORBA::Object_ptr object);
    void unbind(const std::string& rtc);
    /// Does what a line says, and prints what came of it.
    void run(const std::string& line);

private:
    RTC::RTObject_ptr find(const std::string& rtc);
    void list_names();
    void of_manager(std::istringstream& words);
    void flood(int count, const Bytes& bytes);
    void of_rtc(const std::string& command, RTC::RTObject_ptr found, std::istringstream& words);
    void connect(RTC::RTObject_ptr rtc, std::istringstream& words);
    void race(RTC::RTObject_ptr rtc, std::istringstream& words);
    void link(RTC::RTObject_ptr rtc, std::istringstream& words);

    FakePort& port_;
    FakeRtc& self_;
    CosNaming::NamingContext_var root_;
};

}  // namespace nezumi::fakes
