// Queries about a machine: kernel files, device nodes, and the programs that have them open.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tl/expected.hpp>
#include <vector>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// The first line of a kernel file without its line end; "" if it can't be read.
std::string first_line(const std::string& path);

/// The names in a folder, sorted; empty if it can't be read.
std::vector<std::string> names_in(const std::string& folder);

/// The result of `query`, if it comes within one second. A query that hangs in the kernel is abandoned and may end
/// later, so it must own everything that it uses.
template <class Query>
std::optional<std::invoke_result_t<Query>> in_time(Query query) {
    using Result = std::invoke_result_t<Query>;
    auto promise = std::make_shared<std::promise<Result>>();
    std::future<Result> answer = promise->get_future();
    std::thread([promise, query = std::move(query)] { promise->set_value(query()); }).detach();
    if (answer.wait_for(std::chrono::seconds(1)) != std::future_status::ready) return std::nullopt;
    return answer.get();
}

/// Tries to open a device node. Returns 0, an errno, or ETIMEDOUT if the device does not answer.
int opening_fails_with(const std::string& path, Node::Access access);

/// Reads a device node once. Returns the text, an errno, or ETIMEDOUT.
tl::expected<std::string, int> ask(const std::string& path);

/// A program that has files open.
struct Holder {
    int process = 0;
    std::string name;                ///< "python3"; "" if unknown
    std::vector<std::string> files;  ///< those of the given files that it has open, in their order
};

/// The other programs that have any of these files open, as far as this user may see them. A child of such a program
/// (as the guard of nezumi) ends with it and is left out.
std::vector<Holder> holders_of(const std::vector<std::string>& files, const std::string& proc);

/// How this user can get access to a device node that a group may use: "sudo adduser $USER dialout, then log in again".
/// "" if no group of /etc/group has access.
std::string group_that_may(const std::string& path);

/// "a, b and c".
std::string listed(const std::vector<std::string>& names);

}  // namespace nezumi::hw
