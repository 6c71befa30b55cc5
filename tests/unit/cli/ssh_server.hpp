// An ssh server of its own on the loopback, which stands for a robot, and a project that is pushed to it.
#pragma once

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
#include <vector>

#include "engine/base/whole_file.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

namespace nezumi {

inline sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
}

inline int free_push_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    close(socket);
    return ntohs(address.sin_port);
}

inline bool is_open(int port) {
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
        if (access("/usr/sbin/sshd", X_OK) != 0) throw std::runtime_error("SKIPPED: openssh-server is not installed");
        if (geteuid() == 0) mkdir("/run/sshd", 0755);  // where sshd wants to put its own, as root
        chmod(folder.path("").c_str(), 0700);
        const std::string base = folder.path("").string();
        const std::string make = "ssh-keygen -q -t ed25519 -N '' -f " + base;
        REQUIRE(std::system((make + "host_key && " + make + "user_key && cp " + base + "user_key.pub " + base +
                             "authorized && chmod 600 " + base + "authorized")
                                .c_str()) == 0);
        std::filesystem::create_directory(folder.path("home"));
        const std::string bin = std::filesystem::path(nezumi_program()).parent_path().string();
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

    /// A program of the robot that stands before the real one.
    void write_program(const std::string& name, const std::string& script) const {
        const std::string file = "bin/" + name;
        folder.write(file, "#!/bin/sh\n" + script);
        std::filesystem::permissions(folder.path(file), std::filesystem::perms::owner_all);
    }
    /// The robot's nezumi, where its first word is `receive`, is run by these words of a shell.
    void receive_by(const std::string& words) const {
        write_program("nezumi", "[ \"$1\" = receive ] || exec " + nezumi_program() + " \"$@\"\n" + words);
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

}  // namespace nezumi
