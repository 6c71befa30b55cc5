// Finds the page's files and a free port.
#include "bindings/cli/run/web.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/files/page_editor.hpp"
#include "bindings/terminal/input_history.hpp"
#include "bindings/web/certificate.hpp"
#include "bindings/web/qr_code.hpp"
#include "engine/base/module.hpp"
#include "engine/vision/checked_image.hpp"

namespace nezumi::cli {
namespace {

// Number of ports to try, from the wanted one.
constexpr int most_ports = 20;

bool is_set(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && *value != '\0';
}

// Asks the desktop, if there is one, to open the file, without waiting.
void show_in_browser(const std::filesystem::path& file) {
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return;
    const pid_t child = fork();
    if (child < 0) return;
    if (child == 0) {
        // The browser becomes a grandchild, so no process of ours has to wait for it.
        if (setsid() < 0 || fork() != 0) _exit(0);
        const int nothing = ::open("/dev/null", O_RDWR);
        for (const int file_of_ours : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, file_of_ours);
        execlp("xdg-open", "xdg-open", file.c_str(), static_cast<char*>(nullptr));
        _exit(1);
    }
    waitpid(child, nullptr, 0);
}

std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

Expected<PageSockets> sockets_of(const Web& web) {
    PageSockets sockets;
    if (web.on_input) {
        sockets.options.relay = STDIN_FILENO;
        return sockets;
    }
    sockets.options.first_port = web.port;
    sockets.options.ports = std::min(most_ports, 65536 - web.port);
    if (web.listen.empty()) return sockets;
    if (history_path().empty()) return failure("the certificate is stored in your home folder: set HOME");
    const auto certificate =
        web::find_certificate({.folder = history_path().parent_path(), .address = web.listen, .host = host_name()});
    if (!certificate) return Unexpected(certificate.error());
    sockets.options.address = web.listen;
    sockets.options.certificate = certificate->file;
    sockets.options.key = certificate->key;
    sockets.fingerprint = certificate->fingerprint;
    return sockets;
}

std::string about_certificate(const std::string& fingerprint) {
    return "the page's certificate was made by this computer: if the browser warns, the fingerprint (SHA-256) that it "
           "shows must be this one\n" +
           fingerprint;
}

RunWeb::RunWeb(RunLoop& loop, RunConsole& console, std::unique_ptr<web::WebServer> server, std::string fingerprint,
               bool on_input)
    : loop_(loop),
      console_(console),
      server_(std::move(server)),
      fingerprint_(std::move(fingerprint)),
      on_input_(on_input) {
    console_.show_status_by([this](const std::string& text, bool running) { server_->show_status(text, running); });
}

RunWeb::~RunWeb() { console_.show_status_by({}); }

Expected<std::unique_ptr<RunWeb>> RunWeb::open(RunLoop& loop, RunConsole& console, const Web& web,
                                               web::PeerSource peers, std::vector<std::string> conditions) {
    const auto folders = installed_folders();
    web::WebOptions options{.page = folders.empty() ? std::filesystem::path() : folders.front() / "bindings/web/page",
                            .version = version(),
                            .encode = to_jpeg,
                            .peers = std::move(peers),
                            .editor = editor_of(loop.live().project()),
                            .only_shows = web.only_shows,
                            .conditions = std::move(conditions)};
    options.editor.program = own_program();
    auto sockets = sockets_of(web);
    if (!sockets) return Unexpected(sockets.error());
    options.sockets = std::move(sockets->options);
    auto server = web::WebServer::open(loop.live(), loop, console.server(), options);
    if (!server) return Unexpected(server.error());
    std::unique_ptr<RunWeb> run(
        new RunWeb(loop, console, std::move(*server), std::move(sockets->fingerprint), web.on_input));
    if (web.on_input) return run;
    // Without this entry the page works, but other pages do not list it.
    auto entry = web::PageEntry::open({.name = loop.live().file().stem().string(),
                                       .process = getpid(),
                                       .url = run->server_->url(),
                                       .view_url = run->server_->view_url()});
    if (entry) run->entry_.emplace(std::move(*entry));
    if (web.open && run->entry_) show_in_browser(run->entry_->file());
    return run;
}

std::string RunWeb::where() const {
    if (on_input_) return "";
    return "in a browser: " + url() + (fingerprint_.empty() ? "" : "\n" + about_certificate(fingerprint_));
}

std::string RunWeb::picture() const {
    if (fingerprint_.empty()) return "";
    const auto code = web::qr_code(url());
    return code ? *code : code.error().message + "\n";
}

}  // namespace nezumi::cli
