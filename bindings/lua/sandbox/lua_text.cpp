// Reads the list of loaded libraries, and the registers of interrupted code.
#include "bindings/lua/sandbox/lua_text.hpp"

#include <link.h>
#include <ucontext.h>

#include <cstdint>
#include <lua.hpp>

namespace nezumi {
namespace {

struct Range {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    bool holds(std::uintptr_t address) const { return address >= begin && address < end; }
};

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): written once, before the handler that reads it
constinit Range lua_code;

int look_into_library(dl_phdr_info* library, std::size_t, void*) {
    for (int i = 0; i < library->dlpi_phnum; ++i) {
        const auto& segment = library->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0) continue;
        const std::uintptr_t begin = library->dlpi_addr + segment.p_vaddr;
        const Range text{begin, begin + segment.p_memsz};
        if (!text.holds(reinterpret_cast<std::uintptr_t>(&lua_newstate))) continue;
        // If Lua is linked statically, its code can't be distinguished from that of this program.
        if (!text.holds(reinterpret_cast<std::uintptr_t>(&was_in_lua))) lua_code = text;
        return 1;
    }
    return 0;
}

}  // namespace

void find_lua_text() { dl_iterate_phdr(look_into_library, nullptr); }

bool was_in_lua(const void* context) {
    const mcontext_t& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    const auto place = static_cast<std::uintptr_t>(machine.gregs[REG_RIP]);
#elif defined(__aarch64__)
    const auto place = static_cast<std::uintptr_t>(machine.pc);
#elif defined(__arm__)
    const auto place = static_cast<std::uintptr_t>(machine.arm_pc);
#else
    const std::uintptr_t place = 0;
    static_cast<void>(machine);
#endif
    return lua_code.holds(place);
}

}  // namespace nezumi
