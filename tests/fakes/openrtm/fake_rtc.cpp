// An RTC with one data port, as a program of its own: fake_rtc NAMESERVER NAME PORT TYPE in|out. It reads commands, a
// line each, and prints what happens; on the end of its input it leaves the name service.
//   send HEX, fetch, hang SECONDS, fail: goes into ERROR; busy: executes for long, till idle
//   execute RATE [HEX [stamped]]: its in-port reads, its out-port writes; stall: no longer; readback: its buffer does
//   so connect RTC PORT [name=NAME] [id=ID] [last] [PROPERTY=VALUE ...], disconnect: a number of ReturnCode_t race RTC
//   PORT ROUNDS: connects twice at once, so often; in how many rounds not just one came to be boast COUNT: tells who
//   connects so many letters about RTC, ports RTC, state RTC, activate RTC, deactivate RTC, reset RTC, sets RTC, set
//   RTC SET NAME VALUE, use RTC SET link RTC PORT RTC PORT, profiles RTC PORT, unlink RTC PORT: what tools do with
//   connections flood COUNT HEX: sends so often, prints how long it took in all, and one of them
//   start RTC, stop RTC: its execution context
//   names: all of this computer in the name service, as rtls lists them; exit RTC; manager NAME create TEXT | delete
//   INSTANCE | load TEXT | modules | components | profile | shutdown: what rtmgr and RTSystemEditor do
#include <iostream>
#include <string>

#include "tests/fakes/openrtm/fake_commands.hpp"

using namespace nezumi::fakes;

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
