// RTCs in a CORBA name service, as OpenRTM-aist has them: "pc.host_cxt/ConsoleOut0.rtc".
#pragma once

#include <omniORB4/CORBA.h>
#include <omniORB4/Naming.hh>

#include <string>
#include <string_view>
#include <vector>

#include <rtm.hh>
#include "engine/base/error.hpp"

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
    /// An RTC as it is bound, which may be stale.
    struct Named {
        std::string name{};  ///< "pc.host_cxt/ConsoleOut0"
        RTC::RTObject_var rtc{};
    };
    /// The RTC of a name, with its contexts or without: "pc.host_cxt/ConsoleOut0", "ConsoleOut0". The error says that
    /// there is none, or that it could be one of several.
    Expected<Named> find(const std::string& component);
    /// All RTCs, in the order of the name service: a thousand at most.
    std::vector<Named> all();

private:
    void collect(CosNaming::NamingContext_ptr context, const std::string& path, int depth, std::vector<Named>& found);
    CosNaming::NamingContext_ptr root();
    std::vector<CosNaming::NameComponent> contexts();
    CORBA::Object_ptr resolve(CosNaming::NamingContext_ptr from, const CosNaming::Name& name);

    CORBA::ORB_var orb_;
    const std::string address_;
    std::string own_context_;
    CosNaming::NamingContext_var root_;
};

}  // namespace nezumi::openrtm
