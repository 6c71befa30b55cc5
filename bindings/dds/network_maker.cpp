// One object serves both other hosts and ROS, because a system has at most one `Network`.
#include "bindings/dds/network_maker.hpp"

#include <fmt/format.h>

#include <optional>
#include <random>
#include <type_traits>

#include "bindings/dds/domain_xml.hpp"
#include "bindings/dds/network_word.hpp"
#include "bindings/dds/ros/node.hpp"
#include "bindings/dds/ros/ros_word.hpp"
#include "bindings/dds/sealed_transport.hpp"
#include "bindings/dds/system_network.hpp"
#include "bindings/dds/transport.hpp"
#include "bindings/dds/user_secret.hpp"
#include "engine/base/time_of_day.hpp"

namespace nezumi::dds {
namespace {

constexpr std::string_view of_ros = "ros/";

// Systems that are checked, tested in scenarios or replayed use these: they send nothing and receive nothing.
class SilentWriter final : public Writer {
public:
    bool write(std::span<const std::uint8_t> /*cdr*/) override { return true; }
    int readers() const override { return 0; }
};

class SilentReader final : public Reader {
public:
    std::vector<TopicSample> take() override { return {}; }
    std::vector<std::uint64_t> writers() const override { return {}; }
    std::uint64_t lost() const override { return 0; }
};

class SilentTransport final : public DdsTransport {
public:
    std::unique_ptr<Writer> write(const Topic& /*topic*/) override { return std::make_unique<SilentWriter>(); }
    std::unique_ptr<Reader> read(const Topic& /*topic*/) override { return std::make_unique<SilentReader>(); }
    std::vector<SeenEndpoint> seen() override { return {}; }
    std::string problem() const override { return ""; }
};

class BothNetworks final : public Network {
public:
    /// `own`: a transport that only this object uses, or nullptr.
    BothNetworks(System& system, std::unique_ptr<DdsTransport> own, std::unique_ptr<SystemNetwork> hosts,
                 std::string node)
        : system_(system), own_(std::move(own)), hosts_(std::move(hosts)), node_(std::move(node)) {}

    Expected<void> reach(std::string_view path, const Port& other) override {
        if (path.starts_with(of_ros))
            return failure(fmt::format(
                "{}: connect can't reach the node's ports: use ros {{ publish = ..., subscribe = ... }}", shown(path)));
        if (hosts_ != nullptr) return hosts_->reach(path, other);
        return failure(
            fmt::format("{} is on another host: add network {{ name = ... }} to the system file", shown(path)));
    }
    void between_ticks(const ActDoor& act, const QuestionDoor& answer) override {
        if (hosts_ != nullptr) hosts_->between_ticks(act, answer);
        if (RosNode* its = node()) its->between_ticks();
    }
    void before_tick(const MessageDoor& deliver) override {
        if (hosts_ != nullptr) hosts_->before_tick(deliver);
        if (RosNode* its = node()) its->before_tick(deliver);
    }
    bool may_tick() override { return hosts_ == nullptr || hosts_->may_tick(); }
    bool is_in_lockstep() const override { return hosts_ != nullptr && hosts_->is_in_lockstep(); }
    void add_files(std::vector<int>& files) const override {
        if (hosts_ != nullptr) hosts_->add_files(files);
    }
    void leave() override {
        if (hosts_ != nullptr) hosts_->leave();
    }
    Expected<std::uint64_t> ask(const Question& question) const override {
        if (hosts_ != nullptr) return hosts_->ask(question);
        return failure("there are no other hosts: the system file has no network { name = ... }");
    }
    std::optional<Expected<PlainData>> answer(std::uint64_t number) const override {
        return hosts_ != nullptr ? hosts_->answer(number) : std::nullopt;
    }
    std::vector<Host> hosts() const override { return hosts_ != nullptr ? hosts_->hosts() : std::vector<Host>{}; }
    bool brought(const ConnectionSpec& connection) const override {
        if (connection.from.starts_with(of_ros) || connection.to.starts_with(of_ros)) return true;
        return hosts_ != nullptr && hosts_->brought(connection);
    }

private:
    // The ROS node; nullptr if there is none or it was removed.
    RosNode* node() { return node_.empty() ? nullptr : dynamic_cast<RosNode*>(system_.find(node_)); }

