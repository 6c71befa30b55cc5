// `--record FILE.mcap`: ports, truth, parameters, state, probes, log and journal of a run, for programs of ROS 2 and
// for nezumi itself.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/run/run_recording.hpp"
#include "bindings/journal/journal.hpp"
#include "bindings/record/mcap_writer.hpp"
#include "engine/base/file_writer.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/result_file.hpp"
#include "engine/live/running_system.hpp"
#include "engine/messages/message_coding.hpp"
#include "engine/trace/trace.hpp"

namespace nezumi::cli {

/// Each port is a topic, "/mouse/ir_sensor_out", in a type of ROS 2 if its type has one, else in nezumi's own. A
/// message is logged at the time of its tick, from 0; after a restart the time goes on. Its publish time is its stamp.
class McapRecorder final : public RunRecording {
public:
    /// Opens the file. The error says why the file can't be written; then the file is unchanged.
    static Expected<std::unique_ptr<McapRecorder>> create(const std::string& file);
    /// Without `finish` or `end_here` the file is dropped, and the older file is restored.
    ~McapRecorder() override;
    McapRecorder(const McapRecorder&) = delete;
    McapRecorder& operator=(const McapRecorder&) = delete;
    McapRecorder(McapRecorder&&) = delete;
    McapRecorder& operator=(McapRecorder&&) = delete;

    /// Records this system, which must outlive all calls except `give_up` and `end_here`: the channels with these names
    /// (see `follow_channels`), or everything if `names` is empty. Only ticks whose number is a multiple of `every` are
    /// recorded.
    Expected<void> begin(RunningSystem& live, const std::vector<std::string>& names, std::int64_t every);
    /// The function that takes the lines of the journal.
    JournalSink journal_sink();

    void add_rows(const System& system) override;
    void log(const LogLine& line) override;
    void seal() override { sealed_ = true; }
    Expected<void> finish() override;
    void end_here(std::string_view why) override;
    std::string told_of_older() const override { return file_.told_of_older(); }
    const std::optional<Error>& error() const override { return error_; }
    bool is_behind() const override { return writer_.is_behind(); }
    void give_up() override { writer_.give_up(); }

private:
    using Clock = std::chrono::steady_clock;
    // The data of the next write: messages, and pieces of the journal, whose text is made on the writer's thread.
    struct Batch {
        record::McapBatch batch;
        struct Piece {
            std::uint64_t log_time;
            std::function<std::string()> make;
        };
        std::vector<Piece> journal;
    };
    struct Followed {
        const Channel* channel;
        const MessageType* type = nullptr;  // of the port, as it was when `coding` was chosen; null: named values
        MessageCoding coding{};
        std::uint16_t number = 0;
        std::uint64_t turn = 0;
        Octets last{};  // bytes of named values, which are written when they change
        bool is_truth = false;
    };

    McapRecorder(std::string name, ResultFile file);
    void follow_all(const System& system);
    void follow(const Channel& channel, bool is_truth = false);
    std::uint16_t add_channel(std::string topic, const MessageCoding& coding,
                              std::map<std::string, std::string> metadata = {});
    void read(Followed& followed, std::uint64_t log_time, bool latest_only);
    void add(std::uint16_t channel, std::uint64_t log_time, double tm, const Octets& bytes);
    void flush();
    void end_file(std::chrono::milliseconds patience);

    const std::string name_;
    Mutex mutex_;  // for all members below
    ResultFile file_;
    FileWriter writer_;
    std::shared_ptr<record::McapWriter> out_ = std::make_shared<record::McapWriter>();  // used on the writer's thread
    RunningSystem* live_ = nullptr;
    bool follows_all_ = false;
    std::uint64_t layout_ = 0;
    std::vector<Followed> followed_;
    std::map<std::string, std::size_t> by_name_;
    std::uint16_t channels_ = 0;
    std::optional<std::uint16_t> log_, journal_;
    Batch next_;
    Octets bytes_;
    std::int64_t every_ = 1;
    int start_ = 0;
    double offset_ = 0;  // [s] of all starts before this one
    double now_ = 0;     // [s] of the last tick, from the first start on
    bool sealed_ = false, complete_ = false;
    Clock::time_point flushed_{}, packed_{};
    std::size_t unpacked_ = 0;  // [bytes] since the last whole chunk
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
