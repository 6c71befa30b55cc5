// QR codes by libqrencode, as half blocks.
#include <qrencode.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "bindings/web/qr_code.hpp"

namespace nezumi::web {
namespace {

constexpr int quiet = 2;  // modules (squares) around the code; the standard's four would need a larger terminal
constexpr const char* dark_on_light = "\033[38;5;16;48;5;231m";  // black on white with any terminal colours
constexpr const char* plain = "\033[0m";

std::string draw(const QRcode& code) {
    const auto is_dark = [&](int row, int column) {
        if (row < 0 || column < 0 || row >= code.width || column >= code.width) return false;
        return (code.data[row * code.width + column] & 1U) != 0;
    };
    std::string lines;
    for (int row = -quiet; row < code.width + quiet; row += 2) {
        lines += dark_on_light;
        for (int column = -quiet; column < code.width + quiet; ++column) {
            const bool upper = is_dark(row, column), lower = is_dark(row + 1, column);
            lines += upper && lower ? "\u2588" : upper ? "\u2580" : lower ? "\u2584" : " ";
        }
        lines += plain;
        lines += '\n';
    }
    return lines;
}

}  // namespace
}  // namespace nezumi::web

extern "C" __attribute__((visibility("default"))) nezumi::web::DrawInModule nezumi_draw_qr;

bool nezumi_draw_qr(const std::string& text, std::string& lines, std::string& problem) {
    try {
        const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
            QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_L), QRcode_free);
        if (code == nullptr) {
            problem = std::string("no QR code can be made: ") + std::strerror(errno);
            return false;
        }
        lines = nezumi::web::draw(*code);
        return true;
    } catch (const std::exception& thrown) {
        problem = thrown.what();
        return false;
    }
}
