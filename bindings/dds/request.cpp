// Plain data from elsewhere is checked before anything is made of it.
#include "bindings/dds/request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <variant>

namespace nezumi::dds {
namespace {

enum Kind : std::uint8_t { nothing, truth, integer, number, text, table };
static_assert(std::variant_size_v<PlainData::Value> == table + 1);

WireValue to_wire(const PlainData::Value& value) {
    WireValue wire;
    wire.kind = static_cast<std::uint8_t>(value.index());
    if (const auto* is = std::get_if<bool>(&value)) wire.integer = *is ? 1 : 0;
    if (const auto* is = std::get_if<std::int64_t>(&value)) wire.integer = *is;
    if (const auto* is = std::get_if<double>(&value)) wire.number = *is;
    if (const auto* is = std::get_if<std::string>(&value)) wire.text = *is;
    if (const auto* is = std::get_if<PlainData::TableRef>(&value)) wire.integer = static_cast<std::int64_t>(is->index);
    return wire;
}

Expected<PlainData::Value> from_wire(WireValue wire, std::size_t tables) {
    switch (wire.kind) {
        case nothing: return PlainData::Value{};
        case truth: return PlainData::Value{wire.integer != 0};
        case integer: return PlainData::Value{wire.integer};
        case number: return PlainData::Value{wire.number};
        case text: return PlainData::Value{std::move(wire.text)};
        case table:
            if (wire.integer < 0 || static_cast<std::uint64_t>(wire.integer) >= tables) break;
            return PlainData::Value{PlainData::TableRef{static_cast<std::size_t>(wire.integer)}};
        default: break;
    }
    return failure("malformed plain data");
}

// What a table of Lua can have as a key.
bool is_key(const PlainData::Value& value) {
    if (const auto* is = std::get_if<double>(&value)) return !std::isnan(*is);
    return value.index() != nothing && value.index() != table;
}

Topic topic(std::string_view host, std::string_view what, std::string_view type) {
    constexpr int most_waiting = 64;
    return {.name = fmt::format("nezumi/{}/{}", host, what),
            .type = fmt::format("nezumi::{}", type),
            .reliable = false,
            .depth = most_waiting};
}

}  // namespace

Topic request_topic(std::string_view host) { return topic(host, "requests", Describe<RemoteRequest>::name); }
Topic reply_topic(std::string_view host) { return topic(host, "replies", Describe<Reply>::name); }

WireData to_wire(const PlainData& data) {
    WireData wire;
    for (const PlainData::Value& value : data.values) wire.values.push_back(to_wire(value));
    for (const PlainData::Table& table : data.tables) {
        WireTable& entries = wire.tables.emplace_back();
        for (const auto& [key, value] : table) {
            entries.entries.push_back(to_wire(key));
            entries.entries.push_back(to_wire(value));
        }
    }
    return wire;
}

Expected<PlainData> from_wire(WireData wire) {
    PlainData data;
    const std::size_t tables = wire.tables.size();
    for (WireValue& each : wire.values) {
        auto value = from_wire(std::move(each), tables);
        if (!value) return Unexpected(value.error());
        data.values.push_back(std::move(*value));
    }
    for (WireTable& each : wire.tables) {
        PlainData::Table& table = data.tables.emplace_back();
        if (each.entries.size() % 2 != 0) return failure("malformed plain data");
        for (std::size_t i = 0; i < each.entries.size(); i += 2) {
            auto key = from_wire(std::move(each.entries[i]), tables);
            auto value = from_wire(std::move(each.entries[i + 1]), tables);
            if (!key || !value || !is_key(*key)) return failure("malformed plain data");
            table.emplace_back(std::move(*key), std::move(*value));
        }
    }
    return data;
}

}  // namespace nezumi::dds
