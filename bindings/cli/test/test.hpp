// A session of `nezumi test`, from the options to the exit status.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/run/options.hpp"

namespace nezumi::cli {

/// The options as they were typed.
struct TestOptions {
    std::vector<std::string> paths;
    std::string project;  ///< the folder of the project to be tested; "": that of the working directory
    std::string filter;
    bool list = false;
    std::optional<std::uint64_t> seed, repeat, jobs, search;
    std::string junit;
    std::string seeds, paired;
    std::string measures, margins;
    std::string plots, coverage, mutate;
    bool tap = false;
    bool quiet = false;
    std::string shard;
    bool resume = false;
    bool merge = false;
    bool watch = false;
    bool open = false;
    bool show = false;
    RunWords page{};  ///< where --show serves the page
    bool update_goldens = false;
    std::string folder = "nezumi-test";
    bool hw = false;
    std::string rig, dev_root, sys_root;
};

/// Runs scenarios, each in a process of its own, or reports their stored results. Returns the exit status.
int test(TestOptions command);

}  // namespace nezumi::cli
