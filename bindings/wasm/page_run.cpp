// The run has one browser: the page in which it runs.
#include "bindings/wasm/page_run.hpp"

#include <utility>

#include "bindings/cli/files/page_editor.hpp"
#include "bindings/embed/simulation.hpp"
#include "bindings/wasm/in_place.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

constexpr ClientId the_page = 1;
constexpr std::size_t largest_journal = std::size_t{1} << 28;  // [bytes]

// The server whose messages go to the page.
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

// Gives the console and the page time between ticks.
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
    served_.reset();
    server_.reset();
    consoles_.reset();
}

LiveOptions PageRun::options(std::vector<std::filesystem::path> installed) {
    LiveOptions options = simulated_systems(std::move(installed));
    options.watch = true;
    options.build.seed = usual_seed;
    options.build.log = [this](const LogLine& line) {
        problems_.take(line);
        if (server_) server_->log(line);
        if (consoles_) consoles_->log(line);
    };
    options.print = [this](std::string_view line) {
        if (server_) server_->say(std::string(line));
    };
    return options;
}

// Gives the loaded system its loop, its consoles and its page, and activates it.
Expected<void> PageRun::serve() {
    live_->trace().remember_ports();
    live_->remember_run();
    loop_ = std::make_unique<RunLoop>(*live_, RunLoop::Options{.problems = &problems_});
    consoles_ = std::make_unique<ConsoleServer>(*live_, *loop_);
    auto server = WebServer::open(
        *live_, *loop_, *consoles_,
        {.sockets = {.relay = 0}, .version = NEZUMI_VERSION, .editor = cli::editor_of(live_->project())});
    if (!server) return Unexpected(server.error());
    server_ = std::move(*server);
    served_ = std::make_unique<Served>(*consoles_, *server_);
    loop_->add(*served_);
    loop_->after_tick([this] { consoles_->after_tick(); });
    live_->activate();
    return {};
}

Expected<std::unique_ptr<PageRun>> PageRun::open(const std::filesystem::path& file,
                                                 std::vector<std::filesystem::path> installed, Send send) {
    std::unique_ptr<PageRun> run(new PageRun(std::move(send)));
    auto live = RunningSystem::load(file, run->options(std::move(installed)));
    if (!live) return Unexpected(live.error());
    run->live_ = std::move(*live);
    if (auto served = run->serve(); !served) return Unexpected(served.error());
    site()->opened(the_page, {});
    run->send_all();
    return run;
}

Expected<std::unique_ptr<PageRun>> PageRun::open_run(const std::filesystem::path& journal,
                                                     std::vector<std::filesystem::path> installed, Send send) {
    std::unique_ptr<PageRun> run(new PageRun(std::move(send)));
    const auto text = read_whole(journal, journal.string(), largest_journal);
    if (!text) return Unexpected(text.error());
    auto replay = Replay::of_text(*text, journal, NEZUMI_VERSION);
    if (!replay) return Unexpected(replay.error());
    run->replay_ = std::move(*replay);
    auto live = run->replay_->load(run->options(std::move(installed)));
    if (!live) return Unexpected(live.error());
    run->live_ = std::move(*live);
    if (auto served = run->serve(); !served) return Unexpected(served.error());
    for (;;) {
        const auto more = run->replay_->before_tick(*run->live_);
        if (!more) return Unexpected(more.error());
        if (!*more) break;
        run->live_->tick();
    }
    run->loop_->pause();
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

}  // namespace nezumi::web
