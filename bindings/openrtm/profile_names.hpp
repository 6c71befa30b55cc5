// Names that the reader and the writer of a component's profile share.
#pragma once

#include <array>
#include <string_view>

namespace nezumi::openrtm {

// Names of port properties that OpenRTM does not define.
inline constexpr const char* queue_property = "nezumi.queue";
inline constexpr const char* safe_property = "nezumi.safe";

/// A callback of OpenRTM, and its name in nezumi; "" if nezumi does not have it.
struct ProfileCallback {
    const char* element;
    std::string_view name = "";
};
/// All callbacks, in the order of a profile.
inline constexpr std::array<ProfileCallback, 14> known_callbacks{{{"OnInitialize"},
                                                                  {"OnFinalize"},
                                                                  {"OnStartup"},
                                                                  {"OnShutdown"},
                                                                  {"OnActivated", "on_activated"},
                                                                  {"OnDeactivated", "on_deactivated"},
                                                                  {"OnAborting", "on_aborting"},
                                                                  {"OnError", "on_error"},
                                                                  {"OnReset", "on_reset"},
                                                                  {"OnExecute", "on_execute"},
                                                                  {"OnStateUpdate"},
                                                                  {"OnRateChanged"},
                                                                  {"OnAction"},
                                                                  {"OnModeChanged"}}};

}  // namespace nezumi::openrtm
