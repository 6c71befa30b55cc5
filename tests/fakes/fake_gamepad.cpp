// A gamepad without the gamepad: event devices in input/.
#include <sstream>
#include <string>

#include "tests/fakes/fake_robot.hpp"
#include "tests/fakes/gamepad_nodes.hpp"

using namespace nezumi;

namespace {

std::string answer(const std::string& line, fakes::GamepadNodes& nodes) {
    std::istringstream words(line);
    std::string command, name;
    int value = 0;
    words >> command >> name >> value;
    if (command == "set") return nodes.set(name, value) ? "" : "no such axis or button";
    if (command == "unseen") return nodes.set_unseen(name, value) ? "" : "no such axis or button";
    if (command == "fault") return nodes.set_fault(name) ? "" : "no such fault";
    if (command == "heal") {
        nodes.set_fault("none");
    } else if (command == "unplug") {
        nodes.unplug();
    } else if (command == "plug") {
        nodes.plug_in();
    } else {
        return "unknown command";
    }
    return "";
}

}  // namespace

int main(int count, char** words) {
    fakes::GamepadNodes nodes;
    return fakes::be_fake_device(count, words, nodes, [&](const std::string& line) { return answer(line, nodes); });
}
