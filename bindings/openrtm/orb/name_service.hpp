// RTCs in a CORBA name service, in OpenRTM-aist's form: "pc.host_cxt/ConsoleOut0.rtc".
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
    /// `address`: "HOST:PORT". Makes no call yet.
    NameService(CORBA::ORB_ptr orb, std::string address);

    const std::string& address() const { return address_; }
    /// "pc.host_cxt": the context of this computer.
    const std::string& own_context() const { return own_context_; }

    /// The kind of object that is bound to a name in this computer's context. `stale`: it does not answer.
    enum class Bound { nothing, ours, other, stale };
    // The following functions may wait for two seconds. Without an answer they throw CORBA's exceptions.
    Bound bound(const std::string& name, CORBA::Object_ptr ours);
    /// Binds the name, replacing another object.
    void rebind(const std::string& name, CORBA::Object_ptr object);
    /// Unbinds the name if it is bound to this object.
    void unbind(const std::string& name, CORBA::Object_ptr object);
    /// A name and its RTC, which may be gone.
    struct Named {
        std::string name{};  ///< "pc.host_cxt/ConsoleOut0"
        RTC::RTObject_var rtc{};
    };
    /// Finds the RTC of a name, with or without its contexts: "pc.host_cxt/ConsoleOut0", "ConsoleOut0". Fails if there
    /// is none or more than one.
    Expected<Named> find(const std::string& component);
    /// Unbinds a name of any computer if it is bound to this object.
    void unbind_whole(const Named& named);
    /// All RTCs in the order of the name service, at most a thousand.
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
