// Event devices as Linux has them: a keyboard, and a gamepad that comes and goes.
#pragma once

#include <linux/input.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tests/fakes/served_files.hpp"

namespace nezumi::fakes {

/// Folder "input". The gamepad has the axes and buttons of the most common one (of an Xbox 360); each plugging in gives
/// it a new number, from 3.
class GamepadNodes final : public ServedFiles {
public:
    GamepadNodes();

    std::vector<std::string> names() const override;
    std::vector<std::string> folders() const override { return {"input"}; }
    int look(const std::string& name) override;
    int open(const std::string& name, std::uint64_t& handle) override;
    int read(const std::string& name, std::uint64_t handle, std::string& text) override;
    int write(const std::string& name, std::uint64_t handle, std::string_view text) override;
    bool is_stream(const std::string& /*name*/) const override { return true; }
    int read_on(const std::string& name, std::uint64_t handle, std::size_t most, std::string& text) override;
    unsigned poll(const std::string& name, std::uint64_t handle, std::function<void()> again) override;
    int control(const std::string& name, std::uint64_t handle, unsigned request, void* data) override;

    /// Moves "ABS_X", presses "BTN_SOUTH" (1) or lets it go (0). False when there is none of this name.
    bool set(const std::string& name, int value);
    /// The same, but its events are lost, as when nobody has read for too long.
    bool set_unseen(const std::string& name, int value);
    void unplug();
    void plug_in();
    /// "none", "denied" (EACCES), "eio", "hang". False for another one.
    bool set_fault(const std::string& fault);

private:
    struct Reader {
        bool is_keyboard = false;
        int plugged_in = 0;  // when it was opened
        std::deque<input_event> events{};
        std::vector<std::function<void()>> waiting{};
    };
    int enter(std::unique_lock<std::mutex>& lock, const std::string& name);
    int enter(std::unique_lock<std::mutex>& lock, std::uint64_t handle);
    bool change(const std::string& name, int value, bool is_seen);
    void wake(Reader& reader);
    std::string gamepad() const;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<unsigned, input_absinfo> axes_;
    std::map<unsigned, bool> buttons_;
    std::map<std::uint64_t, Reader> readers_;
    std::uint64_t next_handle_ = 1;
    int plugged_in_ = 1;
    bool is_there_ = true;
    std::string fault_ = "none";
};

}  // namespace nezumi::fakes
