// What a program without pictures and vision (NEZUMI_SIMULATION=OFF) has instead of its drawings: nothing is taken, and
// each says so.
#include "bindings/cli/calibrate_camera.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/marker_sheet.hpp"
#include "bindings/cli/picture.hpp"
#include "bindings/cli/sweep_plots.hpp"
#include "bindings/cli/wiring_graph.hpp"

namespace nezumi::cli {

PictureOf look_at(const RunningSystem& /*live*/, const Trajectories& /*trajectories*/, std::string /*title*/) {
    return {};
}
Expected<void> draw_picture(PictureOf /*picture*/, const std::string& /*file*/) {
    return failure(std::string(no_simulation));
}

WiringOf wiring_of(const RunningSystem& /*live*/, std::string /*title*/) { return {}; }
Expected<void> draw_wiring(const WiringOf& /*wiring*/, const std::string& /*file*/) {
    return failure(std::string(no_simulation));
}

std::vector<SweepPlot> sweep_plots(const std::vector<MeasuredRun>& /*runs*/) { return {}; }
Expected<void> draw_sweep_plot(const SweepPlot& /*plot*/, const std::filesystem::path& /*folder*/) {
    return failure(std::string(no_simulation));
}

Expected<std::string> marker_pdf(const Paper& /*paper*/, const std::vector<int>& /*ids*/, double /*size*/) {
    return failure(std::string(no_simulation));
}

Expected<IntrinsicsFit> calibrate_camera(const BoardCourse& /*course*/,
                                         const std::function<Expected<TimedPicture>()>& /*next*/,
                                         const std::function<void(const std::string& text)>& /*tell*/) {
    return failure(std::string(no_simulation));
}

}  // namespace nezumi::cli
