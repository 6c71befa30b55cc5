// Paints with a depth buffer, a few rows at a time so that the buffer stays in the cache.
//
// Faces are not sorted from far to near, because such an order does not always exist. The inverse depth is an affine
// function of the picture coordinates, so a comparison costs one multiplication.
#include "sim/painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nezumi::sim {
namespace {

constexpr double nearest_plane = 0.01;  // [m]
constexpr int samples_per_side = 2;     // of each pixel
constexpr int band_rows = 16;           // of the picture: 32 rows of 1280 samples fit into the second-level cache

// An affine function of column and row.
struct Plane {
    double at_origin = 0, per_column = 0, per_row = 0;
    double at(double column, double row) const { return at_origin + per_column * column + per_row * row; }
};

struct Corner {
    double column, row;
};

// A visible face. Columns and rows are those of the samples.
struct SeenFace {
    std::vector<Corner> corners;
    int first_row, end_row;
    Plane inverse_depth;  // 1 / z
    Rgb color;
    const Picture* picture;
    Plane u, v;  // the picture's column and row, each times 1 / z
};

CameraIntrinsics of_samples(const CameraIntrinsics& pinhole) {
    // The centre of the first pixel is 0. Its samples, numbers 0 and 1, are at -0.25 and 0.25.
    const auto centre = [](double c) { return samples_per_side * (c + 0.5) - 0.5; };
    return {.fx = samples_per_side * pinhole.fx,
            .fy = samples_per_side * pinhole.fy,
            .cx = centre(pinhole.cx),
            .cy = centre(pinhole.cy)};
}

std::vector<Vec3> cut_near(const std::vector<Vec3>& corners) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if (a.z() >= nearest_plane) kept.push_back(a);
        if ((a.z() >= nearest_plane) != (b.z() >= nearest_plane)) {
            kept.push_back(a + (b - a) * ((nearest_plane - a.z()) / (b.z() - a.z())));
        }
    }
    return kept;
}

// The dot product of `direction` and the ray through a sample, as a function of the sample's place.
Plane along_ray(const Vec3& direction, const CameraIntrinsics& pinhole) {
    return {direction.z() - direction.x() * pinhole.cx / pinhole.fx - direction.y() * pinhole.cy / pinhole.fy,
            direction.x() / pinhole.fx, direction.y() / pinhole.fy};
}

Plane operator-(const Plane& a, const Plane& b) {
    return {a.at_origin - b.at_origin, a.per_column - b.per_column, a.per_row - b.per_row};
}
Plane operator*(const Plane& a, double s) { return {a.at_origin * s, a.per_column * s, a.per_row * s}; }

// The position of a point along an edge of the picture, in pixels, times 1 / z.
Plane along_edge(const Face& face, const Vec3& edge, int pixels, const Plane& inverse_depth,
                 const CameraIntrinsics& pinhole) {
    const double scale = pixels / edge.squaredNorm();
    return along_ray(edge * scale, pinhole) - inverse_depth * (edge.dot(face.top_left) * scale);
}

