// The one browser of the run is the page in which it runs.
#include "bindings/wasm/page_run.hpp"

#include <utility>

#include "bindings/embed/simulation.hpp"
#include "bindings/wasm/in_place.hpp"

namespace nezumi::web {
namespace {

constexpr ClientId the_page = 1;

// The site whose messages the page takes.
Site*& site() {
    static Site* the = nullptr;
    return the;
}

class PageSockets final : public Sockets {
public:
    explicit PageSockets(Site& served) { site() = &served; }
    ~PageSockets() override { site() = nullptr; }
    PageSockets(const PageSockets&) = delete;
    PageSockets& operator=(const PageSockets&) = delete;

    int port() const override { return 0; }
    void wake() override {}
};

}  // namespace

Expected<std::unique_ptr<Sockets>> open_sockets(const SocketOptions& /*options*/, Site& served) {
    return std::make_unique<PageSockets>(served);
}

// The console and the page get time between ticks.
class PageRun::Served final : public Attendant {
public:
    Served(ConsoleServer& consoles, WebServer& server) : consoles_(consoles), server_(server) {}

    bool serve(Clock::time_point until) override {
        const bool consoles_work = consoles_.serve(until);
        return server_.serve(until, 0) || consoles_work;
    }

private:
    ConsoleServer& consoles_;
    WebServer& server_;
};

PageRun::PageRun(Send send) : send_(std::move(send)) {}

PageRun::~PageRun() {
    tick_in_place_by({});
    served_.reset();
    server_.reset();
    consoles_.reset();
}

Expected<std::unique_ptr<PageRun>> PageRun::open(const std::filesystem::path& file,
                                                 std::vector<std::filesystem::path> installed, Send send) {
    std::unique_ptr<PageRun> run(new PageRun(std::move(send)));
    PageRun& here = *run;
    LiveOptions options = simulated_systems(std::move(installed));
    options.watch = true;
    options.build.seed = usual_seed;
    options.build.log = [&here](const LogLine& line) {
        here.problems_.take(line);
        if (here.server_) here.server_->log(line);
        if (here.consoles_) here.consoles_->log(line);
    };
    options.print = [&here](std::string_view line) {
        if (here.server_) here.server_->say(std::string(line));
    };
    auto live = RunningSystem::load(file, std::move(options));
    if (!live) return Unexpected(live.error());
    run->live_ = std::move(*live);
    run->live_->trace().remember_ports();
    run->live_->remember_run();
    run->loop_ = std::make_unique<RunLoop>(*run->live_, RunLoop::Options{.problems = &run->problems_});
    run->consoles_ = std::make_unique<ConsoleServer>(*run->live_, *run->loop_);
    auto server =
        WebServer::open(*run->live_, *run->loop_, *run->consoles_, {.sockets = {.relay = 0}, .version = "web"});
    if (!server) return Unexpected(server.error());
    run->server_ = std::move(*server);
    run->live_->activate();
    run->served_ = std::make_unique<Served>(*run->consoles_, *run->server_);
    run->loop_->add(*run->served_);
    run->loop_->after_tick([&here] { here.consoles_->after_tick(); });
    tick_in_place_by([&here] { return here.tick_for_console(); });
    site()->opened(the_page, {});
    run->send_all();
    return run;
}

void PageRun::send_all() {
    while (auto message = site()->next(the_page)) send_(*message);
}

void PageRun::receive(std::string_view text) { static_cast<void>(site()->received(the_page, text)); }

double PageRun::go_on(double seconds) {
    look_at_files();
    const double wait = loop_->go_on(seconds);
    send_all();
    return wait;
}

bool PageRun::tick_for_console() {
    if (loop_->is_paused()) return false;
    loop_->tick();
    send_all();
    return true;
}

}  // namespace nezumi::web
