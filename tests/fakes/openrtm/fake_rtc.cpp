// An RTC with one data port, as a program of its own: fake_rtc NAMESERVER NAME PORT TYPE in|out. It reads commands, a
// line each, and prints what happens; on the end of its input it leaves the name service.
//   send HEX, fetch, hang SECONDS, fail: goes into ERROR
//   execute RATE [HEX [stamped]]: its in-port reads, its out-port writes; stall: no longer; readback: its buffer does
//   so connect RTC PORT [name=NAME] [id=ID] [last] [PROPERTY=VALUE ...], disconnect: a number of ReturnCode_t race RTC
//   PORT ROUNDS: connects twice at once, so often; in how many rounds not just one came to be boast COUNT: tells who
//   connects so many letters about RTC, ports RTC, state RTC, activate RTC, deactivate RTC, reset RTC, sets RTC, set
//   RTC SET NAME VALUE, use RTC SET link RTC PORT RTC PORT, profiles RTC PORT, unlink RTC PORT: what tools do with
//   connections flood COUNT HEX: sends so often, prints how long it took in all, and one of them
//   names: all of this computer in the name service, as rtls lists them; exit RTC; manager NAME create TEXT | delete
//   INSTANCE | load TEXT | modules | components | profile | shutdown: what rtmgr and RTSystemEditor do
#include <omniORB4/Naming.hh>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fakes/openrtm/fake_port.hpp"
#include "tests/fakes/openrtm/fake_state.hpp"

using namespace nezumi::fakes;

namespace {

// As much of an RTC as others ask of it.
class FakeRtc final : public POA_OpenRTM::DataFlowComponent {
public:
    FakeRtc(std::string name, RTC::PortService_ptr reference, const FakePort& port)
        : name_(std::move(name)), port_(reference), context_(new FakeContext(port)) {}
    void fail() { context_->fail(); }

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

class Commands {
public:
    Commands(CORBA::ORB_ptr orb, const std::string& nameserver, FakePort& port, FakeRtc& self)
        : port_(port), self_(self) {
        const CORBA::Object_var object =
            orb->string_to_object(("corbaloc:iiop:" + nameserver + "/NameService").c_str());
        root_ = CosNaming::NamingContext::_narrow(object);
    }

    // The whole name, of this computer unless it says another's ("pc.host_cxt/In0").
    static CosNaming::Name name_of(const std::string& rtc) {
        std::array<char, 256> own{};
        gethostname(own.data(), own.size() - 1);
        const std::size_t slash = rtc.find('/');
        const std::string host = slash == std::string::npos ? own.data() : rtc.substr(0, rtc.find('.'));
        CosNaming::Name name;
        name.length(2);
        name[0].id = host.c_str();
        name[0].kind = "host_cxt";
        name[1].id = rtc.substr(slash == std::string::npos ? 0 : slash + 1).c_str();
        name[1].kind = "rtc";
        return name;
    }
    void bind(const std::string& rtc, CORBA::Object_ptr object) {
        CosNaming::Name context = name_of(rtc);
        context.length(1);
        try {
            const CosNaming::NamingContext_var made = root_->bind_new_context(context);
        } catch (const CosNaming::NamingContext::AlreadyBound&) {
            root_->rebind(name_of(rtc), object);
            return;
        }
        root_->rebind(name_of(rtc), object);
    }
    void unbind(const std::string& rtc) { root_->unbind(name_of(rtc)); }

