// The RTCs of `nezumi run`: what a system's file exports to OpenRTM's components.
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
    /// Begins to export. The loop must outlive it; `log` takes what is to be said. The error says why it can't.
    static Expected<std::unique_ptr<RunRtm>> open(RunLoop& loop, std::function<void(const LogLine&)> log);

    /// Asks RTCs of other programs what a console wants to know, or to have done.
    std::future<Expected<std::string>> ask(const PeerRequest& request);

    bool serve(Pacer::Clock::time_point until) override;
    void add_files(std::vector<int>& files) const override { files.push_back(bell_.get()); }

private:
    explicit RunRtm(Descriptor bell) : bell_(std::move(bell)) {}

    Descriptor bell_;  // an eventfd: readable when an RTC wants something
    std::unique_ptr<openrtm::RtmServer> server_;
};

/// What a console is told where there is no `RunRtm`.
std::future<Expected<std::string>> refused_peers();

}  // namespace nezumi::cli
