// Of waiting velocities only the newest is kept, and late ones are dropped. All other messages are delivered, oldest
// first, while the queue has space.
#include "bindings/dds/port_topic.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/messages/message_catalog.hpp"

namespace nezumi::dds {
namespace {

bool is_velocity(const MessageType* type) { return type == message_of<Velocity2D>(); }

// The queue for a slow host: one second of a port that publishes at 100 Hz.
constexpr int most_waiting = 128;
// Pictures are large, and only the newest are useful.
constexpr int most_pictures = 2;

}  // namespace

Topic topic_of(std::string_view host, std::string_view port, const MessageType* type) {
    const bool picture = type == message_of<CameraImage>();
    // Names of topics consist of letters, digits, '_' and '/' (DDS 1.4, annex B).
    const std::size_t dot = port.find('.');
    return {.name = fmt::format("nezumi/{}/{}/{}", host, port.substr(0, dot), port.substr(dot + 1)),
            .type = fmt::format("nezumi::{}", wire_name(*type)),
            .reliable = !is_velocity(type),
            .depth = is_velocity(type) ? 1
                     : picture         ? most_pictures
                                       : most_waiting};
}

void Outlet::send(const Time& now, std::uint64_t run, double clock) {
    take([&](const MessageView& message) {
        const MessageHead head{
            .run = run, .number = ++number_, .stamp = message.tm, .tick = now.tick, .offset = clock - now.seconds};
        write_cdr(bytes_, on_the_wire, head, message.data);
        static_cast<void>(writer_->write(bytes_));
    });
}

Inlet::Inlet(const MessageType* type, std::unique_ptr<Reader> reader, Progress& progress)
    : type_(type), reader_(std::move(reader)), progress_(progress) {}

void Inlet::receive(std::optional<std::uint64_t> run, double clock, const Give& give) {
    if (run && run != progress_.run) {
        progress_ = {.run = run};
        age_ = {};
    }
    for (const TopicSample& sample : reader_->take()) {
        if (run) {
            take(sample.bytes, *run, clock, give);
        } else {
            ++counts_.wrong;
        }
    }
}

void Inlet::take(const Octets& bytes, std::uint64_t run, double clock, const Give& give) {
    MessageHead head;
    auto value = read_message(type_, bytes, head);
    const double sent = head.stamp + head.offset;
    const bool fits = value && std::isfinite(sent) && head.run == run;
    // A number that is not newer belongs to a repeated message.
    if (!fits || head.number <= progress_.number) {
        ++counts_.wrong;
        return;
    }
    if (progress_.number > 0) counts_.missed += head.number - progress_.number - 1;
    progress_.number = head.number;
    const double age = age_.of(sent, clock);
    if (is_velocity(type_) && age > silence) {
        ++counts_.late;
        return;
    }
    ++counts_.taken;
    give(std::move(*value));
}

}  // namespace nezumi::dds
