// Reads anything as a floor's picture: what comes out has as many pixels as it says, or an error is one line.
#include "sim/picture.hpp"

#include "tests/fuzz/memory_file.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MemoryFile file;
    file.hold(data, size);
    const auto picture = sim::read_picture(file.path());
    if (!picture) {
        require_line(picture.error().message);
        return 0;
    }
    require(picture->width > 0 && picture->height > 0);
    require(picture->pixels.size() ==
            static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height));
    for (const Rgb pixel : picture->pixels) require(pixel <= 0xffffff);
    return 0;
}
