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
    std::vector<std::string> hardware{};           ///< options of the run for a real robot; empty: a simulation
    std::vector<std::filesystem::path> devices{};  ///< folders of devices that the system may use
};

struct SharedSystem : ClassSystem {
    /// The number of the shared system; it is larger than all numbers of pupils.
    static constexpr int number = most_number + 1;
    /// The number of the page that a pupil has opened; different from the number above, if `pupil` is at least 1.
    static constexpr int page_of(int pupil) { return number + pupil; }

    /// `folder` is for the copy. Returns an error if the file is not within `behaviors/` of a project, or can't be
    /// copied.
    static Expected<std::unique_ptr<SharedSystem>> open(SharedOptions options, std::filesystem::path folder);

    std::string name() const { return options.file.stem().string(); }
    bool is_real() const { return !options.hardware.empty(); }
    /// The system file in the copy.
    std::filesystem::path file() const;
    /// Makes the copy again, without exercises and scenarios.
    Expected<void> renew() const;
    /// Replaces the behaviours and modules of the copy by those of a pupil's project. The running system reloads them
    /// like any saved file. Returns how many have changed. An error if no file has the name of a running behaviour.
    Expected<std::size_t> take_behaviors(const std::filesystem::path& work) const;

    const SharedOptions options;
    const std::filesystem::path folder;
    Turns turns{};
    std::string problem_of_driver{};       ///< why the driver's behaviours were not taken; "" if they were
    const PupilRun* run_before = nullptr;  ///< the run before, while it ends: its devices are not free yet

private:
    SharedSystem(SharedOptions its, std::filesystem::path copy) : options(std::move(its)), folder(std::move(copy)) {}
    std::filesystem::path root() const;
};

}  // namespace nezumi::web
