// Loads the module.
#include "bindings/web/jpeg.hpp"

#include "engine/base/module.hpp"

namespace nezumi::web {

Expected<Octets> to_jpeg(const CameraImage& picture) {
    static const auto encodes = load_function({.file = jpeg_module,
                                               .function = encode_in_module,
                                               .part = "cameras' pictures in browsers",
                                               .needs = "libopencv-imgcodecs406"});
    if (!encodes) return failure(encodes.error().message);
    Octets jpeg;
    std::string problem;
    if (!reinterpret_cast<EncodeInModule*>(*encodes)(picture, jpeg, problem)) return failure(problem);
    return jpeg;
}

}  // namespace nezumi::web
