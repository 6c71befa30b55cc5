// What one host asks of another's components, and the answer, as they travel.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"
#include "engine/components/plain_data.hpp"
#include "engine/ports/describe.hpp"

namespace nezumi::dds {

/// A value of plain data, or a reference to a table.
struct WireValue {
    std::uint8_t kind = 0;     ///< place in `PlainData::Value`
    std::int64_t integer = 0;  ///< also of a truth value, and the place of a table
    double number = 0;
    std::string text{};
};

struct WireTable {
    std::vector<WireValue> entries{};  ///< a key, its value, a key, ...
};

struct WireData {
    std::vector<WireValue> values{};
    std::vector<WireTable> tables{};
};

struct RemoteRequest {
    std::uint64_t from = 0;    ///< run of who asks
    std::uint64_t to = 0;      ///< run of who is asked: another start of that host is another host
    std::uint64_t number = 0;  ///< of the request in its run, from 1 on
    std::uint8_t what = 0;     ///< `Question::What`
    std::string component{};
    std::string name{};
    WireData values{};
};

struct Reply {
    std::uint64_t to = 0;      ///< run of who asked
    std::uint64_t number = 0;  ///< of the request
    bool well = false;
    std::string problem{};  ///< when not
    WireData values{};
};

/// Requests to a host, and replies to it. Best effort: what is lost is asked again, and nothing waits in a broken link
/// to be done when it heals.
Topic request_topic(std::string_view host);
Topic reply_topic(std::string_view host);

WireData to_wire(const PlainData& data);
/// An error when it is none: what came from elsewhere.
Expected<PlainData> from_wire(WireData wire);

}  // namespace nezumi::dds

namespace nezumi {

template <>
struct Describe<dds::WireValue> {
    using T = dds::WireValue;
    static constexpr std::string_view name = "WireValue";
    static constexpr std::tuple fields{
        Field{"kind", &T::kind, "", "nothing, truth value, integer, number, text, table"},
        Field{"integer", &T::integer, "", ""},
        Field{"number", &T::number, "", ""},
        Field{"text", &T::text, "", ""},
    };
};

template <>
struct Describe<dds::WireTable> {
    static constexpr std::string_view name = "WireTable";
    static constexpr std::tuple fields{Field{"entries", &dds::WireTable::entries, "", "keys and values by turns"}};
};

template <>
struct Describe<dds::WireData> {
    static constexpr std::string_view name = "WireData";
    static constexpr std::tuple fields{
        Field{"values", &dds::WireData::values, "", ""},
        Field{"tables", &dds::WireData::tables, "", "that values refer to"},
    };
};

template <>
struct Describe<dds::RemoteRequest> {
    using T = dds::RemoteRequest;
    static constexpr std::string_view name = "Request";
    static constexpr std::tuple fields{
        Field{"from", &T::from, "", "run of who asks"},
        Field{"to", &T::to, "", "run of who is asked"},
        Field{"number", &T::number, "", "in its run, from 1 on"},
        Field{"what", &T::what, "", "is asked"},
        Field{"component", &T::component, "", "of whom"},
        Field{"name", &T::name, "", "of a set, parameter or command"},
        Field{"values", &T::values, "", "of the parameter, or arguments"},
    };
};

template <>
struct Describe<dds::Reply> {
    using T = dds::Reply;
    static constexpr std::string_view name = "Reply";
    static constexpr std::tuple fields{
        Field{"to", &T::to, "", "run of who asked"},
        Field{"number", &T::number, "", "of the request"},
        Field{"well", &T::well, "", "it was done"},
        Field{"problem", &T::problem, "", "or why not"},
        Field{"values", &T::values, "", "that it has come to"},
    };
};

}  // namespace nezumi