// Computes how the face is seen. Returns false if none of it is visible.
bool see(const Face& face, const CameraIntrinsics& pinhole, int columns, int rows, SeenFace& seen) {
    const std::vector<Vec3> corners = cut_near(face.corners);
    if (corners.size() < 3) return false;
    Vec3 normal = (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
    const double area = normal.norm();
    if (!(area > 0)) return false;
    normal = normal * (1 / area);
    double distance = normal.dot(face.corners[0]);
    if (distance < 0) {
        normal = -normal;
        distance = -distance;
    }
    if (distance < 1e-6) return false;  // seen edge-on

    double top = rows, bottom = 0, left = columns, right = 0;
    for (const Vec3& corner : corners) {
        const Corner c{pinhole.fx * corner.x() / corner.z() + pinhole.cx,
                       pinhole.fy * corner.y() / corner.z() + pinhole.cy};
        top = std::min(top, c.row);
        bottom = std::max(bottom, c.row);
        left = std::min(left, c.column);
        right = std::max(right, c.column);
        seen.corners.push_back(c);
    }
    seen.first_row = static_cast<int>(std::clamp(std::ceil(top), 0.0, static_cast<double>(rows)));
    seen.end_row = static_cast<int>(std::clamp(std::ceil(bottom), 0.0, static_cast<double>(rows)));
    if (seen.first_row >= seen.end_row || right < 0 || left > columns) return false;

    const Plane inverse_depth = along_ray(normal * (1 / distance), pinhole);
    seen.inverse_depth = inverse_depth * (distance / std::max(distance - face.lift, distance / 2));
    seen.color = face.color;
    seen.picture = face.picture;
    if (face.picture != nullptr) {
        // Uses the exact depth here, not the one shifted by `lift`.
        seen.u = along_edge(face, face.right, face.picture->width, inverse_depth, pinhole);
        seen.v = along_edge(face, face.down, face.picture->height, inverse_depth, pinhole);
        const double back = std::max(distance - face.lift, distance / 2) / distance;
        // Samples divide by `inverse_depth`.
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

// The largest integer that is not above a number, which fits into an int: `std::floor` is a call on processors before
// SSE 4.1.
int floor_of(float number) {
    const int towards_zero = static_cast<int>(number);
    return towards_zero - static_cast<int>(number < static_cast<float>(towards_zero));
}

// The pixel left of `place`, and the weight of the next one for a sample of this width.
struct Blend {
    int first, second;
    float of_second;
};
inline Blend weights(float place, float width, int count) {
    // Sharp where a pixel of the picture is wide, soft where it is narrow: a box filter of this width.
    const int second = floor_of(place + 0.5F);
    const float edge = static_cast<float>(second);
    const float part = std::clamp((place - edge) / std::min(std::max(width, 1e-6F), 1.0F) + 0.5F, 0.0F, 1.0F);
    return {std::clamp(second - 1, 0, count - 1), std::clamp(second, 0, count - 1), part};
}

inline Rgb blend(Rgb a, Rgb b, float of_b) {
    if (a == b || of_b <= 0) return a;
    if (of_b >= 1) return b;
    Rgb mixed = 0;
    for (const int shift : {0, 8, 16}) {
        const float from = static_cast<float>(a >> shift & 0xff), to = static_cast<float>(b >> shift & 0xff);
        // Rounds half up, as `std::lround` does, which is a call.
        const float value = from + (to - from) * of_b;
        const int whole = static_cast<int>(value);
        mixed |= static_cast<Rgb>(whole + static_cast<int>(value - static_cast<float>(whole) >= 0.5F)) << shift;
    }
    return mixed;
}

struct Band {
    Band(int band_columns, int rows)
        : columns(band_columns),
          inverse_depth(static_cast<std::size_t>(band_columns * rows)),
          colors(static_cast<std::size_t>(band_columns * rows)) {}
    int columns;
    std::vector<float> inverse_depth;
    std::vector<Rgb> colors;
};

void paint_plain(const SeenFace& face, int row, int first, int end, float* inverse_depth, Rgb* colors) {
    const float at_row = static_cast<float>(face.inverse_depth.at(0, row));
    const float step = static_cast<float>(face.inverse_depth.per_column);
    for (int column = first; column < end; ++column) {
        const float here = at_row + step * static_cast<float>(column);
        const bool nearer = here > inverse_depth[column];
        inverse_depth[column] = nearer ? here : inverse_depth[column];
        colors[column] = nearer ? face.color : colors[column];
    }
}

void paint_picture(const SeenFace& face, int row, int first, int end, float* inverse_depth, Rgb* colors) {
    const Picture& picture = *face.picture;
    const auto step = [](const Plane& p) { return static_cast<float>(p.per_column); };
    const auto fall = [](const Plane& p) { return static_cast<float>(p.per_row); };
    for (int column = first; column < end; ++column) {
        const double exact = face.inverse_depth.at(column, row);
        const float here = static_cast<float>(exact);
        if (here <= inverse_depth[column]) continue;
        inverse_depth[column] = here;
        const float z = 1 / here;
        const float u = static_cast<float>(face.u.at(column, row) / exact);
        const float v = static_cast<float>(face.v.at(column, row) / exact);
        const auto width = [&](const Plane& of, float value) {
            return z * (std::abs(step(of) - value * step(face.inverse_depth)) +
                        std::abs(fall(of) - value * fall(face.inverse_depth)));
        };
        const Blend across = weights(u, width(face.u, u), picture.width);
        const Blend along = weights(v, width(face.v, v), picture.height);
        const Rgb* upper = &picture.pixels[static_cast<std::size_t>(along.first) * picture.width];
        const Rgb* lower = &picture.pixels[static_cast<std::size_t>(along.second) * picture.width];
        colors[column] = blend(blend(upper[across.first], upper[across.second], across.of_second),
                               blend(lower[across.first], lower[across.second], across.of_second), along.of_second);
    }
}

// Averages the samples of each pixel of a row of the picture.
void resolve(const Rgb* samples_of_row, int columns, int width, bool color, std::uint8_t* out) {
    for (int pixel = 0; pixel < width; ++pixel) {
        // Two channels at a time: red and blue are 16 bits apart, and the sum of four needs 10 bits.
        Rgb red_blue = 0, green = 0;
        for (int row = 0; row < samples_per_side; ++row) {
            for (int column = 0; column < samples_per_side; ++column) {
                const Rgb sample = samples_of_row[row * columns + samples_per_side * pixel + column];
                red_blue += sample & 0xff00ff;
                green += sample >> 8 & 0xff;
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

void paint(const std::vector<Face>& faces, Rgb background, const CameraIntrinsics& pinhole, bool color,
           std::vector<std::uint8_t>& pixels) {
    const int width = pinhole.width, height = pinhole.height;
    const int columns = width * samples_per_side;
    const CameraIntrinsics fine = of_samples(pinhole);
    std::vector<SeenFace> seen;
    for (const Face& face : faces) {
        SeenFace now{};
        if (see(face, fine, columns, height * samples_per_side, now)) seen.push_back(std::move(now));
    }
    const int bytes = color ? 3 : 1;
    pixels.resize(static_cast<std::size_t>(width) * height * bytes);
    Band band(columns, band_rows * samples_per_side);
    for (int top = 0; top < height; top += band_rows) {
        const int end = std::min(top + band_rows, height);
        std::fill(band.inverse_depth.begin(), band.inverse_depth.end(), 0.0F);
        std::fill(band.colors.begin(), band.colors.end(), background);
        for (const SeenFace& face : seen) {
            for (int row = std::max(face.first_row, top * samples_per_side);
                 row < std::min(face.end_row, end * samples_per_side); ++row) {
                const auto [first, last] = span_of(face, row, columns);
                const std::size_t offset = static_cast<std::size_t>(row - top * samples_per_side) * columns;
                const auto paint_row = face.picture != nullptr ? paint_picture : paint_plain;
                paint_row(face, row, first, last, &band.inverse_depth[offset], &band.colors[offset]);
            }
        }
        for (int row = top; row < end; ++row) {
            resolve(&band.colors[static_cast<std::size_t>(row - top) * samples_per_side * columns], columns, width,
                    color, &pixels[static_cast<std::size_t>(row) * width * bytes]);
        }
    }
}

}  // namespace nezumi::sim
