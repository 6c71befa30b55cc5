// Records a run in MCAP. Messages are converted in the tick, and packed in the writer's thread.
#include "bindings/cli/run/mcap_recorder.hpp"

#include <fmt/format.h>

#include <thread>

#include "bindings/cli/run/recorder.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/tree/node.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/walk.hpp"

namespace nezumi::cli {
namespace {

// A killed process loses at most 0.1 s of the recording: this time, a tick, and the time to write.
constexpr std::chrono::milliseconds longest_unpacked{50};
constexpr std::chrono::seconds whole_chunk_every{1};
constexpr std::size_t largest_chunk = std::size_t{1} << 20;  // bytes
// How long `end_here` waits for a thread that is in the middle of a tick, and for a slow disk.
constexpr std::chrono::milliseconds longest_lock{400};
constexpr std::chrono::milliseconds longest_close{200};
constexpr std::size_t message_overhead = 31;  // bytes

MessageCoding coding_for(const MessageType& type) {
    auto coding = ros::find_coding(type);
    return coding ? std::move(*coding) : own_coding(type);
}

template <class T>
MessageCoding structure_coding() {
    return coding_of_structure(type_of<T>());
}

constexpr CdrFormat little_endian{.order = std::endian::little, .header = true};

std::string as_text(const Octets& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

Expected<std::unique_ptr<McapRecorder>> McapRecorder::create(const std::string& file) {
    auto opened = ResultFile::open(file);
    if (!opened) return Unexpected(opened.error());
    return std::unique_ptr<McapRecorder>(new McapRecorder(file, std::move(*opened)));
}

McapRecorder::McapRecorder(std::string name, ResultFile file)
    : name_(std::move(name)), file_(std::move(file)), writer_(file_.descriptor()) {
    const auto begin = [out = out_] { return out->begin(); };
    file_.path().empty() ? writer_.put(0, begin) : writer_.put_over(0, begin);
    journal_ = add_channel(std::string(record::journal_topic), structure_coding<record::RosString>());
    log_ = add_channel(std::string(record::log_topic), structure_coding<record::RosLog>());
}

McapRecorder::~McapRecorder() {
    if (complete_) return;
    writer_.give_up();
    writer_.close();
    file_.discard();
}

Expected<void> McapRecorder::begin(RunningSystem& live, const std::vector<std::string>& names, std::int64_t every) {
    const std::lock_guard lock(mutex_);
    live_ = &live;
    every_ = every;
    start_ = live.generation();
    follows_all_ = names.empty();
    if (follows_all_) {
        follow_all(live.system());
        return {};
    }
    const auto channels = follow_channels(live.trace(), live.system(), names);
    if (!channels) return Unexpected(channels.error());
    for (const Channel* each : *channels) follow(*each);
    return {};
}

// Follows all ports, the truth, and named values. Connected in-ports of pictures are left out: they have the same
// pictures as an out-port.
void McapRecorder::follow_all(const System& system) {
    layout_ = system.layout();
    const auto follow_path = [&](const std::string& path, bool is_truth = false) {
        if (by_name_.contains(path)) return;
        if (const auto channel = live_->trace().follow(path)) follow(**channel, is_truth);
    };
    const TreeNode root(system);
    for (const Component* component : system.components()) {
        const std::string name = component->name();
        for (const Port* port : ports_of(*component)) {
            const bool has_pictures = port->type() == message_of<CameraImage>();
            if (has_pictures && port->direction() == Direction::in && static_cast<const InPortBase*>(port)->connected())
                continue;
            follow_path(join_path(name, port->name()));
        }
        const auto node = root.child(name);
        if (!node) continue;
        for (const std::string& member : changing_members(*node)) {
            if (member == "truth") {
                follow_path(name + ".truth.pose", true);
                follow_path(name + ".truth.velocity", true);
            } else {
                follow_path(join_path(name, member));
            }
        }
    }
}

void McapRecorder::follow(const Channel& channel, bool is_truth) {
    if (!by_name_.emplace(channel.name(), followed_.size()).second) return;
    Followed made{.channel = &channel, .is_truth = is_truth};
    if (is_truth) {
        made.type = channel.part() == "pose" ? message_of<Pose2D>() : message_of<Velocity2D>();
        made.coding = coding_for(*made.type);
    } else if (!channel.is_port() || !channel.part().empty()) {
        made.coding = structure_coding<record::NamedValues>();
    } else {
        made.type = channel.port()->type();
        made.coding = coding_for(*made.type);
    }
    std::map<std::string, std::string> metadata;
    if (made.type != nullptr && !is_truth)
        metadata = {{std::string(record::port_entry), channel.name()}, {"nezumi_type", made.type->name}};
    made.number = add_channel(record::topic_of(channel.name()), made.coding, std::move(metadata));
    followed_.push_back(std::move(made));
}

std::uint16_t McapRecorder::add_channel(std::string topic, const MessageCoding& coding,
                                        std::map<std::string, std::string> metadata) {
    next_.batch.channels.emplace_back(channels_,
                                      record::RecordedChannel{.topic = std::move(topic),
                                                              .encoding = "cdr",
                                                              .schema = {coding.type, "ros2msg", coding.definition},
                                                              .metadata = std::move(metadata)});
    return channels_++;
}

JournalSink McapRecorder::journal_sink() {
    return [this](std::size_t bytes, std::function<std::string()> make) {
        const std::lock_guard lock(mutex_);
        if (complete_) return;
        next_.journal.push_back({record::to_nanoseconds(now_), std::move(make)});
        next_.batch.bytes += bytes;
    };
}

void McapRecorder::log(const LogLine& line) {
    const std::lock_guard lock(mutex_);
    if (sealed_ || complete_) return;
    const double tm = line.seconds + offset_;
    write_cdr(bytes_, little_endian, record::to_ros(line, tm));
    add(*log_, record::to_nanoseconds(tm), tm, bytes_);
}

void McapRecorder::add(std::uint16_t channel, std::uint64_t log_time, double tm, const Octets& bytes) {
    next_.batch.bytes += bytes.size() + message_overhead;
    next_.batch.messages.push_back({channel, log_time, record::to_nanoseconds(tm), as_text(bytes)});
}

void McapRecorder::read(Followed& followed, std::uint64_t log_time, bool latest_only) {
    const Channel& channel = *followed.channel;
    if (channel.turn() == followed.turn || channel.fresh() == 0) return;
    followed.turn = channel.turn();
    if (followed.type == nullptr || followed.is_truth) {
        record::NamedValues values;
        std::vector<double> numbers;
        channel.visit_latest([&](const LeafPath& path, const ValueView& leaf) {
            const std::string name = path.text().empty() ? "value" : path.text();
            if (leaf.type->kind == Type::Kind::text) {
                values.texts.push_back({name, leaf.as<std::string>()});
            } else {
                const double number = visit_number(leaf, [](const auto& n) { return static_cast<double>(n); });
                followed.is_truth ? numbers.push_back(number)
                                  : static_cast<void>(values.numbers.push_back({name, number}));
            }
        });
        if (!followed.is_truth) {
            followed.coding.write(bytes_, values, now_);
            if (std::exchange(followed.last, bytes_) != bytes_) add(followed.number, log_time, now_, bytes_);
            return;
        }
        if (numbers.size() != 3) return;
        if (channel.part() == "pose") {
            followed.coding.write(bytes_, Pose2D{{numbers[0], numbers[1]}, numbers[2]}, now_);
        } else {
            followed.coding.write(bytes_, Velocity2D{numbers[0], numbers[1], numbers[2]}, now_);
        }
        add(followed.number, log_time, now_, bytes_);
        return;
    }
    const Port& port = *channel.port();
    if (port.type() != followed.type) {  // a reload has defined the type again
        followed.type = port.type();
        followed.coding = coding_for(*followed.type);
        followed.number =
            add_channel(record::topic_of(channel.name()), followed.coding,
                        {{std::string(record::port_entry), channel.name()}, {"nezumi_type", followed.type->name}});
    }
    for (std::size_t i = latest_only ? channel.fresh() - 1 : 0; i < channel.fresh(); ++i) {
        const MessageView message = channel.message(i);
        const double tm = message.tm + offset_;
        followed.coding.write(bytes_, message.data, tm);
        add(followed.number, log_time, tm, bytes_);
    }
}

void McapRecorder::add_rows(const System& system) {
    const std::lock_guard lock(mutex_);
    if (sealed_ || complete_ || error_) return;
    if (start_ != live_->generation()) {
        start_ = live_->generation();
        offset_ = now_ + 1 / system.settings().rate;
    }
    now_ = system.last_tick().seconds + offset_;
    if (follows_all_ && layout_ != system.layout()) follow_all(system);
    if (system.last_tick().tick % every_ == 0) {
        const std::uint64_t log_time = record::to_nanoseconds(now_);
        for (Followed& each : followed_) read(each, log_time, every_ > 1);
    }
    if (next_.batch.bytes >= largest_chunk || Clock::now() - flushed_ > longest_unpacked) flush();
}

void McapRecorder::flush() {
    flushed_ = Clock::now();
    const bool is_on_disk = !file_.path().empty();
    const std::size_t bytes = next_.batch.bytes;
    unpacked_ += bytes;
    const bool is_whole = unpacked_ >= largest_chunk || flushed_ - packed_ > whole_chunk_every;
    auto batch = std::make_shared<Batch>(std::exchange(next_, {}));
    const auto pack = [out = out_, batch, number = *journal_, is_on_disk, is_whole] {
        for (const Batch::Piece& piece : batch->journal) {
            Octets text;
            write_cdr(text, little_endian, record::RosString{piece.make()});
            batch->batch.messages.push_back({number, piece.log_time, piece.log_time, as_text(text)});
        }
        out->add(batch->batch);
        // An output that can't be overwritten, such as a pipe, gets only whole chunks.
        return is_whole ? out->whole_chunk() : is_on_disk ? out->small_chunk() : std::string();
    };
    is_whole&& is_on_disk ? writer_.put_over(bytes, pack) : writer_.put(bytes, pack);
    if (is_whole) {
        packed_ = flushed_;
        unpacked_ = 0;
    }
    if (const int problem = writer_.problem(); problem != 0 && !error_)
        error_ = Error{"can't be written: " + why_not_written(problem), {name_}};
}

void McapRecorder::end_file(std::chrono::milliseconds patience) {
    sealed_ = complete_ = true;
    flush();
    const auto end = [out = out_] { return out->end(); };
    file_.path().empty() ? writer_.put(0, end) : writer_.put_over(0, end);
    if (const int problem = writer_.close(patience); problem != 0) {
        if (!error_) error_ = Error{"can't be written: " + why_not_written(problem), {name_}};
        file_.cut_to(writer_.whole());
    }
}

Expected<void> McapRecorder::finish() {
    const std::lock_guard lock(mutex_);
    if (complete_) return {};
    end_file(FileWriter::forever);
    if (!error_) {
        file_.replace_older();
        return {};
    }
    if (!file_.path().empty()) error_->message += ": complete messages are kept" + file_.told_of_older();
    return Unexpected(*error_);
}

void McapRecorder::end_here(std::string_view why) {
    Lock lock(mutex_, std::try_to_lock);
    for (const auto until = Clock::now() + longest_lock; !lock && Clock::now() < until;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        static_cast<void>(lock.try_lock());
    }
    if (!lock || complete_) return;
    const LogLine line{LogLevel::error, now_, "", fmt::format("the recording ends here: {}", why)};
    write_cdr(bytes_, little_endian, record::to_ros(line, now_));
    add(*log_, record::to_nanoseconds(now_), now_, bytes_);
    end_file(longest_close);
}

}  // namespace nezumi::cli
