// `nezumi network`: lists the hosts of a domain and makes their shared secret.
#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/domain_list.hpp"
#include "bindings/dds/domain_xml.hpp"
#include "bindings/dds/host_table.hpp"
#include "bindings/dds/sealed_transport.hpp"
#include "bindings/dds/user_secret.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

struct ListOptions {
    std::uint64_t domain = 0;
    std::string interface;
    std::vector<std::string> peers;
    std::string secret;  // a file; "": none
    double seconds = 3;  // hosts announce themselves about once per second
};

// The secret of the hosts to list. Default on the loopback: this user's secret, if there is one.
std::optional<Expected<dds::Secret>> secret_for(const ListOptions& options) {
    if (!options.secret.empty()) return dds::read_secret(options.secret, options.secret);
    const auto own = dds::user_secret_file();
    std::error_code none;
    if (options.interface.empty() && std::filesystem::exists(own, none)) return dds::user_secret(own);
    return std::nullopt;
}

int list_network(const ListOptions& options) {
    constexpr std::uint64_t last_domain = 232;
    if (options.domain > last_domain)
        return refuse(fmt::format("network list: --domain: expected 0 to {}, got {}", last_domain, options.domain));
    auto place = dds::open_cyclone({.domain = static_cast<std::uint32_t>(options.domain),
                                    .xml = dds::domain_xml(options.interface, options.peers),
                                    .loopback = options.interface.empty()});
    if (!place) return refuse(fmt::format("network list: {}", place.error().message));
    const auto secret = secret_for(options);
    if (secret && !*secret) return refuse(fmt::format("network list: {}", secret->error().message));
    const auto sealed = secret ? dds::make_sealed_transport(**place, **secret) : nullptr;
    std::vector<std::unique_ptr<dds::Reader>> readers;
    for (dds::DdsTransport* each : {options.secret.empty() ? place->get() : nullptr, sealed.get()}) {
        if (each == nullptr) continue;
        readers.push_back(each->read(dds::announcement_topic()));
        if (readers.back() == nullptr) return refuse(fmt::format("network list: {}", (*place)->problem()));
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(options.seconds));
    dds::HostTable hosts({}, 0);
    for (const auto& reader : readers) {
        for (const dds::TopicSample& sample : reader->take()) hosts.heard(sample.writer, sample.bytes, 0);
    }
    const std::string text = dds::list_domain(hosts.all(), (*place)->seen());
    put_text(stdout, text.empty() ? fmt::format("domain {} is empty\n", options.domain) : text);
    return exit_done;
}

int write_secret(const std::string& file) {
    std::error_code none;
    if (std::filesystem::exists(file, none))
        return refuse(
            fmt::format("network secret: {} exists already and is not replaced, because hosts that use it could no "
                        "longer connect: give "
                        "another name",
                        file));
    // Other users must not be able to read the secret, even while the file is being written.
    const mode_t before = umask(077);
    const auto written = write_whole(file, dds::secret_text(dds::make_secret()));
    umask(before);
    if (!written) return refuse(written.error());
    put_text(stdout,
             fmt::format(
                 "{} is a new secret: copy it to each host, and name it in the system file: network {{ secret = \"{}\" "
                 "}}\n",
                 file, std::filesystem::path(file).filename().string()));
    return exit_done;
}

}  // namespace

SubCommand network_command() {
    auto list = std::make_shared<ListOptions>();
    auto file = std::make_shared<std::string>();
    return {.name = "network",
            .help = "List the hosts and topics of a network, or make a secret for a network",
            .commands = {
                {.name = "list",
                 .help = "Print the hosts that announce themselves, and the topics of ROS 2",
                 .options = {{"--domain", &list->domain, "the domain, as in `network` of the system file (default: 0)",
                              "N"},
                             {"--interface", &list->interface, "the network interface (default: the loopback)", "NAME"},
                             {"--peer", &list->peers, "addresses of hosts, if the network has no multicast", "ADDRESS"},
                             {"--secret", &list->secret, "the secret of the hosts that are listed", "FILE"},
                             {"--seconds", &list->seconds, "how long to listen", "S", number_from(0.1, 60)}},
                 .run = [list] { return list_network(*list); },
                 .footer = "Hosts that have a secret are listed only with the same secret: --secret. On the loopback, "
                           "this user's hosts are listed without it."},
                {.name = "secret",
                 .help = "Write a new secret into a file, for hosts that are to trust each other",
                 .options = {{"FILE", file.get(), "a file that does not exist yet"}},
                 .run = [file] { return write_secret(*file); }}}};
}

}  // namespace nezumi::cli
