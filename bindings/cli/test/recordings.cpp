// A recorded world can't be changed: an act of the scenario on it is an error.
#include "bindings/cli/test/recordings.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "bindings/cli/files/judged_run.hpp"
#include "bindings/cli/files/recorded_system.hpp"

namespace nezumi::cli {
namespace {

class RecordedRun final : public RecordedWorld, private ActObserver {
public:
    RecordedRun(std::unique_ptr<RecordedSystem> recorded, std::string name)
        : recorded_(std::move(recorded)), name_(std::move(name)) {
        recorded_->live().observe_acts(this);
    }

    RunningSystem& live() override { return recorded_->live(); }
    Expected<bool> before_tick() override {
        if (changed_by_)
            return failure(fmt::format("a recording can't be changed, but the scenario did this: {}", *changed_by_),
                           {name_});
        return recorded_->before_tick(recorded_->live());
    }
    double length() const override {
        return static_cast<double>(recorded_->ticks()) / std::as_const(*recorded_).live().system().settings().rate;
    }

private:
    void acted(const ActTime&, std::shared_ptr<const PastAct> act, const Expected<ActResult>&) override {
        if (act->who.kind == Actor::Kind::scenario && !changed_by_) changed_by_ = act_in_words(name_of(act->act));
    }
    void ran_out_of_time(const ActTime&, const std::string&, const Component::OutOfTime&) override {}

    std::unique_ptr<RecordedSystem> recorded_;
    std::string name_;
    std::optional<std::string> changed_by_;
};

class RecordingsOfFiles final : public Recordings {
public:
    Expected<std::unique_ptr<RecordedWorld>> open(const std::filesystem::path& file,
                                                  const std::map<std::string, std::string>& ports,
                                                  LiveOptions options) const override {
        // The log and prints of a repeated run are the same as before, so they are dropped.
        options.build.log = {};
        options.print = {};
        auto recorded = RecordedSystem::open(file, ports, std::move(options));
        if (!recorded) return Unexpected(recorded.error());
        return std::make_unique<RecordedRun>(std::move(*recorded), file.string());
    }

    Expected<std::vector<std::string>> judge(const JudgeRequest& request) const override {
        const auto run = JudgedRun::read(request);
        if (!run) return Unexpected(run.error());
        const auto judged = run->judge(request.tolerance, [](const LogLine&) {});
        if (!judged) return Unexpected(judged.error());
        return judged->different == 0 ? std::vector<std::string>() : run->text_of(*judged);
    }
};

}  // namespace

const Recordings& recordings() {
    static const RecordingsOfFiles files;
    return files;
}

}  // namespace nezumi::cli
