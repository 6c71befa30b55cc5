// Draws in metres under one transformation; lines and letters have a fixed size in pixels.
#include "bindings/draw/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bindings/draw/canvas.hpp"
#include "bindings/draw/picture_bounds.hpp"
#include "engine/system/system.hpp"

namespace nezumi::draw {
namespace {

constexpr double picture_head = 64, foot = 56, side = 28;      // [px] margins around the drawing
constexpr double largest_width = 1100, largest_height = 820;   // [px] of the drawing
constexpr double smallest_width = 560, smallest_height = 240;  // [px]
constexpr double most_pixels_a_metre = 800;
constexpr double around = 0.12;          // [m] of floor around everything
constexpr std::size_t most_labels = 12;  // with more robots, names are not drawn

// Returns 1, 2 or 5 times a power of ten, at least `least`.
double round_length(double least) {
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    }
    return 10 * power;
}

std::string metres(double length) {
    return length < 1 ? fmt::format("{:g} cm", length * 100) : fmt::format("{:g} m", length);
}

class PicturePainter {
public:
    PicturePainter(PictureOf picture, const std::string& file, const PictureReader& read)
        : picture_(only_finite(std::move(picture))), read_(read), canvas_(layout(file)) {}

    Expected<void> paint() {
        cairo_save(context());
        cairo_rectangle(context(), side, picture_head, floor_width_, floor_height_);
        cairo_clip(context());
        floor();
        for (std::size_t i = 0; i < picture_.robots.size(); ++i) path(picture_.robots[i], series_colour(i));
        for (const ThingPose* thing : from_low_to_high()) draw(*thing);
        for (const PictureOf::Robot& robot : picture_.robots) rays(robot);
        for (std::size_t i = 0; i < picture_.robots.size(); ++i) draw(picture_.robots[i], series_colour(i));
        if (picture_.robots.size() <= most_labels) {
            for (std::size_t i = 0; i < picture_.robots.size(); ++i) label(picture_.robots[i], series_colour(i));
        }
        cairo_restore(context());
        frame();
        return canvas_.write();
    }

private:
    // Chooses the scale; returns the canvas.
    Canvas layout(const std::string& file) {
        const Bounds bounds = bounds_of(picture_);
        const double width = bounds.right - bounds.left + 2 * around, height = bounds.top - bounds.bottom + 2 * around;
        scale_ = std::min({largest_width / width, largest_height / height, most_pixels_a_metre});
        floor_width_ = std::max(smallest_width, width * scale_);
        floor_height_ = std::max(smallest_height, height * scale_);
        centre_ = {(bounds.left + bounds.right) / 2, (bounds.bottom + bounds.top) / 2};
        return Canvas(file, floor_width_ + 2 * side, floor_height_ + picture_head + foot);
    }

    cairo_t* context() { return canvas_.context(); }
    double x(double metre) const { return side + floor_width_ / 2 + (metre - centre_.x) * scale_; }
    double y(double metre) const { return picture_head + floor_height_ / 2 - (metre - centre_.y) * scale_; }
    void line_width(double pixels) { cairo_set_line_width(context(), pixels); }

    std::vector<const ThingPose*> from_low_to_high() const {
        std::vector<const ThingPose*> order;
        for (const ThingPose& thing : picture_.things) order.push_back(&thing);
        const auto top = [](const ThingPose* thing) { return thing->pose.position.z + thing->size.z / 2; };
        std::stable_sort(order.begin(), order.end(),
                         [&](const ThingPose* one, const ThingPose* other) { return top(one) < top(other); });
        return order;
    }

    void floor() {
        canvas_.set(colour_of("#f4f2ee"));
        cairo_paint(context());
        // A grid with round distances of at least 45 px.
        const double step = round_length(45 / scale_);
        for (const int every : {1, 5}) {
            canvas_.set(colour_of(every == 1 ? "#e9e6e0" : "#dcd8d0"));
            line_width(1);
            const double apart = step * every;
            for (double at = std::ceil((centre_.x - floor_width_ / 2 / scale_) / apart) * apart;
                 x(at) <= side + floor_width_; at += apart) {
                cairo_move_to(context(), std::round(x(at)) + 0.5, picture_head);
                cairo_rel_line_to(context(), 0, floor_height_);
            }
            for (double at = std::ceil((centre_.y - floor_height_ / 2 / scale_) / apart) * apart; y(at) >= picture_head;
                 at += apart) {
                cairo_move_to(context(), side, std::round(y(at)) + 0.5);
                cairo_rel_line_to(context(), floor_width_, 0);
            }
            cairo_stroke(context());
        }
        if (picture_.floor) {
            const Point2D size = picture_.floor->size;
            if (auto image = read_(picture_.floor->image))
                canvas_.image(std::move(*image), x(-size.x / 2), y(size.y / 2), size.x * scale_, size.y * scale_);
        }
        for (const LineSpec& line : picture_.lines) draw(line);
    }

