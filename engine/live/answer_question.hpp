// Answers requests of other hosts about a system.
#pragma once

#include <cstddef>

#include "engine/system/network.hpp"
#include "engine/trace/trace.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {

/// The longest text of a port's value in an answer [characters].
inline constexpr std::size_t watch_width = 100;

/// The data that answers are made from.
struct AskedSystem {
    TreeNode tree;  ///< all names of the system
    Trace& trace;
    ActDoor act;
};

/// Answers a request of `who`. Reading returns data; every other request is an act, which is refused unless `writable`
/// is true.
Expected<PlainData> answer_question(const AskedSystem& asked, const Question& question, bool writable,
                                    const Actor& who);

/// The answer to `Question::What::look`.
struct NodeSnapshot {
    TreeNode::Kind kind{};
    PlainSnapshot value{};  ///< one value for nodes that have values (values, parameters, truth, `config`); else empty
};
Expected<NodeSnapshot> read_snapshot(PlainData data);

}  // namespace nezumi
