// Replaces the functions for pictures and vision in a program without them (NEZUMI_SIMULATION=OFF): they return an
// error or nothing.
#include "bindings/cli/base/environment.hpp"
#include "bindings/draw/marker_sheet.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/sweep_plot.hpp"
#include "bindings/draw/wiring_graph.hpp"
#include "engine/vision/checked_image.hpp"
#include "hw/calibrate/camera.hpp"
#include "sim/picture.hpp"

namespace nezumi::draw {

PictureOf look_at(const RunningSystem& /*live*/, const Trajectories& /*trajectories*/, std::string /*title*/) {
    return {};
}
Expected<void> draw_picture(PictureOf /*picture*/, const std::string& /*file*/, const PictureReader& /*read*/) {
    return failure(std::string(cli::no_simulation));
}

WiringOf wiring_of(const RunningSystem& /*live*/, std::string /*title*/) { return {}; }
Expected<void> draw_wiring(const WiringOf& /*wiring*/, const std::string& /*file*/) {
    return failure(std::string(cli::no_simulation));
}

Expected<void> draw_sweep_plot(const SweepPlot& /*plot*/, const std::filesystem::path& /*folder*/) {
    return failure(std::string(cli::no_simulation));
}

Expected<std::string> marker_pdf(const Paper& /*paper*/, const std::vector<PrintedTag>& /*tags*/, double /*size*/) {
    return failure(std::string(cli::no_simulation));
}

}  // namespace nezumi::draw
namespace nezumi::sim {

Expected<Picture> read_picture(const std::string& /*file*/) { return failure(std::string(cli::no_simulation)); }
Picture paint_tag(int /*id*/) { return {}; }

}  // namespace nezumi::sim
namespace nezumi {

Expected<JpegPicture> to_jpeg(const CameraImage& /*image*/) { return failure(std::string(cli::no_simulation)); }

}  // namespace nezumi
namespace nezumi::hw {

Expected<IntrinsicsFit> calibrate_camera(const BoardCourse& /*course*/,
                                         const std::function<Expected<TimedPicture>()>& /*next*/,
                                         const std::function<void(const std::string& text)>& /*tell*/) {
    return failure(std::string(cli::no_simulation));
}

}  // namespace nezumi::hw
