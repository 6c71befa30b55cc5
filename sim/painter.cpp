// Painting with a depth buffer, a few rows at a time so that it stays in the cache.
//
// No sorting from far to near: whatever stands in a room, some pair of faces has no such order. One over the depth is
// an affine function of the place in the picture, so the comparison costs one multiplication.
#include "sim/painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nezumi::sim {
namespace {

constexpr double nearest_plane = 0.01;  // [m]
constexpr int looks = 2;                // a side: a pixel is the mean of looks * looks
constexpr int band_rows = 16;           // of the picture: 32 rows of 1280 looks fit into the second-level cache

// An affine function of column and row.
struct Plane {
    double at_origin = 0, per_column = 0, per_row = 0;
    double at(double column, double row) const { return at_origin + per_column * column + per_row * row; }
};

struct Corner {
    double column, row;
};

// A face as it is seen: columns and rows are those of the looks.
struct SeenFace {
    std::vector<Corner> corners;
    int first_row, end_row;
    Plane nearness;  // 1 / z
    Rgb color;
    const Picture* picture;
    Plane u, v;  // the picture's column and row, each times 1 / z
};

Intrinsics of_looks(const Intrinsics& lens) {
    // The looks of the first pixel, whose centre is 0, are at -0.25 and 0.25: numbers 0 and 1.
    const auto centre = [](double c) { return looks * (c + 0.5) - 0.5; };
    return {looks * lens.fx, looks * lens.fy, centre(lens.cx), centre(lens.cy)};
}

std::vector<Vec3> cut_near(const std::vector<Vec3>& corners) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if (a.z >= nearest_plane) kept.push_back(a);
        if ((a.z >= nearest_plane) != (b.z >= nearest_plane)) {
            kept.push_back(a + (b - a) * ((nearest_plane - a.z) / (b.z - a.z)));
        }
    }
    return kept;
}

// `direction` dot the ray through a look, as a function of its place.
Plane along_ray(const Vec3& direction, const Intrinsics& lens) {
    return {direction.z - direction.x * lens.cx / lens.fx - direction.y * lens.cy / lens.fy, direction.x / lens.fx,
            direction.y / lens.fy};
}

Plane operator-(const Plane& a, const Plane& b) {
    return {a.at_origin - b.at_origin, a.per_column - b.per_column, a.per_row - b.per_row};
}
Plane operator*(const Plane& a, double s) { return {a.at_origin * s, a.per_column * s, a.per_row * s}; }

// How far a point is along an edge of the picture, in pixels, times 1 / z.
Plane along_edge(const Face& face, const Vec3& edge, int pixels, const Plane& nearness, const Intrinsics& lens) {
    const double scale = pixels / dot(edge, edge);
    return along_ray(edge * scale, lens) - nearness * (dot(edge, face.top_left) * scale);
}

// Whether anything of it is in sight, and if so, how.
bool see(const Face& face, const Intrinsics& lens, int columns, int rows, SeenFace& seen) {
    const std::vector<Vec3> corners = cut_near(face.corners);
    if (corners.size() < 3) return false;
    Vec3 normal = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double area = length(normal);
    if (!(area > 0)) return false;
    normal = normal * (1 / area);
    double distance = dot(normal, face.corners[0]);
    if (distance < 0) {
        normal = -normal;
        distance = -distance;
    }
    if (distance < 1e-6) return false;  // seen edge on

    double top = rows, bottom = 0, left = columns, right = 0;
    for (const Vec3& corner : corners) {
        const Corner c{lens.fx * corner.x / corner.z + lens.cx, lens.fy * corner.y / corner.z + lens.cy};
        top = std::min(top, c.row);
        bottom = std::max(bottom, c.row);
        left = std::min(left, c.column);
        right = std::max(right, c.column);
        seen.corners.push_back(c);
    }
    seen.first_row = static_cast<int>(std::clamp(std::ceil(top), 0.0, static_cast<double>(rows)));
    seen.end_row = static_cast<int>(std::clamp(std::ceil(bottom), 0.0, static_cast<double>(rows)));
    if (seen.first_row >= seen.end_row || right < 0 || left > columns) return false;

    const Plane nearness = along_ray(normal * (1 / distance), lens);
    seen.nearness = nearness * (distance / std::max(distance - face.lift, distance / 2));
    seen.color = face.color;
    seen.picture = face.picture;
    if (face.picture != nullptr) {
        // The exact depth here, not the one with which it hides what is behind it.
        seen.u = along_edge(face, face.right, face.picture->width, nearness, lens);
        seen.v = along_edge(face, face.down, face.picture->height, nearness, lens);
        const double back = std::max(distance - face.lift, distance / 2) / distance;
        // `nearness` is what a look divides by.
        seen.u = seen.u * (1 / back);
        seen.v = seen.v * (1 / back);
    }
    return true;
}

// The columns of a row that a convex face covers: [first, end).
std::pair<int, int> span_of(const SeenFace& face, int row, int columns) {
    double left = columns, right = 0;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const Corner &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
        if ((a.row <= row) == (b.row <= row)) continue;
        const double column = a.column + (b.column - a.column) * ((row - a.row) / (b.row - a.row));
        left = std::min(left, column);
        right = std::max(right, column);
    }
    return {static_cast<int>(std::ceil(std::max(left, 0.0))),
            static_cast<int>(std::ceil(std::min(right, static_cast<double>(columns))))};
}

// The pixel before which `place` lies, and how much of the next one a look of this width catches.
struct Blend {
    int first, second;
    float of_second;
};
Blend blend(float place, float width, int count) {
    // Sharp when a pixel of the picture is wide, soft when it is narrow: what a box of this width sees.
    const float edge = std::floor(place + 0.5F);
    const float part = std::clamp((place - edge) / std::min(std::max(width, 1e-6F), 1.0F) + 0.5F, 0.0F, 1.0F);
    const int second = static_cast<int>(edge);
    return {std::clamp(second - 1, 0, count - 1), std::clamp(second, 0, count - 1), part};
}

