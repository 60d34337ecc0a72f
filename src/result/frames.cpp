#include "result/frames.hpp"

#include <algorithm>
#include <cmath>

#include "model/assembly/loads.hpp"

namespace signorini::result {

NodeDisplacements::NodeDisplacements(const Scene& scene, const Model& model) : movers_(scene.nodes.size()) {
  for (std::size_t n = 0; n < scene.nodes.size(); ++n)  // the drawn nodes begin with the nodes of the scene
    for (const std::size_t c : {0U, 1U}) movers_[n][c].dof = model.drawn_nodes[n].dofs[c];
  for (const Support& support : scene.supports) {
    if (!support.motion || support.rz) continue;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
      if (scene.nodes[n].name == support.node)
        movers_[n][support.ux ? 0 : 1].given = assembly::motion_of_support(scene, support);
  }
}

double NodeDisplacements::value(std::size_t node, std::size_t axis, const Sample& sample, int order) const {
  const NodeComponent& mover = movers_[node][axis];
  if (mover.given) return mover.given->piece(sample.t).value(sample.t, order);
  return mover.dof >= 0 ? (order == 0 ? *sample.u : *sample.v)[mover.dof] : 0.0;
}

namespace {

const char* name_of(DrawnElement::Kind kind) {
  switch (kind) {
    case DrawnElement::Kind::bar:
      return "bar";
    case DrawnElement::Kind::spring:
      return "spring";
    case DrawnElement::Kind::rigid:
      return "rigid";
    case DrawnElement::Kind::mesh:
      return "mesh";
    case DrawnElement::Kind::beam:
      break;
  }
  return "beam";
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model),
      shapes_(directory / "frames.csv", frame_table()),
      contacts_(directory / "frame_contacts.csv", frame_contact_table()) {}

void FrameWriter::write(const Sample& sample) {
  write_shape(sample);
  write_contacts(sample);
}

void FrameWriter::write_shape(const Sample& sample) {
  int element = 0;
  for (const DrawnElement& e : model_.drawing) {
    ++element;
    for (const int node : e.nodes)
      shapes_.add({sample.t, name_of(e.kind), element, model_.drawn_nodes[static_cast<std::size_t>(node)],
                   *sample.u});
  }
  for (const DrawnNode& node : model_.drawn_nodes)
    if (node.named) shapes_.add({sample.t, node.held ? "support" : "node", std::nullopt, node, *sample.u});
  shapes_.flush();
}

void FrameWriter::write_contacts(const Sample& sample) {
  for (std::size_t k = 0; k < model_.drawn_contacts.size() && k < sample.contacts.size(); ++k) {
    const DrawnContact& c = model_.drawn_contacts[k];
    if (c.node < 0) continue;
    contacts_.add({sample.t, model_.contacts[k], c, model_.drawn_nodes[static_cast<std::size_t>(c.node)],
                   sample.contacts[k], *sample.u});
  }
  contacts_.flush();
}

namespace {

/// Columns of frames.csv with position, displacement and rotation of a node.
class EndColumns {
 public:
  explicit EndColumns(const CsvReader& rows)
      : x_(rows.column("x")),
        y_(rows.column("y")),
        ux_(rows.column("ux")),
        uy_(rows.column("uy")),
        rz_(rows.column("rz")) {}
  [[nodiscard]] FrameEnd of(const CsvReader& row) const {
    return {row.number(x_), row.number(y_), row.number(ux_), row.number(uy_), row.number(rz_)};
  }

 private:
  std::size_t x_, y_, ux_, uy_, rz_;
};

void read_shapes(const TableFolder& tables, double from, double to, std::vector<Frame>& frames) {
  CsvReader rows = tables.open("frames.csv");
  const std::size_t kind = rows.column("kind"), node = rows.column("node");
  const EndColumns ends(rows);
  bool half = false;
  while (rows.next()) {
    const double t = rows.t();
    if (t < from || t > to) continue;
    if (frames.empty() || frames.back().t != t) {
      frames.emplace_back().t = t;
      half = false;
    }
    Frame& frame = frames.back();
    const std::string& what = rows.cell(kind);
    if (what == "node" || what == "support") {
      frame.points.push_back({rows.cell(node), what == "support", ends.of(rows)});
    } else if (half) {
      frame.elements.back().b = ends.of(rows);
      half = false;
    } else {
      frame.elements.push_back({what, ends.of(rows), ends.of(rows)});
      half = true;
    }
  }
}

void read_forces(const TableFolder& tables, std::vector<Frame>& frames) {
  CsvReader rows = tables.open("frame_contacts.csv");
  const auto number = [&](const char* name) { return rows.number(rows.column(name)); };
  std::size_t i = 0;
  while (rows.next()) {
    const double t = rows.t();
    while (i < frames.size() && frames[i].t < t) ++i;
    if (i == frames.size() || frames[i].t != t) continue;
    Frame::Force f;
    f.contact = rows.cell(rows.column("contact"));
    f.state = rows.cell(rows.column("state"));
    f.x = number("x"), f.y = number("y"), f.ux = number("ux"), f.uy = number("uy");
    f.nx = number("nx"), f.ny = number("ny"), f.N = number("N"), f.T = number("T");
    f.fx = -f.N * f.nx - f.T * number("tx");
    f.fy = -f.N * f.ny - f.T * number("ty");
    frames[i].forces.push_back(f);
  }
}

struct Box {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
  void add(double x, double y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  [[nodiscard]] double size() const { return x1 >= x0 ? std::hypot(x1 - x0, y1 - y0) : 0.0; }
};

/// Largest value of 1, 2 or 5 times a power of ten that is not above x.
double round_down(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0) * power;
}

}  // namespace

std::vector<Frame> read_frames(const TableFolder& tables, double from, double to) {
  std::vector<Frame> frames;
  if (!tables.has("frames.csv")) return frames;
  read_shapes(tables, from, to, frames);
  read_forces(tables, frames);
  return frames;
}

double magnification_of(double size, double greatest) {
  constexpr double largest_displacement = 0.125;
  const double wanted = greatest > 0.0 ? largest_displacement * size / greatest : 1.0;
  return wanted > 0.0 && std::isfinite(wanted) ? round_down(wanted) : 1.0;
}

namespace {

/// Position and displacement at the fraction s between two ends, both interpolated linearly.
FrameEnd straight_between(const FrameEnd& a, const FrameEnd& b, double s) {
  FrameEnd p;
  p.x = a.x + s * (b.x - a.x);
  p.y = a.y + s * (b.y - a.y);
  p.ux = a.ux + s * (b.ux - a.ux);
  p.uy = a.uy + s * (b.uy - a.uy);
  return p;
}

}  // namespace

FrameEnd between(const Frame::Element& e, double s) {
  return e.kind == "beam" ? between(e.a, e.b, s, element::hermite_shapes(s)) : straight_between(e.a, e.b, s);
}

FrameEnd between(const FrameEnd& a, const FrameEnd& b, double s, const element::LineShapes& h) {
  FrameEnd p = straight_between(a, b, s);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0.0)) return p;
  const double c = (b.x - a.x) / length, d = (b.y - a.y) / length;
  const double va = -d * a.ux + c * a.uy, vb = -d * b.ux + c * b.uy;
  const double v = h.a * va + h.b * vb + length * (h.rotation_a * a.rz + h.rotation_b * b.rz);
  const double more = v - (va + s * (vb - va));  // deviation from linear interpolation
  p.ux += -d * more;
  p.uy += c * more;
  return p;
}

