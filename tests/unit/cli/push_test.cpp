// `nezumi push` and `nezumi attach ssh:`, tried with a server of its own on the loopback.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

#include "engine/base/whole_file.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
}

int free_push_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    close(socket);
    return ntohs(address.sin_port);
}

bool is_open(int port) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = loopback(port);
    const bool open = connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(socket);
    return open;
}

// An ssh server with keys of its own, which stands for the robot "mouse"; where there is none, the test is skipped.
class SshServer {
public:
    SshServer() {
        if (access("/usr/sbin/sshd", X_OK) != 0 || access("/usr/bin/rsync", X_OK) != 0)
            throw std::runtime_error("SKIPPED: openssh-server or rsync is not installed");
        if (geteuid() == 0) mkdir("/run/sshd", 0755);  // where sshd wants to put its own, as root
        chmod(folder.path("").c_str(), 0700);
        const std::string base = folder.path("").string();
        const std::string make = "ssh-keygen -q -t ed25519 -N '' -f " + base;
        REQUIRE(std::system((make + "host_key && " + make + "user_key && cp " + base + "user_key.pub " + base +
                             "authorized && chmod 600 " + base + "authorized")
                                .c_str()) == 0);
        fs::create_directory(folder.path("home"));
        const std::string bin = fs::path(nezumi_program()).parent_path().string();
        const int port = free_push_port();
        folder.write("sshd_config", "ListenAddress 127.0.0.1:" + std::to_string(port) + "\nHostKey " + base +
                                        "host_key\nAuthorizedKeysFile " + base +
                                        "authorized\nPidFile none\nUsePAM no\nStrictModes no\nPermitRootLogin yes\n"
                                        "PasswordAuthentication no\nSetEnv PATH=" +
                                        base + "bin:" + bin + ":/usr/bin:/bin\nForceCommand cd " + base +
                                        "home && eval \"$SSH_ORIGINAL_COMMAND\"\n");
        folder.write("config", "Host mouse\n  HostName 127.0.0.1\n  Port " + std::to_string(port) +
                                   "\n  IdentityFile " + base +
                                   "user_key\n  IdentitiesOnly yes\n  StrictHostKeyChecking no\n  LogLevel ERROR\n"
                                   "  UserKnownHostsFile " +
                                   base + "known_hosts\n");
        server_ = fork();
        if (server_ == 0) {
            const std::string config = base + "sshd_config", log = base + "sshd.log";
            execl("/usr/sbin/sshd", "/usr/sbin/sshd", "-D", "-f", config.c_str(), "-E", log.c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 500 && !is_open(port); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        REQUIRE(is_open(port));
    }
    ~SshServer() {
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
    }
    SshServer(const SshServer&) = delete;
    SshServer& operator=(const SshServer&) = delete;

    std::string config() const { return folder.path("config").string(); }
    std::string there(const std::string& file) const {
        return read_whole(folder.path("home/" + file), file).value_or("not there");
    }

    Scratch folder;

private:
    pid_t server_ = 0;
};

struct PushedProject {
    PushedProject() {
        folder.write("robots/behaviors/drive.lua", "-- first\n");
        folder.write("robots/behaviors/systems/one.lua", "robot 'mouse' { model = 'raspimouse' }\n");
        folder.write("robots/.git/config", "private");
    }
    Outcome push(const SshServer& server, std::vector<std::string> more = {}) const {
        std::vector<std::string> words{"push", "mouse", "--ssh-config", server.config()};
        words.insert(words.end(), more.begin(), more.end());
        return run_nezumi(words, folder.path("robots/behaviors").string());
    }
    Scratch folder;
};

}  // namespace

TEST_CASE("a project comes over, with what has changed and what has gone, and the robot's calibration stays",
          "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    const Outcome first = project.push(server);
    CAPTURE(first.error);
    REQUIRE(first.status == 0);
    CHECK(first.out == "robots is on mouse in robots\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "-- first\n");
    CHECK(server.there("robots/.git/config") == "not there");

    server.folder.write("home/robots/behaviors/systems/mouse.calibration.lua", "its own");
    project.folder.write("robots/behaviors/drive.lua", "-- second\n");
    fs::remove(project.folder.path("robots/behaviors/systems/one.lua"));
    CHECK(project.push(server).status == 0);
    CHECK(server.there("robots/behaviors/drive.lua") == "-- second\n");
    CHECK(server.there("robots/behaviors/systems/one.lua") == "not there");
    CHECK(server.there("robots/behaviors/systems/mouse.calibration.lua") == "its own");
}

TEST_CASE("a project that can't come over whole leaves the robot as it was", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    REQUIRE(project.push(server).status == 0);
    project.folder.write("robots/behaviors/drive.lua", "-- second\n");
    // The connection breaks in the middle: there, rsync ends before it has taken everything.
    server.folder.write("bin/rsync", "#!/bin/sh\nexit 12\n");
    fs::permissions(server.folder.path("bin/rsync"), fs::perms::owner_all);
    const Outcome broken = project.push(server);
    CHECK(broken.status == 2);
    CHECK(broken.error.find("nezumi: the project did not come over (rsync ended with 12): mouse is as it was\n") !=
          std::string::npos);
    CHECK(server.there("robots/behaviors/drive.lua") == "-- first\n");
}

TEST_CASE("a robot with another version of nezumi, or none, gets nothing", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    server.folder.write("bin/nezumi", "#!/bin/sh\necho nezumi 9.9.9\n");
    fs::permissions(server.folder.path("bin/nezumi"), fs::perms::owner_all);
    const Outcome other = project.push(server);
    CHECK(other.status == 2);
    CHECK(other.error.starts_with("nezumi: mouse has nezumi 9.9.9, here is nezumi "));
    CHECK(other.error.ends_with(": install the same on both\n"));
    server.folder.write("bin/nezumi", "#!/bin/sh\nexit 127\n");
    CHECK(project.push(server).error == "nezumi: mouse has no nezumi: install its package there\n");
    CHECK(server.there("robots/behaviors/drive.lua") == "not there");
}

TEST_CASE("a file of the project is run there by its real robots, and its status is ours", "[cli][push]") {
    const SshServer server;
    const PushedProject project;
    const std::string version = run_nezumi({"--version"}).out;
    server.folder.write("bin/nezumi", "#!/bin/sh\n[ \"$1\" = --version ] && exec echo '" +
                                          version.substr(0, version.find('\n')) + "'\npwd; echo \"$@\"; exit 1\n");
    fs::permissions(server.folder.path("bin/nezumi"), fs::perms::owner_all);
    const Outcome ran = project.push(server, {"--run", "behaviors/systems/one.lua", "--to", "a place"});
    CHECK(ran.status == 1);
    CHECK(ran.out == "robots is on mouse in a place\n" + fs::canonical(server.folder.path("home/a place")).string() +
                         "\nrun behaviors/systems/one.lua --hw\n");
}

TEST_CASE("what runs there behaves anew as soon as a project is pushed, and keeps its state",
          "[cli][push][wallclock]") {
    const SshServer server;
    const PushedProject project;
    const auto script = [](const std::string& says) {
        return "state.ticks = state.ticks or 0\n"
               "function on_execute() state.ticks = state.ticks + 1\n"
               "  if state.ticks % 20 == 0 then print('" +
               says + " ' .. (state.ticks > 60 and 'late' or 'early')) end\nend\n";
    };
    project.folder.write("robots/behaviors/drive.lua", script("first"));
    project.folder.write("robots/behaviors/systems/one.lua", "behavior 'driver' { script = 'drive' }\n");
    REQUIRE(project.push(server).status == 0);
    Program robot({"run", "behaviors/systems/one.lua"}, server.folder.path("home/robots").string());
    REQUIRE(robot.wait_for_error("first late"));

    project.folder.write("robots/behaviors/drive.lua", script("second"));
    REQUIRE(project.push(server).status == 0);
    const auto pushed = std::chrono::steady_clock::now();
    REQUIRE(robot.wait_for_error("second "));
    CHECK(std::chrono::steady_clock::now() - pushed < std::chrono::seconds(2));
    CHECK(robot.error.find("second early") == std::string::npos);  // its state is kept

    project.folder.write("robots/behaviors/drive.lua", "function on_execute( end");
    REQUIRE(project.push(server).status == 0);
    REQUIRE(robot.wait_for_error("drive.lua:1: "));  // and goes on with the version before
    robot.error.clear();
    CHECK(robot.wait_for_error("second late"));
}

TEST_CASE("the console of a robot is reached by ssh", "[cli][push]") {
    const SshServer server;
    server.folder.write("bin/nezumi", "#!/bin/sh\nfor word in \"$@\"; do echo \"[$word]\"; done\nexit 1\n");
    fs::permissions(server.folder.path("bin/nezumi"), fs::perms::owner_all);
    const Outcome outcome = run_nezumi(
        {"attach", "ssh:mouse/stop_at_wall", "--ssh-config", server.config(), "--eval", "print('it''s; $HOME')"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out == "[attach]\n[stop_at_wall]\n[--eval]\n[print('it''s; $HOME')]\n");
    fs::remove(server.folder.path("bin/nezumi"));
    const Outcome listed = run_nezumi({"attach", "ssh:mouse", "--ssh-config", server.config(), "--list"});
    CHECK((listed.status == 0 || listed.error.find("nothing is running") != std::string::npos));
}

TEST_CASE("a host that is none is told in one line", "[cli][push]") {
    const Scratch nothing;
    CHECK(run_nezumi({"push", "pi@mouse"}, nothing.path("").string()).error ==
          "nezumi: no project is here: expected a folder with behaviors/ in it, or above\n");
    CHECK(run_nezumi({"attach", "ssh:-oProxyCommand=x"}).error ==
          "nezumi: expected a user and a host as in pi@mouse, got '-oProxyCommand=x'\n");
    CHECK(run_nezumi({"push", "pi mouse"}).error ==
          "nezumi: expected a user and a host as in pi@mouse, got 'pi mouse'\n");
}
