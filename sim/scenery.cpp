// Makes the faces of boxes, cylinders (as prisms), signs and the floor, with light from above.
#include "sim/scenery.hpp"

#include <array>
#include <cmath>

namespace nezumi::sim {
namespace {

constexpr Rgb back_color = 0xd8d8d8;  // back of a sign
constexpr double floor_reach = 200;   // [m]
constexpr int prism_sides = 24;
constexpr double sign_lift = 0.002;    // [m] a sign on a wall is in front of the wall
constexpr double floor_lift = 0.0005;  // [m] the floor's picture is above the floor

Rgb lit(Rgb color, const Vec3& normal) {
    // Light from above and a little from the side, so that the faces of a box differ.
    const double light = 0.8 + 0.2 * normal.dot(Vec3(0.4, 0.25, 0.9).normalized());
    Rgb shaded = 0;
    for (const int shift : {0, 8, 16}) {
        shaded |= static_cast<Rgb>(std::lround(static_cast<double>(color >> shift & 0xff) * light)) << shift;
    }
    return shaded;
}

class Looker {
public:
    Looker(const View& view, std::vector<Face>& faces) : view_(view), faces_(faces) {}

    // From the world frame to the camera frame: x right, y down, z ahead.
    Vec3 direction(const Vec3& d) const {
        const Vec3 body = view_.rotation.transpose() * d;
        return {-body.y(), -body.z(), body.x()};
    }
    Vec3 place(const Vec3& p) const { return direction(p - view_.at); }
    bool is_before(const Vec3& at, const Vec3& normal) const { return (view_.at - at).dot(normal) > 0; }

    Face& add(std::initializer_list<Vec3> corners) {
        Face& face = faces_.emplace_back();
        for (const Vec3& corner : corners) face.corners.push_back(place(corner));
        return face;
    }
    Face& add(const std::vector<Vec3>& corners) {
        Face& face = faces_.emplace_back();
        for (const Vec3& corner : corners) face.corners.push_back(place(corner));
        return face;
    }

private:
    const View& view_;
    std::vector<Face>& faces_;
};

void add_box(const Solid& solid, Looker& looker) {
    const Shape& box = solid.shape;
    const std::array<Vec3, 3> half{box.rotation.col(0) * box.half.x(), box.rotation.col(1) * box.half.y(),
                                   box.rotation.col(2) * box.half.z()};
    const std::array<Vec3, 3> axes{box.rotation.col(0), box.rotation.col(1), box.rotation.col(2)};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = half[(i + 1) % 3], &b = half[(i + 2) % 3];
        for (const double side : {1.0, -1.0}) {
            const Vec3 centre = box.centre + half[i] * side, normal = axes[i] * side;
            if (!looker.is_before(centre, normal)) continue;
            looker.add({centre + a + b, centre + a - b, centre - a - b, centre - a + b}).color =
                lit(solid.color, normal);
        }
    }
}

void add_cylinder(const Solid& solid, Looker& looker) {
    const Shape& cylinder = solid.shape;
    const Rotation& r = cylinder.rotation;
    const Vec3 up = r.col(2) * cylinder.half.z();
    const auto spoke = [&](int i) -> Vec3 {
        const double angle = 2 * M_PI * i / prism_sides;
        return r.col(0) * (cylinder.half.x() * std::cos(angle)) + r.col(1) * (cylinder.half.x() * std::sin(angle));
    };
    std::vector<Vec3> rim;
    for (int i = 0; i < prism_sides; ++i) {
        const Vec3 a = cylinder.centre + spoke(i), b = cylinder.centre + spoke(i + 1);
        rim.push_back(a);
        const Vec3 normal = (spoke(i) + spoke(i + 1)).normalized();
        if (looker.is_before(a, normal)) looker.add({a + up, b + up, b - up, a - up}).color = lit(solid.color, normal);
    }
    for (const double side : {1.0, -1.0}) {
        const Vec3 normal = r.col(2) * side;
        if (!looker.is_before(cylinder.centre + up * side, normal)) continue;
        std::vector<Vec3> lid;
        lid.reserve(rim.size());
        for (const Vec3& point : rim) lid.push_back(point + up * side);
        looker.add(lid).color = lit(solid.color, normal);
    }
}

void add_sign(const Sign& sign, Looker& looker) {
    const Vec3 across = sign.rotation.col(1) * sign.edge, down = -sign.rotation.col(2) * sign.edge;
    const Vec3 top_left = sign.centre - across * 0.5 - down * 0.5;
    Face& face = looker.add({top_left, top_left + across, top_left + across + down, top_left + down});
    face.lift = sign_lift;
    if (!looker.is_before(sign.centre, sign.rotation.col(0))) {
        face.color = back_color;
        return;
    }
    face.picture = sign.picture;
    face.top_left = looker.place(top_left);
    face.right = looker.direction(across);
    face.down = looker.direction(down);
}

void add_floor(const Scenery& scenery, const View& view, Looker& looker) {
    if (view.at.z() <= 0) return;
    const auto rectangle = [&](double x, double y, double half_x, double half_y) -> Face& {
        return looker.add({{x - half_x, y + half_y, 0},
                           {x + half_x, y + half_y, 0},
                           {x + half_x, y - half_y, 0},
                           {x - half_x, y - half_y, 0}});
    };
    rectangle(view.at.x(), view.at.y(), floor_reach, floor_reach).color = plain_floor_color;
    if (scenery.floor == nullptr) return;
    const double x = scenery.floor_size.x / 2, y = scenery.floor_size.y / 2;
    Face& picture = rectangle(0, 0, x, y);
    picture.picture = scenery.floor;
    picture.lift = floor_lift;
    picture.top_left = looker.place({-x, y, 0});
    picture.right = looker.direction({2 * x, 0, 0});
    picture.down = looker.direction({0, -2 * y, 0});
}

}  // namespace

std::vector<Face> faces_of(const Scenery& scenery, const View& view) {
    std::vector<Face> faces;
    Looker looker(view, faces);
    add_floor(scenery, view, looker);
    for (const Solid& solid : scenery.solids) {
        if (solid.shape.kind == Shape::Kind::box) {
            add_box(solid, looker);
        } else {
            add_cylinder(solid, looker);
        }
    }
    for (const Sign& sign : scenery.signs) add_sign(sign, looker);
    return faces;
}

}  // namespace nezumi::sim
