// Acts of RTCs are performed like all others.
#include "bindings/cli/run/rtm.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "bindings/lua/files/system_words.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi::cli {
namespace {

// Adds a behaviour as `behavior` at the console does. The new component is inactive.
Expected<void> add(RunningSystem& live, const openrtm::RtcRequest& request) {
    SystemWords words(live.project(), live.options().peer_words, live.spec());
    FileTable fields;
    fields.fields.push_back({"script", Value(request.script)});
    fields.fields.push_back({"active", Value(false)});
    auto read = words.entry({"behavior", {live.spec().file}, nullptr}, request.component, Value(std::move(fields)));
    if (read) read = words.finish();
    if (!read) return read;
    return live.act(Add{words.spec().entries.back()}, openrtm::rtm_actor).map([](const ActResult&) {});
}

std::vector<openrtm::RtcModule> modules_of(const Project& project, const std::string& file) {
    std::vector<openrtm::RtcModule> all;
    for (const std::string& name : project.names(FileKind::script, file)) all.push_back({name, type_of_file(name)});
    return all;
}

}  // namespace

Expected<std::unique_ptr<RunRtm>> RunRtm::open(RunLoop& loop, std::function<void(const LogLine&)> log) {
    Descriptor bell(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
    if (!bell) return failure(std::string("rtm: ") + std::strerror(errno));
    const int rings = bell.get();
    std::unique_ptr<RunRtm> rtm(new RunRtm(std::move(bell)));
    RunningSystem& live = loop.live();
    auto server = openrtm::RtmServer::open(
        {.system = [&live]() -> const System& { return live.system(); },
         .spec = [&live]() -> const SystemSpec& { return live.spec(); },
         .starts = [&live] { return live.generation(); },
         .act = [&live](const Act& act, const Actor& who) { return live.act(act, who); },
         .deliver = [&live](const Port& port, const Act& act,
                            const Actor& who) { return live.deliver(port, act, who); },
         .say =
             [&live, log = std::move(log)](bool is_problem, const std::string& text) {
                 const LogLevel level = is_problem ? LogLevel::warn : LogLevel::info;
                 log({level, live.system().now().seconds, "", text, live.starts()});
             },
         .wake =
             [rings] {
                 const std::uint64_t one = 1;
                 // The write fails if the counter is full: then the file is readable anyway.
                 if (::write(rings, &one, sizeof one) < 0) return;
             },
         .create = [&live](const openrtm::RtcRequest& request) { return add(live, request); },
         .modules = [project = live.project(), file = live.spec().file] { return modules_of(project, file); },
         .end = [&loop] { loop.quit(); }});
    if (!server) return Unexpected(server.error());
    rtm->server_ = std::move(*server);
    loop.before_tick([its = rtm.get()] { its->server_->before_tick(); });
    loop.after_tick([its = rtm.get()] { its->server_->after_tick(); });
    return rtm;
}

std::future<Expected<std::string>> RunRtm::ask(const PeerRequest& request) {
    using What = openrtm::RtcRequest::What;
    const auto to_be_done = [&]() -> std::optional<What> {
        switch (request.what) {
            case PeerRequest::What::look: break;
            case PeerRequest::What::activate: return What::activate;
            case PeerRequest::What::deactivate: return What::deactivate;
            case PeerRequest::What::reset: return What::reset;
            case PeerRequest::What::use: return What::use;
            case PeerRequest::What::configure: return What::set;
            case PeerRequest::What::exit: return What::exit;
            case PeerRequest::What::forget: return What::forget;
            case PeerRequest::What::connect: return What::connect;
            case PeerRequest::What::disconnect: return What::disconnect;
        }
        return std::nullopt;
    };
    openrtm::PeerQuestion question{.name = request.name};
    if (const auto what = to_be_done()) {
        question.request =
            openrtm::RtcRequest{.what = *what, .set = request.set, .from = request.from, .to = request.to};
        if (*what == What::connect) question.request->component = request.from + "_" + request.to;
        for (const auto& [name, value] : request.values)
            question.request->values.emplace_back(name, openrtm::to_rtc_text(value));
    }
    return server_->ask(std::move(question));
}

std::future<std::string> RunRtm::look() { return server_->look(); }

std::future<Expected<std::string>> refused_peers() {
    std::promise<Expected<std::string>> refused;
    refused.set_value(failure("this system is not connected to RTCs: write rtm { export = ... } in the system file"));
    return refused.get_future();
}

bool RunRtm::serve(Pacer::Clock::time_point /*until*/) {
    std::uint64_t rings = 0;
    if (read(bell_.get(), &rings, sizeof rings) < 0 && errno != EAGAIN) return false;
    server_->serve();
    return false;
}

}  // namespace nezumi::cli
