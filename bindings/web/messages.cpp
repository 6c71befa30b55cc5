// Turns any input into a message, or an error line.
#include "bindings/web/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/console/protocol.hpp"
#include "bindings/journal/act_json.hpp"
#include "engine/base/visible.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

// The deepest nesting of a valid message.
constexpr int deepest = 32;
constexpr std::size_t longest_shown = 160;

constexpr std::array<std::string_view, 6> time_names{"pause", "resume", "step", "speed", "restart", "quit"};
constexpr std::array<std::string_view, 7> test_names{"list", "run", "stop", "open", "watch", "recordings", "judge"};
constexpr std::array<std::string_view, 7> edit_names{"list", "read", "check", "save", "versions", "version", "words"};

// The nesting is limited because functions that use parsed values are recursive; the parser itself is not.
bool is_too_deep(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (quoted) {
            if (text[i] == '\\')
                ++i;
            else if (text[i] == '"')
                quoted = false;
            continue;
        }
        if (text[i] == '"') quoted = true;
        if ((text[i] == '[' || text[i] == '{') && ++depth > deepest) return true;
        if (text[i] == ']' || text[i] == '}') --depth;
    }
    return false;
}

std::string cut(std::string text) {
    if (text.size() <= longest_shown) return text;
    text.resize(longest_shown);
    return text + "...";
}

