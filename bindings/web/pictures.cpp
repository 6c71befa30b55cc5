// The thread begins with the first picture.
#include "bindings/web/pictures.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bindings/web/jpeg.hpp"
#include "bindings/web/web_frame.hpp"
#include "engine/base/thread.hpp"
#include "engine/ports/cdr.hpp"

namespace nezumi::web {

Pictures::~Pictures() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Pictures::look(const System& system, const std::vector<std::string>& ports, Clock::time_point now) {
    // Who watches again is shown what there is.
    std::erase_if(seen_,
                  [&](const auto& each) { return std::find(ports.begin(), ports.end(), each.first) == ports.end(); });
    for (const std::string& path : ports) {
        const auto port = system.port(path);
        if (!port || (*port)->type() != type_index<CameraImage>() || (*port)->count() == 0) continue;
        Seen& seen = seen_[path];
        if (seen.count == (*port)->count() || now - seen.at < std::chrono::duration<double>(1 / most)) continue;
        seen = {(*port)->count(), now};
        Taken taken{std::get<CameraImage>((*port)->value()), (*port)->tm()};
        const std::lock_guard lock(mutex_);
        waiting_.insert_or_assign(path, std::move(taken));
        if (!thread_.joinable()) {
            try {
                thread_ = start_thread([this] { work(); });
            } catch (const std::system_error&) {
                waiting_.clear();  // the next picture tries again
            }
        }
        news_.notify_one();
    }
}

void Pictures::work() {
    bool has_failed = false;
    for (;;) {
        std::string port;
        Taken taken;
        {
            Lock lock(mutex_);
            news_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
            if (ends_) return;
            auto first = waiting_.extract(waiting_.begin());
            port = std::move(first.key());
            taken = std::move(first.mapped());
        }
        auto jpeg = to_jpeg(taken.image);
        if (!jpeg) {
            if (!std::exchange(has_failed, true)) fail_(jpeg.error().message);
            continue;
        }
        const WebPicture picture{.port = port,
                                 .tm = taken.tm,
                                 .width = taken.image.width,
                                 .height = taken.image.height,
                                 .jpeg = std::move(*jpeg)};
        Octets bytes;
        write_cdr(bytes, {}, picture);
        std::string message{static_cast<char>(BinaryKind::picture), 0, 0, 0};
        message.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        show_(port, std::move(message));
    }
}

}  // namespace nezumi::web