    void run(const std::string& line) {
        std::istringstream words(line);
        std::string command, rtc;
        words >> command;
        if (command == "send") {
            std::string hex;
            words >> hex;
            port_.send(from_hex(hex));
        } else if (command == "flood") {
            int count = 0;
            std::string hex;
            words >> count >> hex;
            flood(count, from_hex(hex));
        } else if (command == "fetch") {
            port_.fetch();
        } else if (command == "hang") {
            double seconds = 0;
            words >> seconds;
            port_.hang(seconds);
        } else if (command == "execute") {
            double rate = 0;
            std::string hex, stamped;
            words >> rate >> hex >> stamped;
            port_.execute(rate, from_hex(hex), stamped == "stamped");
        } else if (command == "stall") {
            port_.stall();
        } else if (command == "readback") {
            port_.read_back();
        } else if (command == "boast") {
            std::size_t count = 0;
            words >> count;
            port_.boast(count);
        } else if (command == "fail") {
            self_.fail();
        } else if (command == "names") {
            list_names();
        } else if (command == "manager") {
            of_manager(words);
        } else if (command == "disconnect") {
            print("disconnected " + std::to_string(port_.disconnect_first()));
        } else if (words >> rtc) {
            of_rtc(command, find(rtc), words);
        }
    }

private:
    RTC::RTObject_ptr find(const std::string& rtc) {
        const CORBA::Object_var object = root_->resolve(name_of(rtc));
        return RTC::RTObject::_narrow(object);
    }
    void list_names() {
        CosNaming::Name name = name_of("");
        name.length(1);
        const CORBA::Object_var object = root_->resolve(name);
        const CosNaming::NamingContext_var context = CosNaming::NamingContext::_narrow(object);
        CosNaming::BindingList_var list;
        CosNaming::BindingIterator_var more;
        context->list(100, list.out(), more.out());
        std::vector<std::string> names;
        for (CORBA::ULong i = 0; i < list->length(); ++i)
            names.push_back(list[i].binding_name[0].id.in() + std::string(".") + list[i].binding_name[0].kind.in());
        std::sort(names.begin(), names.end());
        std::string line = "names";
        for (const std::string& each : names) line += " " + each;
        print(line);
    }
    void of_manager(std::istringstream& words) {
        std::string instance, command, text;
        words >> instance >> command >> text;
        CosNaming::Name name = name_of(instance);
        name[1].kind = "mgr";
        const CORBA::Object_var object = root_->resolve(name);
        const RTM::Manager_var manager = RTM::Manager::_narrow(object);
        if (CORBA::is_nil(manager)) return print("no manager");
        if (command == "create") {
            const RTC::RTObject_var made = manager->create_component(text.c_str());
            if (CORBA::is_nil(made)) return print("created nothing");
            const RTC::ComponentProfile_var profile = made->get_component_profile();
            print("created " + std::string(profile->instance_name.in()));
        } else if (command == "delete") {
            print("deleted " + std::to_string(manager->delete_component(text.c_str())));
        } else if (command == "load") {
            print("loaded " + std::to_string(manager->load_module(text.c_str(), "init")));
        } else if (command == "modules") {
            RTM::ModuleProfileList_var list = manager->get_factory_profiles();
            const RTM::ModuleProfileList_var loaded = manager->get_loaded_modules();
            const RTM::ModuleProfileList_var loadable = manager->get_loadable_modules();
            std::string line = "modules";
            if (loaded->length() != list->length() || loadable->length() != list->length()) line += " differ";
            for (CORBA::ULong i = 0; i < list->length(); ++i)
                line += " " + property(list[i].properties, "implementation_id");
            print(line + " ");
        } else if (command == "components") {
            RTC::ComponentProfileList_var list = manager->get_component_profiles();
            const RTC::RTCList_var all = manager->get_components();
            std::string line = "components " + std::to_string(all->length());
            for (CORBA::ULong i = 0; i < list->length(); ++i) line += " " + std::string(list[i].instance_name.in());
            print(line);
        } else if (command == "profile") {
            const RTM::ManagerProfile_var profile = manager->get_profile();
            const SDOPackage::NVList_var configuration = manager->get_configuration();
            print("profile " + property(profile->properties, "instance_name") + " " +
                  property(configuration, "manager.language") + (manager->is_master() ? " master" : ""));
        } else if (command == "shutdown") {
            print("shut down " + std::to_string(manager->shutdown()));
        }
    }
    void flood(int count, const Bytes& bytes) {
        std::vector<double> times = port_.time_sends(count, bytes);
        const double all = std::accumulate(times.begin(), times.end(), 0.0);
        std::sort(times.begin(), times.end());
        const auto microseconds = [&](std::size_t percent) { return times[times.size() * percent / 100] * 1e6; };
        print("lasted " + std::to_string(all) + " s, p50 " + std::to_string(microseconds(50)) + " us, p99 " +
              std::to_string(microseconds(99)) + " us");
    }
    void of_rtc(const std::string& command, RTC::RTObject_ptr found, std::istringstream& words) {
        const RTC::RTObject_var rtc = found;
        if (command == "connect") return connect(rtc, words);
        if (command == "race") return race(rtc, words);
        if (command == "link") return link(rtc, words);
        if (command == "profiles" || command == "unlink") return of_connections(command, rtc, words);
        if (command == "exit") return print("exited " + std::to_string(rtc->exit()));
        if (command == "ports") return ports(rtc);
        if (command == "about") return about(rtc);
        if (command == "sets") return sets(rtc);
        if (command == "set" || command == "use") return configure(command, rtc, words);
        RTC::ExecutionContextList_var contexts = rtc->get_owned_contexts();
        const RTC::ExecutionContext_var context = RTC::ExecutionContext::_duplicate(contexts[0]);
        if (command == "state") print("state " + std::to_string(context->get_component_state(rtc)));
        if (command == "activate") print("done " + std::to_string(context->activate_component(rtc)));
        if (command == "deactivate") print("done " + std::to_string(context->deactivate_component(rtc)));
        if (command == "reset") print("done " + std::to_string(context->reset_component(rtc)));
    }
    void connect(RTC::RTObject_ptr rtc, std::istringstream& words) {
        std::string wanted, word;
        words >> wanted;
        RTC::ConnectorProfile told;
        told.name = "made by the fake";
        told.connector_id = "";
        bool is_last = false;
        while (words >> word) {
            if (word == "last") {
                is_last = true;
                continue;
            }
            const std::size_t equals = word.find('=');
            const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
            if (name == "name") {
                told.name = value.c_str();
            } else if (name == "id") {
                told.connector_id = value.c_str();
            } else {
                add_property(told.properties, "dataport." + name, value);
            }
        }
        const RTC::PortService_var port = find_port(rtc, wanted);
        if (CORBA::is_nil(port)) return print("connected to nobody");
        print("connected " + std::to_string(port_.connect_to(port, told, is_last)));
    }
    void race(RTC::RTObject_ptr rtc, std::istringstream& words) {
        std::string wanted;
        int rounds = 0;
        words >> wanted >> rounds;
        const RTC::PortService_var port = find_port(rtc, wanted);
        int wrong = 0;
        for (int i = 0; i < rounds; ++i) wrong += port_.connect_at_once(port) == 1 ? 0 : 1;
        print("wrong " + std::to_string(wrong));
    }
    void link(RTC::RTObject_ptr rtc, std::istringstream& words) {
        std::string port, other_rtc, other;
        words >> port >> other_rtc >> other;
        const RTC::RTObject_var there = find(other_rtc);
        RTC::ConnectorProfile profile;
        profile.name = "made by a tool";
        profile.connector_id = "";
        profile.ports.length(2);
        profile.ports[0] = find_port(rtc, port);
        profile.ports[1] = find_port(there, other);
        add_property(profile.properties, "dataport.dataflow_type", "push");
        print("linked " + std::to_string(profile.ports[0]->connect(profile)));
    }
    // The names of a port's connections; or ends the first.
    static void of_connections(const std::string& command, RTC::RTObject_ptr rtc, std::istringstream& words) {
        std::string wanted;
        words >> wanted;
        const RTC::PortService_var port = find_port(rtc, wanted);
        RTC::ConnectorProfileList_var all = port->get_connector_profiles();
        if (command == "unlink") return print("unlinked " + std::to_string(port->disconnect(all[0].connector_id)));
        std::string line = "profiles";
        for (CORBA::ULong i = 0; i < all->length(); ++i) line += " " + std::string(all[i].name.in());
        print(line);
    }
    static RTC::PortService_ptr find_port(RTC::RTObject_ptr rtc, const std::string& wanted) {
        RTC::PortServiceList_var list = rtc->get_ports();
        for (CORBA::ULong i = 0; i < list->length(); ++i) {
            const RTC::PortProfile_var profile = list[i]->get_port_profile();
            const std::string name = profile->name.in();
            if (name.substr(name.rfind('.') + 1) == wanted) return RTC::PortService::_duplicate(list[i]);
        }
        return RTC::PortService::_nil();
    }
    static void ports(RTC::RTObject_ptr rtc) {
        const RTC::ComponentProfile_var profile = rtc->get_component_profile();
        std::string line = "ports " + std::string(profile->instance_name.in());
        for (CORBA::ULong i = 0; i < profile->port_profiles.length(); ++i) {
            const RTC::PortProfile& port = profile->port_profiles[i];
            line += " " + std::string(port.name.in()) + " " + property(port.properties, "port.port_type") + " " +
                    property(port.properties, "dataport.data_type");
        }
        print(line);
    }
    static void about(RTC::RTObject_ptr rtc) {
        const RTC::ComponentProfile_var profile = rtc->get_component_profile();
        print("about " + std::string(profile->type_name.in()) + ", " + profile->description.in() + ", " +
              profile->version.in() + ", " + profile->vendor.in() + ", " + profile->category.in() + ", " +
              property(profile->properties, "naming.names"));
    }
    static void sets(RTC::RTObject_ptr rtc) {
        const SDOPackage::Configuration_var configuration = rtc->get_configuration();
        const SDOPackage::ConfigurationSet_var active = configuration->get_active_configuration_set();
        std::string line = "sets " + std::string(active->id.in());
        SDOPackage::ConfigurationSetList_var list = configuration->get_configuration_sets();
        for (CORBA::ULong i = 0; i < list->length(); ++i) {
            line += " | " + std::string(list[i].id.in());
            const SDOPackage::NVList& values = list[i].configuration_data;
            for (CORBA::ULong j = 0; j < values.length(); ++j)
                line += " " + std::string(values[j].name.in()) + "=" + property(values, values[j].name.in());
        }
        print(line);
    }
    static void configure(const std::string& command, RTC::RTObject_ptr rtc, std::istringstream& words) {
        const SDOPackage::Configuration_var configuration = rtc->get_configuration();
        std::string set, name, value;
        words >> set >> name >> value;
        try {
            if (command == "use")
                return print("done " + std::to_string(configuration->activate_configuration_set(set.c_str())));
            SDOPackage::ConfigurationSet values;
            values.id = set.c_str();
            values.description = "";
            add_property(values.configuration_data, name, value);
            print("done " + std::to_string(configuration->set_configuration_set_values(values)));
        } catch (const SDOPackage::InvalidParameter& error) {
            print("invalid " + std::string(error.description.in()));
        }
    }