std::string dump_ascii(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

// Reads the fields of a message; keeps the first error.
class Fields {
public:
    explicit Fields(const Json& json) : json_(json) {}

    const Json* find(const char* name) const {
        const auto found = json_.find(name);
        return found != json_.end() ? &*found : nullptr;
    }
    std::string text(const char* name) {
        const Json* value = find(name);
        if (value != nullptr && value->is_string()) return value->get<std::string>();
        wrong(name, "a string");
        return "";
    }
    bool flag(const char* name) {
        const Json* value = find(name);
        if (value == nullptr) return false;
        if (value->is_boolean()) return value->get<bool>();
        wrong(name, "true or false");
        return false;
    }
    double number(const char* name) {
        const Json* value = find(name);
        if (value != nullptr && value->is_number()) return value->get<double>();
        wrong(name, "a number");
        return 0;
    }
    std::vector<std::string> texts(const char* name) {
        const Json* value = find(name);
        std::vector<std::string> texts;
        if (value == nullptr) return texts;
        const bool good = value->is_array() && value->size() <= most_watched &&
                          std::all_of(value->begin(), value->end(), [](const Json& each) { return each.is_string(); });
        if (!good) {
            wrong(name, fmt::format("a list of at most {} strings", most_watched));
            return texts;
        }
        for (const Json& each : *value) texts.push_back(each.get<std::string>());
        return texts;
    }
    void wrong(std::string_view name, std::string_view expected) {
        if (problem_.empty()) problem_ = fmt::format("'{}' must be {}", name, expected);
    }
    void refuse(std::string why) {
        if (problem_.empty()) problem_ = std::move(why);
    }
    const std::string& problem() const { return problem_; }

private:
    const Json& json_;
    std::string problem_;
};

Watch read_watch(Fields& fields) {
    return {.ports = fields.texts("ports"),
            .truth = fields.flag("truth"),
            .rays = fields.flag("rays"),
            .peers = fields.flag("peers"),
            .pictures = fields.texts("pictures"),
            .members = fields.texts("members")};
}

// A value as text for people: `{ x = 0.1, y = 0 }`, `{ 1, 2 }`, `mouse`.
std::string value_in_words(const Json& value) {
    if (value.is_string()) return visible(value.get<std::string>());
    if (!value.is_structured()) return dump_ascii(value);
    std::string text;
    for (const auto& [name, each] : value.items()) {
        text += text.empty() ? " " : ", ";
        if (value.is_object()) text += visible(name) + " = ";
        text += value_in_words(each);
    }
    return "{" + text + (text.empty() ? "}" : " }");
}

// An act as text for people: "set parameter controller, speed_x, 0.5" for SetParameter and its fields.
std::string shown_act(std::string_view name, const Json& fields) {
    std::string text = act_in_words(name);
    const char* between = " ";
    for (const auto& [field, value] : fields.items()) {
        if (value.is_null() || value == false) continue;
        text += between + (value == true ? field : value_in_words(value));
        between = ", ";
    }
    return text;
}

ActMessage read_act(Fields& fields, const PartReader& parts) {
    const std::string name = fields.text("act");
    const Json* given = fields.find("fields");
    const Json none = Json::object();
    if (given == nullptr) given = &none;
    if (!fields.problem().empty()) return {};
    auto act = act_from_json(name, *given, parts);
    if (!act) {
        fields.refuse(act.error().message);
        return {};
    }
    return {.act = std::move(*act), .shown = cut(shown_act(name, *given))};
}

TimeMessage read_time(Fields& fields) {
    const std::string what = fields.text("what");
    const auto* const found = std::find(time_names.begin(), time_names.end(), what);
    if (found == time_names.end()) {
        fields.wrong("what", fmt::format("one of {}", fmt::join(time_names, ", ")));
        return {};
    }
    TimeMessage time{.what = static_cast<TimeMessage::What>(found - time_names.begin())};
    const Json* value = fields.find("value");
    if (value == nullptr || value->is_null()) return time;
    if (value->is_number()) {
        time.value = value->get<double>();
    } else if (*value == "max") {
        time.value = std::numeric_limits<double>::infinity();
    } else {
        fields.wrong("value", "a number, or \"max\"");
    }
    return time;
}

DriveMessage read_drive(Fields& fields, const PartReader& parts) {
    DriveMessage drive{.port = fields.text("port"), .value = {}, .take = fields.flag("take")};
    const Json* value = fields.find("value");
    if (value == nullptr || value->is_null() || !fields.problem().empty()) return drive;
    const auto held = act_from_json("Hold", Json{{"port", drive.port}, {"value", *value}, {"take", drive.take}}, parts);
    if (!held) {
        fields.refuse(held.error().message);
        return drive;
    }
    drive.value = std::get<Hold>(*held).value;
    return drive;
}

EditMessage read_edit(Fields& fields) {
    using What = EditMessage::What;
    const std::string what = fields.text("what");
    const auto* const found = std::find(edit_names.begin(), edit_names.end(), what);
    if (found == edit_names.end()) {
        fields.wrong("what", fmt::format("one of {}", fmt::join(edit_names, ", ")));
        return {};
    }
    EditMessage edit{.what = static_cast<What>(found - edit_names.begin())};
    if (edit.what == What::list || edit.what == What::words) return edit;
    edit.file = fields.text("file");
    if (edit.what == What::check || edit.what == What::save) edit.text = fields.text("text");
    if (edit.what == What::save) edit.mark = fields.text("mark");
    if (edit.what == What::version) {
        const Json* number = fields.find("number");
        const bool good = number != nullptr && number->is_number_integer() && *number > 0 &&
                          *number <= std::numeric_limits<int>::max();
        if (good)
            edit.number = number->get<int>();
        else
            fields.wrong("number", "a whole number from 1");
    }
    return edit;
}

TestMessage read_test(Fields& fields) {
    const std::string what = fields.text("what");
    const auto* const found = std::find(test_names.begin(), test_names.end(), what);
    if (found == test_names.end()) {
        fields.wrong("what", fmt::format("one of {}", fmt::join(test_names, ", ")));
        return {};
    }
    TestMessage test{.what = static_cast<TestMessage::What>(found - test_names.begin())};
    if (test.what == TestMessage::What::open || fields.find("file") != nullptr) test.file = fields.text("file");
    if (fields.find("name") != nullptr) test.name = fields.text("name");
    return test;
}

ConsoleMessage read_console(Fields& fields) {
    const Json* given = fields.find("request");
    if (given == nullptr || !given->is_object()) {
        fields.wrong("request", "an object");
        return {};
    }
    const auto request = read_request(dump_ascii(*given));
    if (!request) {
        fields.refuse(request.error().message);
        return {};
    }
    if (request->kind == Request::Kind::hello) {
        fields.refuse("a console request of a browser can't be \"hello\"");
        return {};
    }
    const bool evaluates = request->kind == Request::Kind::eval;
    return {.line = to_line(*request), .shown = evaluates ? cut(request->text) : ""};
}

constexpr std::array<std::pair<std::string_view, PeerRequest::What>, 9> peer_verbs{
    {{"activate", PeerRequest::What::activate},
     {"deactivate", PeerRequest::What::deactivate},
     {"reset", PeerRequest::What::reset},
     {"use", PeerRequest::What::use},
     {"configure", PeerRequest::What::configure},
     {"exit", PeerRequest::What::exit},
     {"forget", PeerRequest::What::forget},
     {"connect", PeerRequest::What::connect},
     {"disconnect", PeerRequest::What::disconnect}}};

PeerMessage read_peer(Fields& fields, const Json& json, const PartReader& parts) {
    const std::string what = fields.text("what");
    const auto* const verb =
        std::find_if(peer_verbs.begin(), peer_verbs.end(), [&](const auto& each) { return each.first == what; });
    if (verb == peer_verbs.end()) {
        std::vector<std::string_view> names;
        names.reserve(peer_verbs.size());
        for (const auto& [name, number] : peer_verbs) names.push_back(name);
        fields.wrong("what", fmt::format("one of {}", fmt::join(names, ", ")));
        return {};
    }
    PeerMessage message{.request = {.what = verb->second}};
    const bool is_of_ports = what == "connect" || what == "disconnect";
    for (auto [name, text] : {std::pair{"name", &message.request.name}, std::pair{"set", &message.request.set},
                              std::pair{"from", &message.request.from}, std::pair{"to", &message.request.to}}) {
        const bool is_needed = is_of_ports
                                   ? text == &message.request.from || text == &message.request.to
                                   : text == &message.request.name || (what == "use" && text == &message.request.set);
        if (!is_needed) continue;
        *text = fields.text(name);
        if (text->empty()) fields.wrong(name, "a string");
    }
    if (what == "configure") {
        const auto set = act_from_json("SetParameter",
                                       Json{{"component", message.request.name},
                                            {"parameter", fields.text("parameter")},
                                            {"value", json.value("value", Json())}},
                                       parts);
        if (!set) {
            fields.refuse(set.error().message);
            return {};
        }
        const auto& given = std::get<SetParameter>(*set);
        const Type& single = given.value.type().single();
        const bool is_plain = single.is_integer() || single.is_floating() || single.kind == Type::Kind::boolean ||
                              single.kind == Type::Kind::text;
        if (!is_plain) {
            fields.wrong("value", "a number, a string, a boolean, or a list of one of these types");
            return {};
        }
        message.request.values.emplace(given.parameter, given.value);
    }
    Json shown = json;
    for (const char* known : {"do", "id", "what"}) shown.erase(known);
    message.shown = cut(what + " " + dump_ascii(shown));
    return message;
}

struct Given {
    Fields& fields;
    const Json& json;
    const PartReader& parts;
};
using Body = decltype(BrowserMessage::body);
struct Kind {
    std::string_view name;
    Body (*read)(const Given& given);
};
constexpr std::array kinds{
    Kind{"watch", [](const Given& given) -> Body { return read_watch(given.fields); }},
    Kind{"act", [](const Given& given) -> Body { return read_act(given.fields, given.parts); }},
    Kind{"stop", [](const Given&) -> Body { return ActMessage{.act = Stop{}, .shown = "stop"}; }},
    Kind{"rearm", [](const Given&) -> Body { return ActMessage{.act = Rearm{}, .shown = "rearm"}; }},
    Kind{"time", [](const Given& given) -> Body { return read_time(given.fields); }},
    Kind{"drive", [](const Given& given) -> Body { return read_drive(given.fields, given.parts); }},
    Kind{"console", [](const Given& given) -> Body { return read_console(given.fields); }},
    Kind{"floor", [](const Given&) -> Body { return FloorMessage{}; }},
    Kind{"explain", [](const Given& given) -> Body { return ExplainMessage{given.fields.text("component")}; }},
    Kind{"remembered",
         [](const Given& given) -> Body {
             RememberedMessage wanted{.branch = given.fields.text("branch"), .rows = given.fields.flag("rows")};
             if (given.fields.find("port") != nullptr) wanted.port = given.fields.text("port");
             return wanted;
         }},
    Kind{"then",
         [](const Given& given) -> Body {
             return ThenMessage{.at = given.fields.number("at"), .names = given.fields.texts("names")};
         }},
    Kind{"earlier", [](const Given& given) -> Body { return EarlierMessage{given.fields.text("port")}; }},
    Kind{"systems", [](const Given&) -> Body { return SystemsMessage{}; }},
    Kind{"edit", [](const Given& given) -> Body { return read_edit(given.fields); }},
    Kind{"test", [](const Given& given) -> Body { return read_test(given.fields); }},
    Kind{"peer", [](const Given& given) -> Body { return read_peer(given.fields, given.json, given.parts); }},
};

}  // namespace

