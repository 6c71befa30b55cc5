// Watches: ports whose changes are shown, of this system and of other hosts.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/console/session_parts.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "engine/base/visible.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

constexpr double highest_watched_speed = 1000;  // the speed "max" is infinite, so it counts as this factor

// Shows a value with its stamp [s] if it has changed, and if enough time has passed since the last value was shown.
void show_value(Session::Parts& parts, PortWatch& watch, double stamp, const auto& text_of) {
    // A batch shows every change.
    const double speed = std::clamp(parts.clock.speed(), 1.0, highest_watched_speed);
    const double period = parts.options.batch ? 0 : parts.options.watch_period * speed;
    if (watch.shown_at >= 0 && stamp >= watch.shown_at && stamp < watch.shown_at + period) return;
    std::string text = text_of();
    if (watch.shown_at >= 0 && text == watch.shown) return;
    parts.show(fmt::format("[{:.3f}] {} = {}", stamp, watch.path, text));
    watch.shown = std::move(text);
    watch.shown_at = stamp;
}

// For a port of another host that has no connection in this system: asks the host for the value.
bool show_news_of_host(Session::Parts& parts, PortWatch& watch) {
    const System& system = parts.live.system();
    const std::chrono::duration<double> period(parts.options.batch ? 0 : parts.options.watch_period);
    if (!watch.elsewhere.number && Worker::Clock::now() - watch.elsewhere.asked < period) return true;
    std::string_view port = without_host(watch.path);
    const std::string component(take_step(port));
    const auto answer = go_on(system,
                              {.host = std::string(host_of(watch.path)),
                               .component = component,
                               .what = Question::What::port,
                               .name = std::string(port)},
                              watch.elsewhere);
    if (!answer) return true;
    if (!*answer) {
        const auto host = find_host(system, host_of(watch.path));  // a host that is away may come back
        return system.network() != nullptr && (!host || !host->here || check_offered(system, watch.path));
    }
    const auto& values = (*answer)->values;
    const auto* stamp = values.size() == 3 ? values[0].get_if<double>() : nullptr;
    const auto* count = values.size() == 3 ? values[1].get_if<std::int64_t>() : nullptr;
    const auto* text = values.size() == 3 ? values[2].get_if<std::string>() : nullptr;
    if (stamp == nullptr || count == nullptr || text == nullptr) return false;
    if (*count > 0) show_value(parts, watch, *stamp, [&] { return visible(*text); });
    return true;
}

}  // namespace

std::optional<Expected<PlainData>> go_on(const System& system, const Question& question, HostQuestion& open) {
    const Network* network = system.network();
    if (network == nullptr) return Unexpected(find_host(system, question.host).error());
    if (!open.number) {
        const auto number = network->ask(question);
        if (!number) return Unexpected(number.error());
        open = {*number, Worker::Clock::now()};
    }
    auto answer = network->answer(*open.number);
    if (answer) open.number.reset();
    return answer;
}

bool show_news(Session::Parts& parts, PortWatch& watch) {
    const auto port = parts.live.system().port(watch.path);
    if (!port) return is_remote(watch.path) && show_news_of_host(parts, watch);
    if ((*port)->count() == 0) return true;
    show_value(parts, watch, (*port)->tm(), [&] { return short_text((*port)->value(), watch_width); });
    return true;
}

}  // namespace nezumi
