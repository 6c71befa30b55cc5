// Copies pictures, and encodes them in a thread that starts with the first picture.
#include "bindings/web/pictures.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bindings/web/web_frame.hpp"
#include "engine/base/list.hpp"
#include "engine/base/thread.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::web {
namespace {

// A reference to the picture of a port; nothing is copied.
const CameraImage& picture_of(const Port& port) {
    const auto* const out = dynamic_cast<const OutPort<CameraImage>*>(&port);
    return out != nullptr ? out->read() : dynamic_cast<const InPort<CameraImage>&>(port).latest().data;
}

}  // namespace

Pictures::~Pictures() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Pictures::look(const System& system, const std::vector<std::string>& ports, Clock::time_point now) {
    // Forgets ports that no browser watches, so that a browser that watches one again gets the present picture.
    const auto is_unwatched = [&](const auto& each) { return !contains(ports, each.first); };
    if (std::erase_if(seen_, is_unwatched) > 0) {
        const std::lock_guard lock(mutex_);
        std::erase_if(taken_, is_unwatched);
    }
    for (const std::string& path : ports) {
        const auto port = system.port(path);
        if (!port || (*port)->type() != message_of<CameraImage>() || (*port)->count() == 0) continue;
        Seen& seen = seen_[path];
        if (seen.count == (*port)->count() || now - seen.at < std::chrono::duration<double>(1 / most)) continue;
        seen = {(*port)->count(), now};
        const std::lock_guard lock(mutex_);
        Taken& taken = taken_[path];
        taken.image = picture_of(**port);
        taken.tm = (*port)->tm();
        taken.is_new = true;
        if (!thread_.joinable()) {
            try {
                thread_ = start_thread([this] { work(); });
            } catch (const std::system_error&) {
                taken_.clear();  // no thread could be started; the next picture tries again
            }
        }
        news_.notify_one();
    }
}

void Pictures::work() {
    bool has_failed = false;
    Taken taken;
    for (;;) {
        std::string port;
        {
            Lock lock(mutex_);
            auto next = taken_.end();
            news_.wait(lock, [&] {
                next = std::find_if(taken_.begin(), taken_.end(), [](const auto& each) { return each.second.is_new; });
                return ends_ || next != taken_.end();
            });
            if (ends_) return;
            port = next->first;
            std::swap(taken, next->second);
            next->second.is_new = false;
        }
        auto jpeg = encode_(taken.image);
        if (!jpeg) {
            if (!std::exchange(has_failed, true)) fail_(jpeg.error().message);
            continue;
        }
        const WebPicture picture{.port = port,
                                 .tm = taken.tm,
                                 .width = static_cast<std::uint32_t>(jpeg->width),
                                 .height = static_cast<std::uint32_t>(jpeg->height),
                                 .jpeg = std::move(jpeg->bytes)};
        Octets bytes;
        write_cdr(bytes, {}, picture);
        std::string message{static_cast<char>(BinaryKind::picture), 0, 0, 0};
        message.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        show_(port, std::move(message));
    }
}

}  // namespace nezumi::web
