// The page for browsers of `nezumi run`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/run/console.hpp"
#include "bindings/cli/run/options.hpp"
#include "bindings/web/page_directory.hpp"
#include "bindings/web/web_server.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

/// How pages are served.
struct PageSockets {
    web::SocketOptions options{};
    std::string fingerprint{};  ///< of the certificate; "" for none
};
Expected<PageSockets> sockets_of(const Web& web);
/// The message about a certificate, with its fingerprint.
std::string about_certificate(const std::string& fingerprint);

class RunWeb final : public Attendant {
public:
    /// Starts to serve. `conditions` are those of a failed scenario that is opened. Loop and console must outlive this
    /// object. An error gives the reason.
    static Expected<std::unique_ptr<RunWeb>> open(RunLoop& loop, RunConsole& console, const Web& web,
                                                  web::PeerSource peers, std::vector<std::string> conditions);
    ~RunWeb() override;
    RunWeb(const RunWeb&) = delete;
    RunWeb& operator=(const RunWeb&) = delete;

    /// The page's address, with the token for full access.
    std::string url() const { return server_->url(); }
    /// The address for people ("" if the browsers are connected to `nezumi class`), and if other computers have access,
    /// the certificate's fingerprint.
    std::string where() const;
    /// The address as a QR code for a terminal; "" if only this computer has access.
    std::string picture() const;
    void log(const LogLine& line) { server_->log(line); }
    void say(const std::string& text) { server_->say(text); }

    bool is_watched() const { return server_->is_watched(); }
    void show_end(const std::string& text, bool is_good) { server_->show_end(text, is_good); }

    bool serve(Pacer::Clock::time_point until) override { return server_->serve(until, loop_.lateness().latest()); }
    void add_files(std::vector<int>& files) const override { server_->add_files(files); }

private:
    RunWeb(RunLoop& loop, RunConsole& console, std::unique_ptr<web::WebServer> server, std::string fingerprint,
           bool on_input);

    RunLoop& loop_;
    RunConsole& console_;
    std::unique_ptr<web::WebServer> server_;
    std::optional<web::PageEntry> entry_;
    std::string fingerprint_;  // of the certificate; "" for none
    bool on_input_;
};

}  // namespace nezumi::cli