namespace {

void shift(FrameEnd& end, double x, double y) {
  end.x += x;
  end.y += y;
  end.ux -= x;
  end.uy -= y;
}

}  // namespace

void subtract_translations(std::vector<Frame>& frames) {
  double greatest = 0.0, left = 0.0;
  for (Frame& frame : frames) {
    for (const auto& p : frame.points) {
      frame.translation_x += p.at.ux / static_cast<double>(frame.points.size());
      frame.translation_y += p.at.uy / static_cast<double>(frame.points.size());
    }
    for (const auto& p : frame.points) {
      greatest = std::max(greatest, std::hypot(p.at.ux, p.at.uy));
      left = std::max(left, std::hypot(p.at.ux - frame.translation_x, p.at.uy - frame.translation_y));
    }
  }
  const bool slides = left < 0.5 * greatest;
  for (Frame& frame : frames) {
    if (!slides || frame.points.size() < 2) {
      frame.translation_x = frame.translation_y = 0.0;
      continue;
    }
    const double x = frame.translation_x, y = frame.translation_y;
    for (auto& e : frame.elements) shift(e.a, x, y), shift(e.b, x, y);
    for (auto& p : frame.points) shift(p.at, x, y);
    for (auto& f : frame.forces) f.x += x, f.y += y, f.ux -= x, f.uy -= y;
  }
}

FrameScales scales_of(const std::vector<Frame>& frames, double greatest_force) {
  constexpr double arrow = 0.16;
  FrameScales scales;
  scales.greatest_force = greatest_force;
  Box rest;
  double greatest = 0.0;
  for (const Frame& frame : frames) {
    for (const auto& point : frame.points) {
      rest.add(point.at.x, point.at.y);
      greatest = std::max(greatest, std::hypot(point.at.ux, point.at.uy));
    }
    for (const auto& e : frame.elements) greatest = std::max(greatest, std::hypot(e.b.ux, e.b.uy));
    for (const auto& f : frame.forces)
      scales.greatest_force = std::max(scales.greatest_force, std::hypot(f.fx, f.fy));
  }
  double size = rest.size();
  scales.magnification = std::max(1.0, magnification_of(size, greatest));

  Box drawn = rest;
  const double m = scales.magnification;
  for (const Frame& frame : frames) {
    for (const auto& e : frame.elements)
      for (const double s : {0.0, 0.5, 1.0}) {
        const FrameEnd p = between(e, s);
        drawn.add(p.x + m * p.ux, p.y + m * p.uy);
      }
    for (const auto& p : frame.points) drawn.add(p.at.x + m * p.at.ux, p.at.y + m * p.at.uy);
  }
  size = drawn.size() > 0.0 ? drawn.size() : 1.0;
  if (scales.greatest_force > 0.0) scales.force_scale = arrow * size / scales.greatest_force;
  const Box shapes = drawn;
  for (const Frame& frame : frames)
    for (const auto& f : frame.forces)
      drawn.add(f.x + m * f.ux - scales.force_scale * f.fx, f.y + m * f.uy - scales.force_scale * f.fy);
  if (!(shapes.size() > 0.0))
    drawn.add(drawn.x0 - 0.5 * size, drawn.y0), drawn.add(drawn.x1 + 0.5 * size, drawn.y1);
  scales.x0 = drawn.x0, scales.x1 = drawn.x1, scales.y0 = drawn.y0, scales.y1 = drawn.y1;
  return scales;
}

FrameScales scales_of(const Frame& frame, const FrameScales& shared) {
  constexpr double own_scale_ratio = 5.0;
  const FrameScales own = scales_of(std::vector<Frame>{frame}, shared.greatest_force);
  return own.magnification >= own_scale_ratio * shared.magnification ? own : shared;
}

}  // namespace signorini::result