    void draw(const LineSpec& line) {
        cairo_save(context());
        cairo_set_line_width(context(), line.width * scale_);
        cairo_set_line_cap(context(), CAIRO_LINE_CAP_ROUND);
        cairo_set_line_join(context(), CAIRO_LINE_JOIN_ROUND);
        canvas_.set(colour_of(line.color));
        cairo_new_path(context());
        for (const Point2D& point : line.points) cairo_line_to(context(), x(point.x), y(point.y));
        cairo_stroke(context());
        cairo_restore(context());
    }

    void trace(const ThingPose& thing, double shift) {
        cairo_new_path(context());
        if (thing.shape == ThingPose::Shape::cylinder) {
            cairo_arc(context(), x(thing.pose.position.x) + shift, y(thing.pose.position.y) + shift,
                      thing.size.x / 2 * scale_, 0, 2 * std::numbers::pi);
        } else {
            for (const Point2D& corner : outline(thing))
                cairo_line_to(context(), x(corner.x) + shift, y(corner.y) + shift);
        }
        cairo_close_path(context());
    }

    void draw(const ThingPose& thing) {
        const Colour colour = colour_of(thing.color);
        trace(thing, std::clamp(thing.size.z * scale_ * 0.03, 1.5, 6.0));
        canvas_.set({0, 0, 0, 0.10});
        cairo_fill(context());
        trace(thing, 0);
        canvas_.set(colour);
        cairo_fill_preserve(context());
        canvas_.set(colour.shaded(-0.25));
        line_width(1.5);
        cairo_stroke(context());
    }

    // Draws the path of a robot; older parts are fainter.
    void path(const PictureOf::Robot& robot, const Colour& colour) {
        const auto& points = robot.path;
        if (points.empty()) return;
        constexpr std::size_t pieces = 24;
        line_width(std::clamp(0.012 * scale_, 2.0, 5.0));
        cairo_set_line_cap(context(), CAIRO_LINE_CAP_BUTT);
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            const std::size_t first = piece * points.size() / pieces, last = (piece + 1) * points.size() / pieces;
            if (first == last) continue;
            for (std::size_t i = first; i < last; ++i) cairo_line_to(context(), x(points[i].x), y(points[i].y));
            const Point2D& end = last < points.size() ? points[last] : robot.pose.position;
            cairo_line_to(context(), x(end.x), y(end.y));
            canvas_.set(colour.with_alpha(0.25 + 0.6 * static_cast<double>(piece) / pieces));
            cairo_stroke(context());
        }
        cairo_set_line_cap(context(), CAIRO_LINE_CAP_ROUND);
        canvas_.set(ink::paper);
        cairo_arc(context(), x(points.front().x), y(points.front().y), 5, 0, 2 * std::numbers::pi);
        cairo_fill_preserve(context());
        canvas_.set(colour);
        line_width(2);
        cairo_stroke(context());
    }

    void rays(const PictureOf::Robot& robot) {
        const bool crowd = robot.rays.size() > 8;
        for (const Ray& ray : robot.rays) {
            const Colour colour = colour_of(ray.hit ? "#e4572e" : "#9a9fa6");
            const double x1 = x(ray.from.x), y1 = y(ray.from.y), x2 = x(ray.to.x), y2 = y(ray.to.y);
            cairo_pattern_t* fading = cairo_pattern_create_linear(x1, y1, x2, y2);
            const double near = ray.hit ? 0.95 : 0.45, far = ray.hit ? 0.7 : 0.0;
            cairo_pattern_add_color_stop_rgba(fading, 0, colour.red, colour.green, colour.blue, near);
            cairo_pattern_add_color_stop_rgba(fading, 1, colour.red, colour.green, colour.blue, far);
            cairo_set_source(context(), fading);
            cairo_pattern_destroy(fading);
            line_width(crowd ? 1 : 1.5);
            cairo_move_to(context(), x1, y1);
            cairo_line_to(context(), x2, y2);
            cairo_stroke(context());
            if (!ray.hit) continue;
            canvas_.set(colour);
            cairo_arc(context(), x2, y2, crowd ? 2 : 3.2, 0, 2 * std::numbers::pi);
            cairo_fill(context());
        }
    }

    // A rounded rectangle in the body frame [m].
    void rounded(double cx, double cy, double length, double width, double radius) {
        const double l = length / 2, w = width / 2, quarter = std::numbers::pi / 2;
        cairo_new_path(context());
        cairo_arc(context(), cx + l - radius, cy + w - radius, radius, 0, quarter);
        cairo_arc(context(), cx - l + radius, cy + w - radius, radius, quarter, 2 * quarter);
        cairo_arc(context(), cx - l + radius, cy - w + radius, radius, 2 * quarter, 3 * quarter);
        cairo_arc(context(), cx + l - radius, cy - w + radius, radius, 3 * quarter, 4 * quarter);
        cairo_close_path(context());
    }

    void hull(const BodySpec& body) {
        if (body.shape == BodySpec::Shape::cylinder) {
            cairo_new_path(context());
            cairo_arc(context(), body.at.x, body.at.y, body.size.x / 2, 0, 2 * std::numbers::pi);
        } else {
            rounded(body.at.x, body.at.y, body.size.x, body.size.y, std::min(body.size.x, body.size.y) * 0.16);
        }
    }

