// RTCs in a CORBA name service, as OpenRTM-aist has them: "pc.host_cxt/ConsoleOut0.rtc".
#pragma once

#include <omniORB4/CORBA.h>
#include <omniORB4/Naming.hh>

#include <string>
#include <string_view>
#include <vector>

#include <rtm.hh>

namespace nezumi::openrtm {

class NameService {
public:
    /// `address`: "HOST:PORT". Nothing is asked for yet.
    NameService(CORBA::ORB_ptr orb, std::string address);

    const std::string& address() const { return address_; }
    /// "pc.host_cxt": the context of this computer.
    const std::string& own_context() const { return own_context_; }

    /// What is bound under a name in this computer's context.
    enum class Bound { nothing, ours, other, stale };
    // These may wait for a second or two, and throw CORBA's exceptions: nobody answers there.
    Bound bound(const std::string& name, CORBA::Object_ptr ours);
    /// Takes the name, whoever has it.
    void rebind(const std::string& name, CORBA::Object_ptr object);
    /// Gives the name up, if it is bound to this.
    void unbind(const std::string& name, CORBA::Object_ptr object);
    /// The RTC of a name, with its contexts or without: "pc.host_cxt/ConsoleOut0", "ConsoleOut0". Nil where there is
    /// none; what is bound may be stale.
    RTC::RTObject_ptr find(const std::string& component);

private:
    CosNaming::NamingContext_ptr root();
    CORBA::Object_ptr resolve(CosNaming::NamingContext_ptr from, const CosNaming::Name& name);

    CORBA::ORB_var orb_;
    const std::string address_;
    std::string own_context_;
    CosNaming::NamingContext_var root_;
};

}  // namespace nezumi::openrtm
