// Rewrites a dump function by function. Before each division that may be by zero, inserts an instruction whose only
// effect is that Lua notes its place. Jumps and line numbers are adapted to the moved instructions.
#include "bindings/lua/sandbox/bytecode.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <lua.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi {
namespace {

// The numbers below are those of Lua 5.4.4 (lopcodes.h, ldebug.h, lobject.h, ldump.c). Later versions of Lua note the
// place of a division, so their code stays as it is.
constexpr bool forgets_places = LUA_VERSION_RELEASE_NUM == 50404;
using Instruction = std::uint32_t;
enum Operation : Instruction {
    op_mod_constant = 25,
    op_idiv_constant = 28,
    op_mod = 37,
    op_idiv = 40,
    op_close = 54,
    op_jump = 56,
    op_for_loop = 73,
    op_for_prepare = 74,
    op_generic_prepare = 75,
    op_generic_loop = 77,
};
constexpr int loop_bits = 15;  // the first bit of the distance in a loop instruction
constexpr int jump_bits = 7;   // the same in a jump
constexpr std::int64_t most_of_loop = (std::int64_t{1} << 17) - 1;
constexpr std::int64_t no_jump = (std::int64_t{1} << 24) - 1;  // the field of a jump to the next instruction
constexpr int line_is_absolute = -0x80;
constexpr int most_without_absolute = 128;
constexpr std::size_t header_size = 4 + 1 + 1 + 6 + 3 + 8 + 8 + 1;
enum Constant : unsigned char { integer_constant = 0x03, float_constant = 0x13, short_text = 0x04, long_text = 0x14 };

class Rewriter {
public:
    explicit Rewriter(std::string_view dump) : rest_(dump) {}

    // Returns false if the bytes are not a dump of lua_dump.
    bool run() {
        copy(header_size);
        function();
        return ok_ && rest_.empty();
    }
    const std::string& rewritten() const { return out_; }
    const std::set<int>& lines() const { return lines_; }

private:
    struct Moved {
        std::vector<std::size_t> begin{};  // new index of each instruction, or of one inserted before it; the end
        std::size_t length = 0;
    };

