// What one host asks of another's components, and the answer, as they travel.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"
#include "engine/components/plain_data.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::dds {

/// A value of plain data, or a reference to a table.
struct WireValue {
    std::uint8_t kind = 0;     ///< place in `PlainData::Value`
    std::int64_t integer = 0;  ///< also of a truth value, and the place of a table
    double number = 0;
    std::string text{};

    static constexpr std::tuple fields{
        Field{"kind", &WireValue::kind, "", "nothing, truth value, integer, number, text, table"},
        Field{"integer", &WireValue::integer, "", ""},
        Field{"number", &WireValue::number, "", ""},
        Field{"text", &WireValue::text, "", ""},
    };
};

struct WireTable {
    std::vector<WireValue> entries{};  ///< a key, its value, a key, ...

    static constexpr std::tuple fields{Field{"entries", &dds::WireTable::entries, "", "keys and values by turns"}};
};

struct WireData {
    std::vector<WireValue> values{};
    std::vector<WireTable> tables{};

    static constexpr std::tuple fields{
        Field{"values", &dds::WireData::values, "", ""},
        Field{"tables", &dds::WireData::tables, "", "that values refer to"},
    };
};

struct RemoteRequest {
    std::uint64_t from = 0;    ///< run of who asks
    std::uint64_t to = 0;      ///< run of who is asked: another start of that host is another host
    std::uint64_t number = 0;  ///< of the request in its run, from 1 on
    std::uint8_t what = 0;     ///< `Question::What`
    std::string component{};
    std::string name{};
    WireData values{};

    static constexpr std::string_view type_name = "Request";
    static constexpr std::tuple fields{
        Field{"from", &RemoteRequest::from, "", "run of who asks"},
        Field{"to", &RemoteRequest::to, "", "run of who is asked"},
        Field{"number", &RemoteRequest::number, "", "in its run, from 1 on"},
        Field{"what", &RemoteRequest::what, "", "is asked"},
        Field{"component", &RemoteRequest::component, "", "of whom"},
        Field{"name", &RemoteRequest::name, "", "of a set, parameter or command"},
        Field{"values", &RemoteRequest::values, "", "of the parameter, or arguments"},
    };
};

struct Reply {
    std::uint64_t to = 0;      ///< run of who asked
    std::uint64_t number = 0;  ///< of the request
    bool well = false;
    std::string problem{};  ///< when not
    WireData values{};

    static constexpr std::tuple fields{
        Field{"to", &Reply::to, "", "run of who asked"},
        Field{"number", &Reply::number, "", "of the request"},
        Field{"well", &Reply::well, "", "it was done"},
        Field{"problem", &Reply::problem, "", "or why not"},
        Field{"values", &Reply::values, "", "that it has come to"},
    };
};

/// Requests to a host, and replies to it. Best effort: what is lost is asked again, and nothing waits in a broken link
/// to be done when it heals.
Topic request_topic(std::string_view host);
Topic reply_topic(std::string_view host);

WireData to_wire(const PlainData& data);
/// An error when it is none: what came from elsewhere.
Expected<PlainData> from_wire(WireData wire);

}  // namespace nezumi::dds
