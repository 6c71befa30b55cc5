// A recording that a run writes while it goes on, in any format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/system/system.hpp"

namespace nezumi::cli {

class RunRecording {
public:
    virtual ~RunRecording() = default;

    /// Adds the messages and values of the tick that has just ended.
    virtual void add_rows(const System& system) = 0;
    /// Adds a line of the log, if the format can contain log lines.
    virtual void log(const LogLine& /*line*/) {}
    /// From now on ticks are ignored.
    virtual void seal() = 0;
    /// Completes the file and removes the older file with its name. If the file can't be written, the error says why;
    /// then everything that was written completely is kept, and the older file too, under a name that the error gives.
    virtual Expected<void> finish() = 0;
    /// Completes the file of a run that failed; may be called while another thread is in a tick that does not end. The
    /// file says why in one line. Nothing is recorded afterwards.
    virtual void end_here(std::string_view why) = 0;
    /// `ResultFile::told_of_older`.
    virtual std::string told_of_older() const = 0;
    /// Why the file can't be written, as soon as this is known.
    virtual const std::optional<Error>& error() const = 0;
    /// True if the file is slower than the run: then a run without a clock should wait.
    virtual bool is_behind() const = 0;
    /// Drops what is not written yet, so that `finish` returns soon, with an error. From any thread.
    virtual void give_up() = 0;

protected:
    RunRecording() = default;
    RunRecording(const RunRecording&) = default;
    RunRecording(RunRecording&&) noexcept = default;
    RunRecording& operator=(const RunRecording&) = default;
    RunRecording& operator=(RunRecording&&) noexcept = default;
};

}  // namespace nezumi::cli
