// The RTCs of `nezumi run`: exports a system's components to OpenRTM.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "bindings/console/peers.hpp"
#include "bindings/openrtm/rtm_server.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class RunRtm final : public Attendant {
public:
    /// Starts the export. The loop must outlive this object. `log` gets messages. An error gives the reason.
    static Expected<std::unique_ptr<RunRtm>> open(RunLoop& loop, std::function<void(const LogLine&)> log);

    /// Passes a console's question or request to RTCs of other programs.
    std::future<Expected<std::string>> ask(const PeerRequest& request);
    /// Asks about all RTCs; the answer is JSON for the page.
    std::future<std::string> look();

    bool serve(Pacer::Clock::time_point until) override;
    void add_files(std::vector<int>& files) const override { files.push_back(bell_.get()); }

private:
    explicit RunRtm(Descriptor bell) : bell_(std::move(bell)) {}

    Descriptor bell_;  // an eventfd: readable when an RTC has a request
    std::unique_ptr<openrtm::RtmServer> server_;
};

/// The answer to a console without a `RunRtm`.
std::future<Expected<std::string>> refused_peers();

}  // namespace nezumi::cli
