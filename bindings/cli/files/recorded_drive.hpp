// Messages that a component got and wrote, from the topics of a recording.
#pragma once

#include <map>
#include <string>

#include "bindings/cli/files/recorded_topics.hpp"
#include "bindings/journal/drive.hpp"
#include "bindings/record/mcap_reader.hpp"
#include "engine/base/error.hpp"
#include "engine/components/component.hpp"

namespace nezumi::cli {

/// Topics by names of ports: the key "rays" and the value "/scan" for "--map /scan=keeper.rays".
using TopicsOfPorts = std::map<std::string, std::string, std::less<>>;

/// Fills `drive` (whose entry and rate are set) with the messages of the ports of `behavior`, from the topics of
/// `topics`, else from "/COMPONENT/PORT". `name` is the file's name. An error if a port or a topic of `topics` does not
/// exist, if an in-port or all out-ports are not recorded, or if a topic has another type than its port.
Expected<void> read_drive(RecordedDrive& drive, const record::McapFile& recording, const TopicReader& reader,
                          const std::string& name, const Component& behavior, const TopicsOfPorts& topics);

/// Sets the parameters to those of the topic "/COMPONENT/config". An empty array stays as it is, because a recording
/// does not contain it.
void read_parameters(RecordedDrive& drive, const record::McapFile& recording, const TopicReader& reader,
                     const Component& behavior);

}  // namespace nezumi::cli