tl::expected<BrowserMessage, Refusal> read_message(std::string_view text, const PartReader& parts) {
    BrowserMessage message;
    const auto refuse = [&](std::string why) {
        return tl::unexpected(Refusal{.id = message.id, .text = std::move(why)});
    };
    if (is_too_deep(text)) return refuse("the message is nested too deeply");
    const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
    if (!json.is_object()) return refuse("expected one JSON object");
    if (const auto id = json.find("id"); id != json.end()) {
        // The largest integer that JavaScript's double holds exactly.
        constexpr std::int64_t most = std::int64_t{1} << 53;
        if (!id->is_number_integer() || (id->is_number_unsigned() && id->get<std::uint64_t>() > most) ||
            id->get<std::int64_t>() < -most)
            return refuse("'id' must be a whole number");
        message.id = id->get<std::int64_t>();
    }
    Fields fields(json);
    const std::string what = fields.text("do");
    const auto* const kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& each) { return each.name == what; });
    if (kind == kinds.end()) {
        std::vector<std::string_view> names;
        names.reserve(kinds.size());
        for (const Kind& each : kinds) names.push_back(each.name);
        fields.wrong("do", fmt::format("one of {}", fmt::join(names, ", ")));
    } else {
        message.body = kind->read({fields, json, parts});
    }
    if (!fields.problem().empty()) return refuse(fields.problem());
    return message;
}

}  // namespace nezumi::web
