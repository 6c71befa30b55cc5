// Limits the arguments of a command, so that no tick is delayed.
#include "bindings/lua/live/command_arguments.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "bindings/lua/values/plain_data.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

constexpr Budget copy_budget{1.0};  // for copying arguments

// Limits of arguments: the ticking thread copies them into the script's state, which takes 0.3 us for each value.
constexpr std::size_t most_given = 10'000;        // values
constexpr std::size_t most_text_given = 1 << 20;  // bytes

Expected<void> check_size(const PlainData& data, std::string_view command) {
    std::size_t count = data.values.size();
    for (const PlainData::Table& table : data.tables) count += table.size();
    const std::size_t text = text_bytes(data);
    if (count > most_given)
        return failure(fmt::format("command '{}' got {} values: at most {} are allowed, so that no tick is late",
                                   command, count, most_given));
    if (text > most_text_given)
        return failure(fmt::format("command '{}' got {} bytes of text: at most {} are allowed, so that no tick is late",
                                   command, text, most_text_given));
    return {};
}

}  // namespace

Expected<PlainData> read_arguments(lua_State* L, std::string_view command) {
    const int count = lua_gettop(L) - 1;
    std::vector<std::string> names;
    for (int i = 1; i <= count; ++i) names.push_back(fmt::format("argument {}", i));
    std::vector<Dropped> dropped;
    auto arguments = take_plain(L, count, copy_budget, names, dropped);
    if (!arguments) return Unexpected(arguments.error());
    if (dropped.empty()) {
        if (auto fits = check_size(*arguments, command); !fits) return Unexpected(fits.error());
        return std::move(*arguments);
    }
    return failure(fmt::format("command '{}': {} is {}, and only plain data can be given", command,
                               dropped.front().path, dropped.front().what));
}

}  // namespace nezumi
