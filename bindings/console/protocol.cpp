// Reads a line without trusting it: each line gives a request, or an error with the reason.
#include "bindings/console/protocol.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/json_text.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::json;

// The names of requests and events, in the order of the enumerators.
constexpr std::array<std::string_view, 6> request_names{"hello", "eval", "complete", "is_complete", "interrupt", "key"};
constexpr std::array<std::string_view, 9> event_names{"answer", "completions", "output", "error", "log",
                                                      "keys",   "status",      "lost",   "bye"};

std::string dump(const Json& json) { return json_text(json) + "\n"; }

// Reads the value of a field, or the default; remembers a value of a wrong type.
class MessageFields {
public:
    explicit MessageFields(const Json& json) : json_(json) {}

    std::string text(const char* name) {
        const Json* value = find(name);
        if (value == nullptr) return "";
        if (value->is_string()) return value->get_ref<const std::string&>();
        wrong(name, "a string");
        return "";
    }
    bool flag(const char* name, bool otherwise) {
        const Json* value = find(name);
        if (value == nullptr) return otherwise;
        if (value->is_boolean()) return value->get<bool>();
        wrong(name, "true or false");
        return otherwise;
    }
    std::int64_t whole(const char* name) {
        const Json* value = find(name);
        if (value == nullptr) return 0;
        if (value->is_number_integer() && (!value->is_number_unsigned() || value->get<std::uint64_t>() <= INT64_MAX))
            return value->get<std::int64_t>();
        wrong(name, "a whole number");
        return 0;
    }
    std::size_t count(const char* name) {
        const std::int64_t value = whole(name);
        if (value < 0) wrong(name, "a number that is not negative");
        return static_cast<std::size_t>(std::max<std::int64_t>(value, 0));
    }
    std::vector<std::string> texts(const char* name) {
        const Json* value = find(name);
        std::vector<std::string> texts;
        if (value == nullptr) return texts;
        if (!value->is_array()) wrong(name, "a list of strings");
        for (const Json& item : *value) {
            if (!item.is_string()) {
                wrong(name, "a list of strings");
                break;
            }
            texts.push_back(item.get_ref<const std::string&>());
        }
        return texts;
    }
    template <std::size_t Count>
    std::size_t one_of(const char* name, const std::array<std::string_view, Count>& names) {
        const std::string value = text(name);
        const auto found = std::find(names.begin(), names.end(), value);
        if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
        std::string expected = "one of";
        for (const std::string_view known : names) expected.append(" ").append(known);
        wrong(name, expected);
        return 0;
    }
    const std::string& problem() const { return problem_; }

private:
    const Json* find(const char* name) const {
        const auto found = json_.find(name);
        return found != json_.end() ? &*found : nullptr;
    }
    void wrong(const char* name, const std::string& expected) {
        if (problem_.empty()) problem_ = std::string("'") + name + "' must be " + expected;
    }

    const Json& json_;
    std::string problem_;
};

Expected<Json> read_object(std::string_view line) {
    Json json = Json::parse(line.begin(), line.end(), nullptr, false);
    if (!json.is_object()) return failure("expected one JSON object on a line, got " + shown(line.substr(0, 100)));
    return json;
}

}  // namespace

std::string to_line(const Request& request) {
    Json json{{"do", request_names[static_cast<std::size_t>(request.kind)]}};
    if (request.id != 0) json["id"] = request.id;
    if (!request.text.empty()) json["text"] = request.text;
    if (request.kind == Request::Kind::complete) json["cursor"] = request.cursor;
    if (request.log) json["log"] = true;
    if (request.keys) json["keys"] = true;
    if (!request.who.empty()) json["who"] = request.who;
    return dump(json);
}

std::string to_line(const Event& event) {
    Json json{{"is", event_names[static_cast<std::size_t>(event.kind)]}};
    if (event.id != 0) json["id"] = event.id;
    if (!event.ok || event.kind == Event::Kind::answer) json["ok"] = event.ok;
    if (!event.text.empty()) json["text"] = event.text;
    if (!event.level.empty()) json["level"] = event.level;
    if (event.from != 0) json["from"] = event.from;
    if (event.count != 0) json["count"] = event.count;
    if (!event.items.empty()) json["items"] = event.items;
    return dump(json);
}

Expected<Request> read_request(std::string_view line) {
    const auto json = read_object(line);
    if (!json) return Unexpected(json.error());
    MessageFields fields(*json);
    Request request;
    request.kind = static_cast<Request::Kind>(fields.one_of("do", request_names));
    request.id = fields.whole("id");
    request.text = fields.text("text");
    if (request.kind == Request::Kind::complete)
        request.cursor = json->contains("cursor") ? fields.count("cursor") : request.text.size();
    request.log = fields.flag("log", false);
    request.keys = fields.flag("keys", false);
    request.who = fields.text("who");
    if (!fields.problem().empty()) return failure(fields.problem());
    if (request.cursor > request.text.size()) return failure("'cursor' lies behind the end of 'text'");
    return request;
}

Expected<Event> read_event(std::string_view line) {
    const auto json = read_object(line);
    if (!json) return Unexpected(json.error());
    MessageFields fields(*json);
    Event event;
    event.kind = static_cast<Event::Kind>(fields.one_of("is", event_names));
    event.id = fields.whole("id");
    event.ok = fields.flag("ok", true);
    event.text = fields.text("text");
    event.level = fields.text("level");
    event.from = fields.count("from");
    event.count = fields.count("count");
    event.items = fields.texts("items");
    if (!fields.problem().empty()) return failure(fields.problem());
    return event;
}

void LineReader::feed(std::string_view piece) {
    piece_ = piece;
    at_ = 0;
}

std::optional<Expected<std::string>> LineReader::next() {
    const std::size_t end = piece_.find('\n', at_);
    const std::string_view part = std::string_view(piece_).substr(at_, end - at_);
    if (begun_.size() + part.size() > limit_) {
        too_long_ = true;
        begun_.clear();
    }
    if (!too_long_) begun_ += part;
    if (end == std::string::npos) {
        at_ = piece_.size();
        return std::nullopt;
    }
    at_ = end + 1;
    if (std::exchange(too_long_, false))
        return failure("a line of more than " + std::to_string(limit_) + " bytes was left out");
    return std::exchange(begun_, {});
}

}  // namespace nezumi