    System& system_;
    std::unique_ptr<DdsTransport>
        own_;  // also used by the components of other hosts, which are destroyed before the network
    std::unique_ptr<SystemNetwork> hosts_;
    std::string node_;  // name of the ROS component; "": none
};

// A different number at each start, on every host.
std::uint64_t new_run() {
    std::random_device random;
    return std::uint64_t{random()} << 32 | random() | 1;
}

// True if messages are encrypted: with the secret of the file, or on the loopback with this user's secret.
bool is_sealed(const NetworkSpec& spec) { return !spec.secret.empty() || (spec.interface.empty() && !spec.open); }

// True if other hosts may write, not only read.
bool is_writable(const NetworkSpec& spec) { return spec.open || is_sealed(spec); }

Expected<Secret> secret_of(const NetworkSpec& spec) {
    return spec.secret.empty() ? user_secret() : read_secret(spec.secret, spec.secret_path);
}

// Refuses settings that are valid in a file but not in this run.
Expected<void> check(const NetworkSpec& spec, const System& system) {
    if (spec.lockstep && system.settings().real_time)
        return failure("network: 'lockstep' works only in simulation: time does not wait for real robots", spec.place);
    if (spec.lockstep && !is_writable(spec))
        return failure(
            "network: 'lockstep' lets other hosts stop this system's time: it needs `secret`, or `open = true`",
            spec.place);
    return {};
}

// The participant in the domain of `network` or `ros`.
template <class Spec>
using Join = std::function<Expected<DdsTransport*>(const Spec& part)>;

Expected<std::unique_ptr<SystemNetwork>> make_host(const Join<NetworkSpec>& join, const NetworkSpec& spec,
                                                   System& system, const std::string& version, bool alone) {
    if (auto ok = check(spec, system); !ok) return Unexpected(ok.error());
    const auto transport = join(spec);
    if (!transport) return failure(fmt::format("network: {}", transport.error().message), spec.place);
    HostSettings settings;
    settings.name = spec.name;
    settings.version = version;
    settings.writable = is_writable(spec);
    settings.sealed = is_sealed(spec);
    settings.run = new_run();
    settings.clock = system.settings().clock;
    settings.lockstep = spec.lockstep && !alone;
    settings.hosts = spec.hosts;
    return std::make_unique<SystemNetwork>(system, **transport, std::move(settings));
}

template <class JoinAny>
Expected<std::unique_ptr<Network>> make_both(const SystemSpec& spec, System& system, const JoinAny& join,
                                             const std::string& version, std::unique_ptr<DdsTransport>& own,
                                             bool alone = false) {
    std::unique_ptr<SystemNetwork> host;
    if (const NetworkSpec* network = NetworkWord::find(spec)) {
        auto made = make_host(join, *network, system, version, alone);
        if (!made) return Unexpected(made.error());
        host = std::move(*made);
    }
    std::string its_node;
    if (const RosSpec* ros = RosWord::find(spec)) {
        const Expected<DdsTransport*> transport = join(*ros);
        if (!transport) return failure(fmt::format("ros: {}", transport.error().message), ros->place);
        const auto node =
            RosNode::add(system, *ros, **transport, {.clock = system.settings().clock, .wall_clock = time_of_day});
        if (!node) return Unexpected(node.error());
        its_node = (*node)->name();
    }
    return std::make_unique<BothNetworks>(system, std::move(own), std::move(host), std::move(its_node));
}

}  // namespace

Expected<DdsTransport*> Domains::join(std::int64_t domain, const std::string& interface,
                                      const std::vector<std::string>& peers) {
    const std::string xml = domain_xml(interface, peers);
    if (const auto found = joined_.find(domain); found != joined_.end()) {
        if (found->second.xml == xml) return found->second.transport.get();
        return failure(
            fmt::format("domain {} was joined by another interface or with other peers: restart nezumi", domain));
    }
    auto transport = open_({.domain = static_cast<std::uint32_t>(domain), .xml = xml, .loopback = interface.empty()});
    if (!transport) return Unexpected(transport.error());
    return joined_.emplace(domain, Joined{xml, std::move(*transport)}).first->second.transport.get();
}

NetworkMaker make_networks(Domains& domains, std::string version) {
    return [&domains, version = std::move(version)](const SystemSpec& spec,
                                                    System& system) -> Expected<std::unique_ptr<Network>> {
        std::unique_ptr<DdsTransport> sealed;
        const auto join = [&]<class Spec>(const Spec& part) -> Expected<DdsTransport*> {
            auto joined = domains.join(part.domain, part.interface, part.peers);
            if constexpr (std::is_same_v<Spec, NetworkSpec>) {
                if (!joined || !is_sealed(part)) return joined;
                const auto secret = secret_of(part);
                if (!secret) return Unexpected(secret.error());
                sealed = make_sealed_transport(**joined, *secret);
                return sealed.get();
            } else {
                return joined;
            }
        };
        return make_both(spec, system, join, version, sealed);
    };
}

namespace {

// `reads_secret`: the file of a secret must exist and be valid.
NetworkMaker make_silent(bool reads_secret) {
    return [reads_secret](const SystemSpec& spec, System& system) {
        std::unique_ptr<DdsTransport> silent = std::make_unique<SilentTransport>();
        const auto join = [its = silent.get(), reads_secret]<class Spec>(const Spec& part) -> Expected<DdsTransport*> {
            if constexpr (std::is_same_v<Spec, NetworkSpec>) {
                if (reads_secret && !part.secret.empty()) {
                    if (auto secret = read_secret(part.secret, part.secret_path); !secret)
                        return Unexpected(secret.error());
                }
            }
            return its;
        };
        return make_both(spec, system, join, "", silent, true);
    };
}

}  // namespace

NetworkMaker make_silent_networks() { return make_silent(false); }
NetworkMaker make_checked_networks() { return make_silent(true); }

}  // namespace nezumi::dds
