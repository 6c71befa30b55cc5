// What tools and other RTCs do, by raw CORBA calls.
#include "tests/fakes/openrtm/fake_commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace nezumi::fakes {
namespace {

// The whole name, of this computer unless it says another's ("pc.host_cxt/In0").
CosNaming::Name name_of(const std::string& rtc) {
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

RTC::PortService_ptr find_port(RTC::RTObject_ptr rtc, const std::string& wanted) {
    RTC::PortServiceList_var list = rtc->get_ports();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        const RTC::PortProfile_var profile = list[i]->get_port_profile();
        const std::string name = profile->name.in();
        if (name.substr(name.rfind('.') + 1) == wanted) return RTC::PortService::_duplicate(list[i]);
    }
    return RTC::PortService::_nil();
}

// The names of a port's connections; or ends the first.
void of_connections(const std::string& command, RTC::RTObject_ptr rtc, std::istringstream& words) {
    std::string wanted;
    words >> wanted;
    const RTC::PortService_var port = find_port(rtc, wanted);
    RTC::ConnectorProfileList_var all = port->get_connector_profiles();
    if (command == "unlink") return print("unlinked " + std::to_string(port->disconnect(all[0].connector_id)));
    std::string line = "profiles";
    for (CORBA::ULong i = 0; i < all->length(); ++i) line += " " + std::string(all[i].name.in());
    print(line);
}

void ports(RTC::RTObject_ptr rtc) {
    const RTC::ComponentProfile_var profile = rtc->get_component_profile();
    std::string line = "ports " + std::string(profile->instance_name.in());
    for (CORBA::ULong i = 0; i < profile->port_profiles.length(); ++i) {
        const RTC::PortProfile& port = profile->port_profiles[i];
        line += " " + std::string(port.name.in()) + " " + property(port.properties, "port.port_type") + " " +
                property(port.properties, "dataport.data_type");
    }
    print(line);
}

void about(RTC::RTObject_ptr rtc) {
    const RTC::ComponentProfile_var profile = rtc->get_component_profile();
    print("about " + std::string(profile->type_name.in()) + ", " + profile->description.in() + ", " +
          profile->version.in() + ", " + profile->vendor.in() + ", " + profile->category.in() + ", " +
          property(profile->properties, "naming.names"));
}

void sets(RTC::RTObject_ptr rtc) {
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

void configure(const std::string& command, RTC::RTObject_ptr rtc, std::istringstream& words) {
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

}  // namespace

Commands::Commands(CORBA::ORB_ptr orb, const std::string& nameserver, FakePort& port, FakeRtc& self)
    : port_(port), self_(self) {
    const CORBA::Object_var object = orb->string_to_object(("corbaloc:iiop:" + nameserver + "/NameService").c_str());
    root_ = CosNaming::NamingContext::_narrow(object);
}

void Commands::bind(const std::string& rtc, CORBA::Object_ptr object) {
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

void Commands::unbind(const std::string& rtc) { root_->unbind(name_of(rtc)); }

void Commands::run(const std::string& line) {
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
    } else if (command == "busy" || command == "idle") {
        self_.be_busy(command == "busy");
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

RTC::RTObject_ptr Commands::find(const std::string& rtc) {
    const CORBA::Object_var object = root_->resolve(name_of(rtc));
    return RTC::RTObject::_narrow(object);
}

void Commands::list_names() {
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

void Commands::of_manager(std::istringstream& words) {
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

void Commands::flood(int count, const Bytes& bytes) {
    std::vector<double> times = port_.time_sends(count, bytes);
    const double all = std::accumulate(times.begin(), times.end(), 0.0);
    std::sort(times.begin(), times.end());
    const auto microseconds = [&](std::size_t percent) { return times[times.size() * percent / 100] * 1e6; };
    print("lasted " + std::to_string(all) + " s, p50 " + std::to_string(microseconds(50)) + " us, p99 " +
          std::to_string(microseconds(99)) + " us");
}

void Commands::of_rtc(const std::string& command, RTC::RTObject_ptr found, std::istringstream& words) {
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
    if (command == "start") print("done " + std::to_string(context->start()));
    if (command == "stop") print("done " + std::to_string(context->stop()));
}

void Commands::connect(RTC::RTObject_ptr rtc, std::istringstream& words) {
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

void Commands::race(RTC::RTObject_ptr rtc, std::istringstream& words) {
    std::string wanted;
    int rounds = 0;
    words >> wanted >> rounds;
    const RTC::PortService_var port = find_port(rtc, wanted);
    int wrong = 0;
    for (int i = 0; i < rounds; ++i) wrong += port_.connect_at_once(port) == 1 ? 0 : 1;
    print("wrong " + std::to_string(wrong));
}

void Commands::link(RTC::RTObject_ptr rtc, std::istringstream& words) {
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

}  // namespace nezumi::fakes
