// A participant in a domain of Cyclone DDS: topics, and discovery of endpoints.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsrt/log.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/loopback_filter.hpp"
#include "bindings/dds/octet_type.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::dds {
namespace {

// Owns an entity of Cyclone DDS.
class Entity {
public:
    explicit Entity(dds_entity_t id) : id_(id) {}
    Entity(Entity&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Entity& operator=(Entity&&) = delete;
    ~Entity() {
        if (id_ > 0) dds_delete(id_);
    }
    dds_entity_t get() const { return id_; }
    bool ok() const { return id_ > 0; }

private:
    dds_entity_t id_;
};

struct FreeQos {
    void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, FreeQos>;

// [messages] The largest number, over all instances, that a reader or writer keeps.
constexpr int most_kept = 4096;

Qos qos_of(const Topic& topic) {
    Qos qos(dds_create_qos());
    // A write never blocks: messages that a slow reader has not acknowledged are replaced.
    dds_qset_reliability(qos.get(), topic.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_durability(qos.get(), topic.keeps_last ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    const int depth = std::clamp(topic.depth, 1, most_kept);
    dds_qset_history(qos.get(), topic.keeps_all ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, depth);
    if (topic.keeps_all) dds_qset_resource_limits(qos.get(), depth, DDS_LENGTH_UNLIMITED, depth);
    const dds_data_representation_id_t plain[] = {DDS_DATA_REPRESENTATION_XCDR1};
    dds_qset_data_representation(qos.get(), 1, plain);
    if (!topic.user_data.empty()) dds_qset_userdata(qos.get(), topic.user_data.data(), topic.user_data.size());
    return qos;
}

class CycloneWriter final : public Writer {
public:
    CycloneWriter(Entity topic, Entity writer) : topic_(std::move(topic)), writer_(std::move(writer)) {}
    bool write(std::span<const std::uint8_t> cdr) override { return dds_write(writer_.get(), &cdr) == DDS_RETCODE_OK; }
    int readers() const override {
        dds_publication_matched_status_t status{};
        if (dds_get_publication_matched_status(writer_.get(), &status) != DDS_RETCODE_OK) return 0;
        return static_cast<int>(status.current_count);
    }

private:
    Entity topic_;
    Entity writer_;
};

// A file that is readable from the arrival of a message until it is reset.
class Alarm {
public:
    Alarm() : file_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
    Alarm(Alarm&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    Alarm& operator=(Alarm&&) = delete;
    ~Alarm() {
        if (file_ >= 0) close(file_);
    }
    int file() const { return file_; }
    void calm() const {
        eventfd_t count = 0;
        static_cast<void>(eventfd_read(file_, &count));
    }
    /// Cyclone calls this on its own thread while the reader exists.
    void set_off_by(dds_entity_t reader) const {
        dds_listener_t* listener = dds_create_listener(reinterpret_cast<void*>(static_cast<std::intptr_t>(file_)));
        dds_lset_data_available(listener, [](dds_entity_t /*reader*/, void* file) {
            static_cast<void>(eventfd_write(static_cast<int>(reinterpret_cast<std::intptr_t>(file)), 1));
        });
        static_cast<void>(dds_set_listener(reader, listener));  // fails only if the entity is not a reader
        dds_delete_listener(listener);
    }

private:
    int file_;
};

using Admits = decltype(Topic::admits);

// Called by Cyclone's threads, so it must not throw.
bool admit(const void* sample, void* admits) {
    if (sample == nullptr) return false;
    try {
        return (*static_cast<const Admits*>(admits))(*static_cast<const std::span<const std::uint8_t>*>(sample));
    } catch (const std::bad_alloc&) {
        return false;
    }
}

class CycloneReader final : public Reader {
public:
    CycloneReader(std::unique_ptr<Admits> admits, std::optional<Alarm> alarm, Entity topic, Entity reader)
        : admits_(std::move(admits)), alarm_(std::move(alarm)), topic_(std::move(topic)), reader_(std::move(reader)) {}

    int file() const override { return alarm_ ? alarm_->file() : -1; }
    std::vector<TopicSample> take() override {
        if (alarm_) alarm_->calm();
        std::vector<TopicSample> all;
        constexpr std::uint32_t portion = 32;
        std::array<ddsi_serdata*, portion> data{};
        std::array<dds_sample_info_t, portion> infos{};
        for (;;) {
            const dds_return_t count = dds_takecdr(reader_.get(), data.data(), portion, infos.data(),
                                                   DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE);
            for (dds_return_t i = 0; i < count; ++i) {
                const auto at = static_cast<std::size_t>(i);
                if (infos[at].valid_data && data[at]->kind == SDK_DATA) {
                    const std::span<const std::uint8_t> bytes = octets_of(*data[at]);
                    all.push_back({{bytes.begin(), bytes.end()}, infos[at].publication_handle});
                }
                ddsi_serdata_unref(data[at]);
            }
            if (count < static_cast<dds_return_t>(portion)) return all;
        }
    }
    std::vector<std::uint64_t> writers() const override {
        std::vector<dds_instance_handle_t> found(16);
        dds_return_t count = 0;
        for (;;) {
            count = dds_get_matched_publications(reader_.get(), found.data(), found.size());
            if (count <= static_cast<dds_return_t>(found.size())) break;
            found.resize(static_cast<std::size_t>(count));
        }
        found.resize(static_cast<std::size_t>(std::max(count, 0)));
        return {found.begin(), found.end()};
    }
    std::uint64_t lost() const override {
        dds_sample_lost_status_t status{};
        if (dds_get_sample_lost_status(reader_.get(), &status) != DDS_RETCODE_OK) return 0;
        return status.total_count;
    }

private:
    // Members are destroyed in reverse order: the reader first, because its callbacks use the data above.
    std::unique_ptr<Admits> admits_;
    std::optional<Alarm> alarm_;
    Entity topic_;
    Entity reader_;
};

// Catches Cyclone's log messages, which otherwise go to standard error. The last one explains the next failure.
class LastWords {
public:
    LastWords() { dds_set_log_sink(&take, this); }
    ~LastWords() { dds_set_log_sink(nullptr, nullptr); }
    LastWords(const LastWords&) = delete;
    LastWords& operator=(const LastWords&) = delete;

    std::string text() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

private:
    static void take(void* self, const dds_log_data_t* said) {
        auto& words = *static_cast<LastWords*>(self);
        std::string text(said->message, said->size);
        while (!text.empty() && text.back() == '\n') text.pop_back();
        const std::lock_guard lock(words.mutex_);
        words.text_ = std::move(text);
    }

    mutable Mutex mutex_;
    std::string text_;
};

class Cyclone final : public DdsTransport {
public:
    std::string open(const DomainOptions& options) {
        const WithoutSignals during;
        domain_.emplace(dds_create_domain(options.domain, options.xml.c_str()));
        if (!domain_->ok()) return explain("the domain can't be opened", domain_->get());
        participant_.emplace(dds_create_participant(options.domain, nullptr, nullptr));
        if (!participant_->ok()) return explain("the domain can't be joined", participant_->get());
        if (options.loopback && hear_loopback_only(ports_of(options.domain)) < 1)
            return "the domain can't be limited to this computer: its sockets accept no filter";
        publications_.emplace(
            dds_create_reader(participant_->get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr));
        subscriptions_.emplace(
            dds_create_reader(participant_->get(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr));
        return "";
    }

    std::unique_ptr<Writer> write(const Topic& topic) override {
        Entity made = make_topic(topic);
        if (!made.ok()) return nullptr;
        const Qos qos = qos_of(topic);
        Entity writer(dds_create_writer(participant_->get(), made.get(), qos.get(), nullptr));
        if (!writer.ok()) {
            problem_ = explain(topic.name + " can't be written", writer.get());
            return nullptr;
        }
        return std::make_unique<CycloneWriter>(std::move(made), std::move(writer));
    }
    std::unique_ptr<Reader> read(const Topic& topic) override {
        Entity made = make_topic(topic);
        if (!made.ok()) return nullptr;
        auto admits = topic.admits ? std::make_unique<Admits>(topic.admits) : nullptr;
        if (admits != nullptr) {
            dds_topic_filter filter{};
            filter.mode = DDS_TOPIC_FILTER_SAMPLE_ARG;
            filter.f.sample_arg = admit;
            filter.arg = admits.get();
            dds_set_topic_filter_extended(made.get(), &filter);
        }
        const Qos qos = qos_of(topic);
        Entity reader(dds_create_reader(participant_->get(), made.get(), qos.get(), nullptr));
        if (!reader.ok()) {
            problem_ = explain(topic.name + " can't be read", reader.get());
            return nullptr;
        }
        std::optional<Alarm> alarm;
        if (topic.wakes) alarm.emplace().set_off_by(reader.get());
        return std::make_unique<CycloneReader>(std::move(admits), std::move(alarm), std::move(made), std::move(reader));
    }
    std::vector<SeenEndpoint> seen() override {
        std::vector<SeenEndpoint> all;
        add_seen(publications_->get(), true, all);
        add_seen(subscriptions_->get(), false, all);
        return all;
    }
    std::string problem() const override { return problem_; }

private:
    std::string explain(const std::string& what, dds_return_t code) const {
        const std::string words = words_.text();
        return what + ": " + (words.empty() ? dds_strretcode(code) : words);
    }

    Entity make_topic(const Topic& topic) {
        ddsi_sertype* given =
            make_octet_type(topic.type.c_str());  // owned by Cyclone from here on, unless the call fails
        Entity made(
            dds_create_topic_sertype(participant_->get(), topic.name.c_str(), &given, nullptr, nullptr, nullptr));
        if (!made.ok()) {
            problem_ = explain("can't make the topic " + topic.name, made.get());
            ddsi_sertype_unref(given);
        }
        return made;
    }

    void add_seen(dds_entity_t reader, bool writes, std::vector<SeenEndpoint>& all) const {
        constexpr std::uint32_t most = 2048;
        std::vector<void*> samples(most, nullptr);
        std::vector<dds_sample_info_t> infos(most);
        const dds_return_t count = dds_read_mask(reader, samples.data(), infos.data(), most, most,
                                                 DDS_ALIVE_INSTANCE_STATE | DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE);
        dds_guid_t own{};
        dds_get_guid(participant_->get(), &own);
        for (dds_return_t i = 0; i < count; ++i) {
            const auto* endpoint =
                static_cast<const dds_builtintopic_endpoint_t*>(samples[static_cast<std::size_t>(i)]);
            dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
            dds_duration_t longest = 0;
            dds_qget_reliability(endpoint->qos, &kind, &longest);
            all.push_back({endpoint->topic_name, endpoint->type_name, writes, kind == DDS_RELIABILITY_RELIABLE,
                           std::memcmp(endpoint->participant_key.v, own.v, sizeof own.v) == 0});
        }
        if (count > 0) dds_return_loan(reader, samples.data(), count);
    }

    // Members are destroyed in reverse order.
    LastWords words_;
    std::optional<Entity> domain_;
    std::optional<Entity> participant_;
    std::optional<Entity> publications_;
    std::optional<Entity> subscriptions_;
    std::string problem_;
};

}  // namespace
}  // namespace nezumi::dds

extern "C" __attribute__((visibility("default"))) nezumi::dds::DdsTransport* nezumi_open_cyclone(
    const nezumi::dds::DomainOptions& options, std::string& problem) {
    auto opened = std::make_unique<nezumi::dds::Cyclone>();
    problem = opened->open(options);
    return problem.empty() ? opened.release() : nullptr;
}