Rgb mix(Rgb a, Rgb b, float of_b) {
    if (a == b || of_b <= 0) return a;
    if (of_b >= 1) return b;
    Rgb mixed = 0;
    for (const int shift : {0, 8, 16}) {
        const float from = static_cast<float>(a >> shift & 0xff), to = static_cast<float>(b >> shift & 0xff);
        mixed |= static_cast<Rgb>(std::lround(from + (to - from) * of_b)) << shift;
    }
    return mixed;
}

struct Band {
    Band(int band_columns, int rows)
        : columns(band_columns),
          nearness(static_cast<std::size_t>(band_columns * rows)),
          colors(static_cast<std::size_t>(band_columns * rows)) {}
    int columns;
    std::vector<float> nearness;
    std::vector<Rgb> colors;
};

void paint_plain(const SeenFace& face, int row, int first, int end, float* nearness, Rgb* colors) {
    const float at_row = static_cast<float>(face.nearness.at(0, row));
    const float step = static_cast<float>(face.nearness.per_column);
    for (int column = first; column < end; ++column) {
        const float here = at_row + step * static_cast<float>(column);
        const bool nearer = here > nearness[column];
        nearness[column] = nearer ? here : nearness[column];
        colors[column] = nearer ? face.color : colors[column];
    }
}

void paint_picture(const SeenFace& face, int row, int first, int end, float* nearness, Rgb* colors) {
    const Picture& picture = *face.picture;
    const auto step = [](const Plane& p) { return static_cast<float>(p.per_column); };
    const auto fall = [](const Plane& p) { return static_cast<float>(p.per_row); };
    for (int column = first; column < end; ++column) {
        const double exact = face.nearness.at(column, row);
        const float here = static_cast<float>(exact);
        if (here <= nearness[column]) continue;
        nearness[column] = here;
        const float z = 1 / here;
        const float u = static_cast<float>(face.u.at(column, row) / exact);
        const float v = static_cast<float>(face.v.at(column, row) / exact);
        const auto width = [&](const Plane& of, float value) {
            return z * (std::abs(step(of) - value * step(face.nearness)) +
                        std::abs(fall(of) - value * fall(face.nearness)));
        };
        const Blend across = blend(u, width(face.u, u), picture.width);
        const Blend along = blend(v, width(face.v, v), picture.height);
        const Rgb* upper = &picture.pixels[static_cast<std::size_t>(along.first) * picture.width];
        const Rgb* lower = &picture.pixels[static_cast<std::size_t>(along.second) * picture.width];
        colors[column] = mix(mix(upper[across.first], upper[across.second], across.of_second),
                             mix(lower[across.first], lower[across.second], across.of_second), along.of_second);
    }
}

// The mean of the looks of each pixel of a row of the picture.
void resolve(const Rgb* looked, int columns, int width, bool color, std::uint8_t* out) {
    for (int pixel = 0; pixel < width; ++pixel) {
        // Two channels at a time: red and blue lie 16 bits apart, the sum of four needs 10.
        Rgb red_blue = 0, green = 0;
        for (int row = 0; row < looks; ++row) {
            for (int column = 0; column < looks; ++column) {
                const Rgb look = looked[row * columns + looks * pixel + column];
                red_blue += look & 0xff00ff;
                green += look >> 8 & 0xff;
            }
        }
        const Rgb red = ((red_blue >> 16) + 2) / 4, blue = ((red_blue & 0xffff) + 2) / 4;
        green = (green + 2) / 4;
        if (color) {
            *out++ = static_cast<std::uint8_t>(red);
            *out++ = static_cast<std::uint8_t>(green);
            *out++ = static_cast<std::uint8_t>(blue);
        } else {
            *out++ = static_cast<std::uint8_t>((299 * red + 587 * green + 114 * blue + 500) / 1000);  // ITU-R BT.601
        }
    }
}

}  // namespace

void paint(const std::vector<Face>& faces, Rgb background, const Intrinsics& lens, int width, int height, bool color,
           std::vector<std::uint8_t>& pixels) {
    const int columns = width * looks;
    const Intrinsics fine = of_looks(lens);
    std::vector<SeenFace> seen;
    for (const Face& face : faces) {
        SeenFace now{};
        if (see(face, fine, columns, height * looks, now)) seen.push_back(std::move(now));
    }
    const int bytes = color ? 3 : 1;
    pixels.resize(static_cast<std::size_t>(width) * height * bytes);
    Band band(columns, band_rows * looks);
    for (int top = 0; top < height; top += band_rows) {
        const int end = std::min(top + band_rows, height);
        std::fill(band.nearness.begin(), band.nearness.end(), 0.0F);
        std::fill(band.colors.begin(), band.colors.end(), background);
        for (const SeenFace& face : seen) {
            for (int row = std::max(face.first_row, top * looks); row < std::min(face.end_row, end * looks); ++row) {
                const auto [first, last] = span_of(face, row, columns);
                const std::size_t offset = static_cast<std::size_t>(row - top * looks) * columns;
                const auto paint_row = face.picture != nullptr ? paint_picture : paint_plain;
                paint_row(face, row, first, last, &band.nearness[offset], &band.colors[offset]);
            }
        }
        for (int row = top; row < end; ++row) {
            resolve(&band.colors[static_cast<std::size_t>(row - top) * looks * columns], columns, width, color,
                    &pixels[static_cast<std::size_t>(row) * width * bytes]);
        }
    }
}

}  // namespace nezumi::sim