    void draw(const PictureOf::Robot& robot, const Colour& colour) {
        const BodySpec& body = robot.body;
        cairo_save(context());
        cairo_translate(context(), x(robot.pose.position.x), y(robot.pose.position.y));
        cairo_scale(context(), scale_, -scale_);  // the units below are metres, y upwards
        cairo_rotate(context(), robot.pose.heading);
        const double pixel = 1 / scale_;

        // The wheels are visible beside the hull, or on it if it is wider than the track.
        const double thickness = std::max(0.012, robot.drive.track * 0.13);
        canvas_.set(colour_of("#22262b"));
        for (const double wheel : {-1.0, 1.0}) {
            rounded(0, wheel * robot.drive.track / 2, 2 * robot.drive.radius, thickness, thickness * 0.3);
            cairo_fill(context());
        }
        hull(body);
        canvas_.set(colour);
        cairo_fill_preserve(context());
        canvas_.set(colour.shaded(-0.35));
        line_width(1.6 * pixel);
        cairo_stroke(context());

        // An arrowhead shows the heading.
        const double size = std::min(body.size.x, body.size.y);
        const double tip = body.at.x + size * 0.34, tail = body.at.x - size * 0.24;
        cairo_move_to(context(), tip, body.at.y);
        cairo_line_to(context(), tail, body.at.y + size * 0.26);
        cairo_line_to(context(), tail + size * 0.14, body.at.y);
        cairo_line_to(context(), tail, body.at.y - size * 0.26);
        cairo_close_path(context());
        canvas_.set(ink::paper);
        cairo_fill(context());
        cairo_restore(context());
    }

    void label(const PictureOf::Robot& robot, const Colour& colour) {
        const double reach = std::hypot(robot.body.size.x, robot.body.size.y) / 2 * scale_;
        const double at_x = x(robot.pose.position.x);
        double at_y = y(robot.pose.position.y) + reach + 17;
        if (at_y > picture_head + floor_height_ - 6) at_y = y(robot.pose.position.y) - reach - 8;
        // An outline in the floor's colour keeps the letters readable on any background.
        cairo_move_to(context(), at_x - canvas_.text_width(robot.name, 13, true) / 2, at_y);
        cairo_text_path(context(), robot.name.c_str());
        canvas_.set(colour_of("#f4f2ee").with_alpha(0.85));
        line_width(3);
        cairo_stroke(context());
        canvas_.text(at_x, at_y, robot.name, 13, colour.shaded(-0.25), 0.5, true);
    }

    void frame() {
        canvas_.set(colour_of("#cfcac1"));
        line_width(1);
        cairo_rectangle(context(), side + 0.5, picture_head + 0.5, floor_width_ - 1, floor_height_ - 1);
        cairo_stroke(context());

        canvas_.text(side, picture_head - 22, picture_.title, 20, ink::text, 0, true);
        canvas_.text(side + floor_width_, picture_head - 22, fmt::format("t = {:.2f} s", picture_.seconds), 16,
                     ink::faint, 1);

        const double length = round_length(90 / scale_), bottom = picture_head + floor_height_ + 26;
        canvas_.set(ink::text);
        line_width(2);
        cairo_set_line_cap(context(), CAIRO_LINE_CAP_BUTT);
        cairo_move_to(context(), side + 1, bottom - 5);
        cairo_rel_line_to(context(), 0, 10);
        cairo_move_to(context(), side + 1, bottom);
        cairo_rel_line_to(context(), length * scale_, 0);
        cairo_move_to(context(), side + 1 + length * scale_, bottom - 5);
        cairo_rel_line_to(context(), 0, 10);
        cairo_stroke(context());
        canvas_.text(side + length * scale_ + 12, bottom + 5, metres(length), 14, ink::text);
    }

    PictureOf picture_;
    const PictureReader& read_;
    double scale_ = 1;  // [px/m]
    double floor_width_ = 0, floor_height_ = 0;
    Point2D centre_;
    Canvas canvas_;  // declared after the members that `layout` sets
};

}  // namespace

PictureOf look_at(const RunningSystem& live, const Trajectories& trajectories, std::string title) {
    const System& system = live.system();
    PictureOf picture{.title = std::move(title),
                      .seconds = system.now().seconds,
                      .floor = live.spec().arena.floor,
                      .lines = live.spec().arena.lines};
    const World* world = system.world();
    if (world == nullptr) return picture;
    picture.things = world->things();
    for (const Robot* robot : system.robots()) {
        if (robot->is_real()) continue;  // its true pose is unknown
        picture.robots.push_back({robot->name(), robot->spec().body, robot->spec().drive,
                                  world->truth(robot->id()).pose, world->rays(robot->id()),
                                  trajectories.of(robot->name())});
    }
    return picture;
}

Expected<void> draw_picture(PictureOf picture, const std::string& file, const PictureReader& read) {
    return PicturePainter(std::move(picture), file, read).paint();
}

}  // namespace nezumi::draw