    std::string_view take(std::size_t size) {
        ok_ = ok_ && size <= rest_.size();
        if (!ok_) return {};
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    unsigned char byte() {
        const std::string_view one = take(1);
        return one.empty() ? std::uint8_t{0} : static_cast<unsigned char>(one[0]);
    }
    std::size_t number() {
        std::size_t number = 0;
        while (ok_) {
            const unsigned char part = byte();
            number = number << 7 | (part & 0x7FU);
            if ((part & 0x80U) != 0) break;
        }
        return ok_ ? number : 0;
    }
    void skip_text() {
        if (const std::size_t size = number(); size > 1) take(size - 1);
    }
    void write(std::size_t number) {
        std::string digits(1, static_cast<char>(0x80U | (number & 0x7FU)));
        while ((number >>= 7) != 0) digits.insert(digits.begin(), static_cast<char>(number & 0x7FU));
        out_ += digits;
    }
    void copy(std::size_t size) { out_ += take(size); }
    std::size_t copy_number() {
        const std::size_t copied = number();
        write(copied);
        return copied;
    }
    void copy_text() {
        const char* const begin = rest_.data();
        skip_text();
        out_.append(begin, rest_.data());
    }

    void function() {
        copy_text();
        const auto defined = static_cast<int>(copy_number());
        copy_number();
        copy(1);
        const unsigned char is_vararg = byte();
        out_ += static_cast<char>(is_vararg);
        const unsigned char slots = byte();
        out_ += static_cast<char>(slots);
        std::vector<Instruction> code(number());
        const std::string_view bytes = take(code.size() * sizeof(Instruction));
        if (!ok_) return;
        std::memcpy(code.data(), bytes.data(), bytes.size());
        const char* const constants_begin = rest_.data();
        const std::vector<bool> is_zero = constants();
        const std::string_view constants(constants_begin, static_cast<std::size_t>(rest_.data() - constants_begin));
        const Moved moved = write_code(code, is_zero, slots);
        out_ += constants;
        copy(copy_number() * 3);  // upvalues
        ++depth_;
        for (std::size_t left = copy_number(); ok_ && left > 0; --left) function();
        --depth_;
        // The first instruction of a function with `...` does not belong to a line.
        lines(defined, moved, is_vararg != 0 ? 1 : 0);
        for (std::size_t left = copy_number(); ok_ && left > 0; --left) {  // local variables
            copy_text();
            write(place(moved, number()));
            write(place(moved, number()));
        }
        for (std::size_t left = copy_number(); ok_ && left > 0; --left) copy_text();  // names of upvalues
    }

    // Which constants are the integer 0.
    std::vector<bool> constants() {
        std::vector<bool> is_zero;
        for (std::size_t left = number(); ok_ && left > 0; --left) {
            const unsigned char type = byte();
            std::string_view value;
            if (type == integer_constant || type == float_constant) value = take(8);
            if (type == short_text || type == long_text) skip_text();
            is_zero.push_back(type == integer_constant && value.find_first_not_of('\0') == value.npos);
        }
        return is_zero;
    }

    static bool may_fail(Instruction instruction, const std::vector<bool>& is_zero) {
        switch (instruction & 0x7FU) {
            case op_mod:
            case op_idiv: return true;
            case op_mod_constant:
            case op_idiv_constant: return instruction >> 24 < is_zero.size() && is_zero[instruction >> 24];
            default: return false;
        }
    }

    // The index of the instruction to which this one jumps; without a jump, of the next one.
    static std::size_t target(Instruction instruction, std::size_t at) {
        const std::size_t distance = instruction >> loop_bits;
        switch (instruction & 0x7FU) {
            case op_for_prepare: return at + distance + 2;
            case op_generic_prepare: return at + distance + 1;
            case op_for_loop:
            case op_generic_loop: return at + 1 - distance;
            case op_jump:
                return static_cast<std::size_t>(static_cast<std::int64_t>(at) + 1 + (instruction >> jump_bits) -
                                                no_jump);
            default: return at + 1;
        }
    }

    Instruction aimed(Instruction instruction, std::size_t at, std::size_t target) {
        const std::int64_t ahead = static_cast<std::int64_t>(target) - static_cast<std::int64_t>(at) - 1;
        const auto with = [&](std::int64_t field, int bits, std::int64_t most) {
            ok_ = ok_ && field >= 0 && field <= most;  // false for more than 100 000 instructions
            return (instruction & ((1U << bits) - 1U)) | static_cast<Instruction>(field) << bits;
        };
        switch (instruction & 0x7FU) {
            case op_for_prepare: return with(ahead - 1, loop_bits, most_of_loop);
            case op_generic_prepare: return with(ahead, loop_bits, most_of_loop);
            case op_for_loop:
            case op_generic_loop: return with(-ahead, loop_bits, most_of_loop);
            case op_jump: return with(ahead + no_jump, jump_bits, 2 * no_jump + 1);
            default: return instruction;
        }
    }

    Moved write_code(const std::vector<Instruction>& code, const std::vector<bool>& is_zero, unsigned char slots) {
        // Closes the variables above the last slot, so none. Lua notes the place of this instruction.
        const Instruction note = op_close | Instruction{slots} << 7;
        Moved moved;
        for (const Instruction instruction : code) {
            moved.begin.push_back(moved.length);
            moved.length += may_fail(instruction, is_zero) ? 2 : 1;
        }
        moved.begin.push_back(moved.length);
        write(moved.length);
        const auto put = [this](Instruction instruction) {
            out_.append(reinterpret_cast<const char*>(&instruction), sizeof instruction);
        };
        for (std::size_t i = 0; ok_ && i < code.size(); ++i) {
            if (may_fail(code[i], is_zero)) put(note);
            put(aimed(code[i], moved.begin[i + 1] - 1, place(moved, target(code[i], i))));
        }
        return moved;
    }

    std::size_t place(const Moved& moved, std::size_t instruction) {
        ok_ = ok_ && instruction < moved.begin.size();
        return ok_ ? moved.begin[instruction] : 0;
    }

    // The lines are stored as differences, and absolutely at least every 128 instructions.
    void lines(int defined, const Moved& moved, std::size_t first) {
        const std::string_view differences = take(number());
        std::vector<std::pair<std::size_t, int>> absolute(number());
        ok_ = ok_ && differences.size() + 1 == moved.begin.size();
        if (!ok_) return;
        for (auto& [at, line] : absolute) {
            at = number();
            line = static_cast<int>(number());
        }
        std::string written;
        std::vector<std::pair<std::size_t, int>> written_absolute;
        int line = defined;
        int previous = defined;
        int without = 0;
        auto next = absolute.begin();
        for (std::size_t i = 0; i < differences.size(); ++i) {
            const bool is_absolute = next != absolute.end() && next->first == i;
            line = is_absolute ? (next++)->second : line + static_cast<signed char>(differences[i]);
            if (depth_ > 0 && i >= first) lines_.insert(line);
            for (std::size_t at = moved.begin[i]; at < moved.begin[i + 1]; ++at) {
                int difference = line - std::exchange(previous, line);
                if (std::abs(difference) >= -line_is_absolute || without++ >= most_without_absolute) {
                    written_absolute.emplace_back(at, line);
                    difference = line_is_absolute;
                    without = 1;
                }
                written += static_cast<char>(difference);
            }
        }
        write(written.size());
        out_ += written;
        write(written_absolute.size());
        for (const auto& [at, absolute_line] : written_absolute) {
            write(at);
            write(static_cast<std::size_t>(absolute_line));
        }
    }

    std::string_view rest_;
    std::string out_{};
    std::set<int> lines_{};
    int depth_ = 0;  // 0: the main function
    bool ok_ = true;
};

}  // namespace

std::string with_division_lines(std::string bytecode) {
    if (!forgets_places) return bytecode;
    Rewriter rewriter(bytecode);
    return rewriter.run() ? rewriter.rewritten() : bytecode;
}

std::set<int> lines_of_functions(const std::string& bytecode) {
    Rewriter reader(bytecode);
    return reader.run() ? reader.lines() : std::set<int>();
}

}  // namespace nezumi
