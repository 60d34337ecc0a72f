#include "result/plot_frames.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "result/frames.hpp"
#include "result/table.hpp"

namespace signorini::result {

namespace {

constexpr std::size_t max_pictures = 40;  // limit; if there are more frames, 40 are selected evenly
// Largest number of contacts whose labels show the forces; with more contacts labels show names only.
constexpr std::size_t max_labelled = 6;
// Limit of the number of contacts; with more contacts there are no labels.
constexpr std::size_t max_names = 30;

struct ShapePoint {
  std::string kind;
  FrameEnd at;
  double magnification;
};

/// Columns of frame-1-shape.csv: undeformed positions, and deformed positions as drawn.
const CsvTable<ShapePoint>& shape_table() {
  using P = ShapePoint;
  static const CsvTable<P> table = {{"kind", &P::kind},
                                    {"x", [](const P& p) { return p.at.x; }},
                                    {"y", [](const P& p) { return p.at.y; }},
                                    {"X", [](const P& p) { return p.at.x + p.magnification * p.at.ux; }},
                                    {"Y", [](const P& p) { return p.at.y + p.magnification * p.at.uy; }}};
  return table;
}

/// Text of frame-1-shape.csv. gnuplot ends a drawn line at a blank line; connected elements are drawn as one line, so
/// that no joint is visible.
std::string shape_text(const Frame& frame, double magnification) {
  const int steps = frame.elements.size() > 2000 ? 1 : 12;
  CsvBlock all;
  shape_table().put_header(all);
  std::string text = all.str();
  for (std::size_t k = 0; k < frame.elements.size(); ++k) {
    const Frame::Element& e = frame.elements[k];
    const int n = e.kind == "beam" ? steps : 1;
    CsvBlock block;
    for (int i = 0; i <= n; ++i)
      shape_table().put_row(block, {e.kind, between(e, static_cast<double>(i) / n), magnification});
    text += block.str();
    const Frame::Element* next = k + 1 < frame.elements.size() ? &frame.elements[k + 1] : nullptr;
    if (!next || next->kind != e.kind || next->a.x != e.b.x || next->a.y != e.b.y) text += "\n";
  }
  CsvBlock block;
  for (const Frame::Point& p : frame.points)
    shape_table().put_row(block, {p.support ? "support" : "node", p.at, magnification});
  return text + block.str();
}

/// Columns of frame-1-forces.csv: tip (x, y) and vector (dx, dy) of the arrow of a contact force.
CsvTable<Frame::Force> force_table(const FrameScales& scales) {
  using F = Frame::Force;
  const double m = scales.magnification, s = scales.force_scale;
  return {{"contact", &F::contact},
          {"state", &F::state},
          {"x", [m](const F& f) { return f.x + m * f.ux; }},
          {"y", [m](const F& f) { return f.y + m * f.uy; }},
          {"dx", [s](const F& f) { return s * f.fx; }},
          {"dy", [s](const F& f) { return s * f.fy; }}};
}

struct Layout {
  Canvas canvas;
  double x0, x1, y0, y1;
};

/// Equal scales in both directions: the picture's height follows from the shape.
Layout layout_of(const FrameScales& scales, const PlottedRun& run) {
  constexpr double air = 0.09;
  const double size = std::max({scales.x1 - scales.x0, scales.y1 - scales.y0, 1e-300});
  Layout l;
  l.canvas = canvas_of(run.look, 0.0, false);
  const double width = (l.canvas.right(run.legend) - l.canvas.left()) * l.canvas.width;
  l.x0 = scales.x0 - air * size, l.x1 = scales.x1 + air * size;
  l.y0 = scales.y0 - air * size, l.y1 = scales.y1 + air * size;
  const double panel = std::clamp(width * (l.y1 - l.y0) / (l.x1 - l.x0), std::min(220.0, width), 640.0);
  const double wider = (l.y1 - l.y0) * width / panel, higher = (l.x1 - l.x0) * panel / width;
  const double dx = std::max(0.0, wider - (l.x1 - l.x0)), dy = std::max(0.0, higher - (l.y1 - l.y0));
  l.x0 -= 0.5 * dx, l.x1 += 0.5 * dx;
  l.y0 -= 0.5 * dy, l.y1 += 0.5 * dy;
  l.canvas.height = std::round(panel + margin_above + margin_below);
  return l;
}

/// gnuplot lines for the labels of contacts, at the tails of their arrows.
std::string labels(const Frame& frame, const FrameScales& scales, const Layout& l, const PlottedRun& run) {
  std::string s;
  const bool figures = frame.forces.size() <= max_labelled;
  if (frame.forces.size() > max_names) return s;
  for (const Frame::Force& f : frame.forces) {
    const double length = std::hypot(f.fx, f.fy);
    // Without a force the label is where the arrow of a compressive force would be.
    const double dx = length > 0.0 ? -f.fx / length : -f.nx, dy = length > 0.0 ? -f.fy / length : -f.ny;
    const double x = f.x + scales.magnification * f.ux - scales.force_scale * f.fx;
    const double y = f.y + scales.magnification * f.uy - scales.force_scale * f.fy;
    std::string text = f.contact;
    if (figures && f.state == "open") text += ": " + translate(run, "open");
    if (figures && f.state != "open") {
      text += fmt::format(": N = {:.4g}", f.N);
      if (f.T != 0.0) text += fmt::format(", T = {:.4g}", f.T);
      text += " " + run.facts.units.force;
    }
    const bool sideways = std::abs(dx) > 2.0 * std::abs(dy);
    const bool upright = !figures && !sideways;  // vertical text: many names side by side
    const double part = (x - l.x0) / (l.x1 - l.x0);
    const char* side = upright       ? (dy < 0.0 ? "right rotate by 90" : "left rotate by 90")
                       : sideways    ? (dx > 0.0 ? "left" : "right")
                       : part > 0.75 ? "right"  // text ends inside the panel
                       : part < 0.2  ? "left"
                                     : "center";
    s += fmt::format("set label {} at {},{} {} offset character {:.2f},{:.2f} front font ',{:.4g}'\n",
                     signorini::result::quoted(text), base::format_number(x), base::format_number(y), side,
                     0.8 * dx, 0.9 * dy, l.canvas.font(figures ? 11.0 : 9.0));
  }
  return s;
}

/// Subtitle "Shape at t = ...": time, translation and magnification of the picture.
std::string subtitle(const Frame& frame, const FrameScales& scales, const PlottedRun& run) {
  const bool slid = frame.translation_x != 0.0 || frame.translation_y != 0.0;
  const auto number = [](double x, int digits) { return fmt::format("{:.{}g}", x, digits); };
  const Units& units = run.facts.units;
  std::string about = translate(run, "Shape at t = {} {}", number(frame.t, 9), units.time) + ", ";
  about += slid ? translate(run, "slid by ({}, {}) {}, deformation", number(frame.translation_x, 4),
                            number(frame.translation_y, 4), units.length)
                : translate(run, "displacements");
  about += " " + (scales.magnification == 1.0
                      ? translate(run, "in true scale")
                      : translate(run, "magnified {} times", number(scales.magnification, 6)));
  if (scales.greatest_force > 0.0)
    about += "; " +
             translate(run, "longest arrow of the run: {} {}", number(scales.greatest_force, 4), units.force);
  return about;
}

/// Curves of elements, nodes and supports, undeformed and deformed.
std::vector<Curve> shape_curves(const Frame& frame, const std::string& name, const PlottedRun& run) {
  const std::string shape = quoted(name + "-shape.csv") + " skip 1";
  const auto has = [&](const std::string& kind) {
    return std::any_of(frame.elements.begin(), frame.elements.end(),
                       [&](const auto& e) { return e.kind == kind; });
  };
  std::vector<Curve> curves;
  const auto add = [&](const char* kind, const char* x, const char* y, const std::string& look,
                       const std::optional<std::string>& title = std::nullopt) {
    const CsvTable<ShapePoint>& table = shape_table();
    curves.push_back(
        {shape,
         fmt::format("({} eq '{}' ? {} : NaN):{}", table.word("kind"), kind, table.value(x), table.number(y)),
         "with " + look, title});
  };
  const std::string thin = "lines linewidth 0.8 linecolor '#b0b0b0'";
  const auto line = [&](const char* kind, const char* look, const char* title) {
    if (!has(kind)) return;
    add(kind, "x", "y", thin);
    add(kind, "X", "Y", std::string("lines ") + look, translate(run, title));
  };
  line("mesh", "linewidth 0.8 linecolor '#1f5f8b'", "mesh");
  line("spring", "linewidth 1 linecolor '#7a9a7a' dashtype 2", "springs");
  line("bar", "linewidth 1.6 linecolor '#1f5f8b'", "bars");
  line("rigid", "linewidth 1.6 linecolor '#8a5a2b'", "rigid bodies");
  line("beam", "linewidth 2.2 linecolor '#1a1a1a'", "beams");
  if (!curves.empty()) curves.push_back({"keyentry", "", "with " + thin, translate(run, "undeformed")});
  add("node", "x", "y", "points pointtype 6 pointsize 0.5 linecolor '#b0b0b0'");
  add("node", "X", "Y", "points pointtype 7 pointsize 0.6 linecolor '#1a1a1a'", translate(run, "nodes"));
  if (std::any_of(frame.points.begin(), frame.points.end(), [](const auto& p) { return p.support; }))
    add("support", "X", "Y", "points pointtype 5 pointsize 1 linecolor '#555555'",
        translate(run, "supports"));
  return curves;
}

/// Adds arrows of the contact forces, and contact points in the colours of their states.
void add_forces(const Frame& frame, const std::string& name, const PlottedRun& run,
                std::vector<Curve>& curves) {
  if (frame.forces.empty()) return;
  const std::string forces = quoted(name + "-forces.csv") + " skip 1";
  const CsvTable<Frame::Force> table = force_table({});
  curves.push_back({forces,
                    fmt::format("({}-{}):({}-{}):{}:{}", table.value("x"), table.value("dx"),
                                table.value("y"), table.value("dy"), table.number("dx"), table.number("dy")),
                    "with vectors head filled size screen 0.009,18 linewidth 1.8 linecolor '#c0182b'",
                    translate(run, "contact force")});
  for (const std::string& state : state_names()) {
    const bool occurs = std::any_of(frame.forces.begin(), frame.forces.end(),
                                    [&](const auto& f) { return f.state == state; });
    if (occurs)
      curves.push_back({forces,
                        "(" + table.word("state") + " eq " + quoted(state) +
                            fmt::format(" ? {} : NaN):{}", table.value("x"), table.number("y")),
                        "with points pointtype 7 pointsize 1.1 linecolor '" + state_colour(state) + "'",
                        translate(run, state)});
  }
}

Picture picture_of(const Frame& frame, const FrameScales& scales, const PlottedRun& run,
                   const std::string& name) {
  const Layout l = layout_of(scales, run);
  const Units& units = run.facts.units;
  Panel panel{"y [" + units.length + "]", shape_curves(frame, name, run)};
  add_forces(frame, name, run, panel.curves);
  panel.axes = "set xlabel " + quoted("x [" + units.length + "]") + "\nset offsets 0,0,0,0\nset grid back\n" +
               range_of('x', l.x0, l.x1) + range_of('y', l.y0, l.y1) + labels(frame, scales, l, run);
  panel.after = "unset label\n";
  return {name, subtitle(frame, scales, run), l.canvas, false, {panel}};
}

}  // namespace

void add_frame_pictures(const PlottedRun& run, PictureFiles& pictures) {
  std::vector<Frame> frames = run.frames;
  if (frames.empty()) return;
  subtract_translations(frames);
  const FrameScales shared = scales_of(frames, run.greatest_force);
  const std::size_t count = std::min(frames.size(), max_pictures);
  for (std::size_t i = 0; i < count; ++i) {
    const Frame& frame = frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)];
    const FrameScales scales = scales_of(frame, shared);
    const std::string name = fmt::format("frame-{}", i + 1);
    pictures.add_table(name + "-shape", shape_text(frame, scales.magnification));
    pictures.add_table(name + "-forces", force_table(scales).text(frame.forces));
    pictures.add(run, picture_of(frame, scales, run, name));
  }
}

}  // namespace signorini::result