    FakePort& port_;
    FakeRtc& self_;
    CosNaming::NamingContext_var root_;
};

}  // namespace

int main(int count, char** arguments) {
    if (count != 6) {
        std::cerr << "fake_rtc NAMESERVER NAME PORT TYPE in|out\n";
        return 2;
    }
    const std::string nameserver = arguments[1], name = arguments[2], port_name = arguments[3];
    try {
        int none = 0;
        const char* settings[][2] = {
            {"clientCallTimeOutPeriod", "3000"}, {"endPoint", "giop:tcp:127.0.0.1:"}, {nullptr, nullptr}};
        const CORBA::ORB_var orb = CORBA::ORB_init(none, nullptr, "omniORB4", settings);
        const CORBA::Object_var root = orb->resolve_initial_references("RootPOA");
        const PortableServer::POA_var poa = PortableServer::POA::_narrow(root);
        const PortableServer::POAManager_var manager = poa->the_POAManager();
        manager->activate();

        auto* port = new FakePort(orb, name + "." + port_name, arguments[4], std::string(arguments[5]) == "in");
        const RTC::PortService_var port_reference = port->_this();
        auto* rtc = new FakeRtc(name, port_reference, *port);
        const OpenRTM::DataFlowComponent_var reference = rtc->_this();
        port->set_owner(reference);
        Commands commands(orb, nameserver, *port, *rtc);
        commands.bind(name, reference);
        print("ready");
        std::string line;
        while (std::getline(std::cin, line)) {
            try {
                commands.run(line);
            } catch (const CORBA::Exception& error) {
                print(std::string("failed ") + error._name());
            }
        }
        commands.unbind(name);
    } catch (const CORBA::Exception& error) {
        std::cerr << "fake_rtc: " << error._name() << "\n";
        return 1;
    }
    std::_Exit(0);
}
