// The one system that a class shares: it runs in a copy of the teacher's project, which is made again for each start.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings/web/classroom/seat.hpp"
#include "bindings/web/classroom/turns.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

struct SharedOptions {
    std::filesystem::path file{};                  ///< the teacher's system file; empty: the class shares none
    std::vector<std::string> hardware{};           ///< options of its run; empty: it is simulated
    std::vector<std::filesystem::path> devices{};  ///< folders of devices that it may use
};

struct SharedSystem : ClassSystem {
    /// Takes the place of a pupil's number.
    static constexpr int number = most_number + 1;
    /// Likewise for what a pupil has opened.
    static constexpr int page_of(int pupil) { return number + pupil; }

    /// `folder` is that of the copy. An error: the file is not within `behaviors/` of a project, or can't be copied.
    static Expected<std::unique_ptr<SharedSystem>> open(SharedOptions options, std::filesystem::path folder);

    std::string name() const { return options.file.stem().string(); }
    bool is_real() const { return !options.hardware.empty(); }
    /// The system file in the copy.
    std::filesystem::path file() const;
    /// Makes the copy again, without exercises and scenarios.
    Expected<void> renew() const;
    /// Puts the behaviours and modules of a pupil's project in the place of those of the copy; the running system
    /// reloads them as any saved file. Returns how many have changed. An error: none has the name of one that runs.
    Expected<std::size_t> take_behaviors(const std::filesystem::path& work) const;

    const SharedOptions options;
    const std::filesystem::path folder;
    Turns turns{};
    std::string problem_of_driver{};       ///< why the driver's behaviours were not taken; "" if they were
    const PupilRun* run_before = nullptr;  ///< that is ending: devices are free when it has ended

private:
    SharedSystem(SharedOptions its, std::filesystem::path copy) : options(std::move(its)), folder(std::move(copy)) {}
    std::filesystem::path root() const;
};

}  // namespace nezumi::web
