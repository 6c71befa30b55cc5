// Camera pictures for browsers: copied between two ticks, encoded on another thread, only while a browser watches.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/system.hpp"
#include "engine/world/picture.hpp"

namespace nezumi::web {

class Pictures {
public:
    using Clock = std::chrono::steady_clock;
    /// `Show` takes a complete message for browsers, `Fail` the reason why there is none. Called in the encoder's
    /// thread.
    using Show = std::function<void(const std::string& port, std::string message)>;
    using Fail = std::function<void(const std::string& why)>;
    /// Encodes a picture. Called in a thread of its own.
    using Encode = std::function<Expected<JpegPicture>(const CameraImage& picture)>;

    /// The largest rate per port [Hz].
    static constexpr double most = 10;

    Pictures(Encode encode, Show show, Fail fail)
        : encode_(std::move(encode)), show_(std::move(show)), fail_(std::move(fail)) {}
    ~Pictures();
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

    /// Copies the new pictures of these ports ("name.port"), between two ticks. A newer picture replaces one that is
    /// not encoded yet.
    void look(const System& system, const std::vector<std::string>& ports, Clock::time_point now);

private:
    struct Taken {
        CameraImage image{};
        double tm = 0;
        bool is_new = false;
    };
    struct Seen {
        std::uint64_t count = 0;
        Clock::time_point at{};
    };

    void work();

    Encode encode_;
    Show show_;
    Fail fail_;
    std::map<std::string, Seen, std::less<>> seen_;  // used by the ticking thread
    Mutex mutex_;                                    // for the members below
    std::condition_variable news_;
    std::map<std::string, Taken, std::less<>> taken_;  // by port; the memory of an old picture is used for the next one
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi::web
