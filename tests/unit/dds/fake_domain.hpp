// A domain within one process: what its places write, the others read at once, as DDS would match them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/dds/transport.hpp"

namespace nezumi::dds {

class FakeDomain {
public:
    /// Another place, whose messages are held up while it is cut off.
    std::unique_ptr<DdsTransport> join() { return std::make_unique<Place>(*this); }
    /// Nothing gets through from now on; what is written meanwhile is lost, but for what is kept for who comes late.
    bool cut = false;
    /// Topics that somebody writes or reads now.
    std::vector<std::string> topics() const {
        std::vector<std::string> names;
        for (const auto* end : ends_) names.push_back((end->writes ? "> " : "< ") + end->topic.name);
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    struct End {
        Topic topic;
        bool writes = false;
        std::uint64_t id = 0;
        std::deque<TopicSample> waiting{};  // of a reader
        Octets last{};                      // of a writer
        std::uint64_t lost = 0;
    };
    // Types must be equal, and no reader is promised more than the writer gives.
    static bool match(const End& writer, const End& reader) {
        return writer.writes && !reader.writes && writer.topic.name == reader.topic.name &&
               writer.topic.type == reader.topic.type && (writer.topic.reliable || !reader.topic.reliable) &&
               (writer.topic.keeps_last || !reader.topic.keeps_last);
    }
    static void give(End& reader, const Octets& bytes, std::uint64_t writer) {
        if (reader.topic.admits && !reader.topic.admits(bytes)) return;
        reader.waiting.push_back({bytes, writer});
        if (reader.waiting.size() <= static_cast<std::size_t>(reader.topic.depth)) return;
        reader.waiting.pop_front();
        ++reader.lost;
    }

    class FakeWriter final : public Writer {
    public:
        FakeWriter(FakeDomain& domain, const Topic& topic) : domain_(domain), end_{topic, true, ++domain.last_id_} {
            domain_.ends_.push_back(&end_);
        }
        ~FakeWriter() override { std::erase(domain_.ends_, &end_); }
        bool write(std::span<const std::uint8_t> cdr) override {
            end_.last.assign(cdr.begin(), cdr.end());
            for (End* end : domain_.ends_) {
                if (!domain_.cut && match(end_, *end)) give(*end, end_.last, end_.id);
            }
            return true;
        }
        int readers() const override {
            return static_cast<int>(std::count_if(domain_.ends_.begin(), domain_.ends_.end(),
                                                  [&](const End* end) { return match(end_, *end); }));
        }

    private:
        FakeDomain& domain_;
        End end_;
    };

    class FakeReader final : public Reader {
    public:
        FakeReader(FakeDomain& domain, const Topic& topic) : domain_(domain), end_{topic, false, ++domain.last_id_} {
            domain_.ends_.push_back(&end_);
            for (const End* end : domain_.ends_) {
                if (match(*end, end_) && topic.keeps_last && !end->last.empty()) give(end_, end->last, end->id);
            }
        }
        ~FakeReader() override { std::erase(domain_.ends_, &end_); }
        std::vector<TopicSample> take() override {
            std::vector<TopicSample> all(end_.waiting.begin(), end_.waiting.end());
            end_.waiting.clear();
            return all;
        }
        std::vector<std::uint64_t> writers() const override {
            std::vector<std::uint64_t> ids;
            for (const End* end : domain_.ends_) {
                if (match(*end, end_)) ids.push_back(end->id);
            }
            return ids;
        }
        std::uint64_t lost() const override { return end_.lost; }

    private:
        FakeDomain& domain_;
        End end_;
    };

    class Place final : public DdsTransport {
    public:
        explicit Place(FakeDomain& domain) : domain_(domain) {}
        // As DDS, which has no topics of other names.
        static bool is_name(const Topic& topic) {
            return topic.name.find_first_not_of("0123456789_/ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz") ==
                   std::string::npos;
        }
        std::unique_ptr<Writer> write(const Topic& topic) override {
            return is_name(topic) ? std::make_unique<FakeWriter>(domain_, topic) : nullptr;
        }
        std::unique_ptr<Reader> read(const Topic& topic) override {
            return is_name(topic) ? std::make_unique<FakeReader>(domain_, topic) : nullptr;
        }
        std::vector<SeenEndpoint> seen() override {
            std::vector<SeenEndpoint> all;
            for (const End* end : domain_.ends_)
                all.push_back({end->topic.name, end->topic.type, end->writes, end->topic.reliable, false});
            return all;
        }
        std::string problem() const override { return "there is no such topic"; }

    private:
        FakeDomain& domain_;
    };

    std::vector<End*> ends_;
    std::uint64_t last_id_ = 0;
};

}  // namespace nezumi::dds
