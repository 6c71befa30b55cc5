#include "bindings/wasm/to_page.hpp"

#include <emscripten.h>

#include <cstdio>

#include "engine/base/visible.hpp"

namespace {

// clang-format off
EM_JS(void, send_to_page, (const char* bytes, int size, int is_binary), {
    const sent = HEAPU8.slice(bytes, bytes + size);
    Module["send"](is_binary ? sent.buffer : new TextDecoder().decode(sent));
})
// clang-format on

}  // namespace

namespace nezumi {

void send_bytes(std::string_view bytes) { send_to_page(bytes.data(), static_cast<int>(bytes.size()), 1); }
void send_text(std::string_view text) { send_to_page(text.data(), static_cast<int>(text.size()), 0); }

int refuse(const Error& error) {
    std::fprintf(stderr, "%s\n", visible(describe(error)).c_str());
    return 2;
}

}  // namespace nezumi
