#include "result/run_tables.hpp"

#include <cmath>
#include <variant>

namespace signorini::result {
namespace {

double at(const Vector& u, int dof) { return dof < 0 ? 0.0 : u[dof]; }  // dof < 0: fixed by a support

/// Writes a member of an event as a cell; a contact is written by name.
struct EventCell {
  CsvBlock& block;
  const Model& model;

  void operator()(double value) const { block.number(value); }
  void operator()(const std::optional<double>& value) const { block.number(value); }
  void operator()(int contact) const { block.text(model.contacts[static_cast<std::size_t>(contact)].name); }
  void operator()(EventType type) const { block.text(signorini::to_string(type)); }
  void operator()(State state) const { block.text(signorini::to_string(state)); }
};

}  // namespace

std::optional<double> friction_ratio(const Contact& contact, const ContactSample& s) {
  if (!contact.has_friction() || is_open(s.state) || s.N == 0.0) return std::nullopt;
  return std::abs(s.T) / std::abs(s.N);
}

CsvTable<Event> event_table(const Model& model) {
  CsvTable<Event> table;
  for (const EventColumn& column : event_columns)
    table.add_put(column.name, [&model, &column](CsvBlock& block, const Event& event) {
      if (event.contact < 0 && column.of_contact)
        block.empty();
      else
        std::visit([&](const auto field) { EventCell{block, model}(event.*field); }, column.field);
    });
  return table;
}

const CsvTable<ContactRow>& contact_table() {
  using R = ContactRow;
  static const CsvTable<R> table = {
      {"t", &R::t},
      {"contact", [](const R& r) { return std::string_view(r.contact.name); }},
      {"state", [](const R& r) { return signorini::to_string(r.sample.state); }},
      {"gap", [](const R& r) { return r.contact.optional_gap(r.sample.gap); }},
      {"ut", [](const R& r) { return r.sample.ut; }},
      {"vt", [](const R& r) { return r.sample.vt; }},
      {"slip", [](const R& r) { return r.sample.slip; }},
      {"N", [](const R& r) { return r.sample.N; }},
      {"T", [](const R& r) { return r.sample.T; }},
      {"ratio", [](const R& r) { return friction_ratio(r.contact, r.sample); }},
  };
  return table;
}

CsvTable<Sample> history_table(const Model& model) {
  CsvTable<Sample> table = {{"t", &Sample::t}};
  for (const Column& column : model.columns)
    table.add(column.name, [&column](const Sample& s) { return column.value(*s.u, *s.v); });
  return table;
}

CsvTable<ResponseRow> response_table(const Model& model) {
  CsvTable<ResponseRow> table = {{"t", &ResponseRow::t}};
  for (std::size_t i = 0; i < model.outputs.size(); ++i)
    table.add(model.outputs[i].name, [i](const ResponseRow& r) { return r.values[i]; });
  return table;
}

const CsvTable<Sample>& energy_table() {
  static const CsvTable<Sample> table = [] {
    CsvTable<Sample> t = {{"t", &Sample::t}};
    for (const EnergyColumn& column : energy_columns)
      t.add(column.name, [&column](const Sample& s) { return s.energy.*column.value; });
    t.add(balance_column, [](const Sample& s) { return s.energy.balance(); });
    return t;
  }();
  return table;
}

const CsvTable<CurveRow>& curve_table() {
  using R = CurveRow;
  static const CsvTable<R> table = {{"curve", [](const R& r) { return std::string_view(r.curve); }},
                                    {"t", [](const R& r) { return r.point.t; }},
                                    {"value", [](const R& r) { return r.point.value; }}};
  return table;
}

const CsvTable<FrameRow>& frame_table() {
  using R = FrameRow;
  static const CsvTable<R> table = {
      {"t", &R::t},
      {"kind", &R::kind},
      {"element", [](const R& r) { return r.element; }},
      {"node", [](const R& r) { return std::string_view(r.node.name); }},
      {"x", [](const R& r) { return r.node.x; }},
      {"y", [](const R& r) { return r.node.y; }},
      {"ux", [](const R& r) { return at(r.u, r.node.dofs[0]); }},
      {"uy", [](const R& r) { return at(r.u, r.node.dofs[1]); }},
      {"rz", [](const R& r) { return at(r.u, r.node.dofs[2]); }},
  };
  return table;
}

const CsvTable<FrameContactRow>& frame_contact_table() {
  using R = FrameContactRow;
  static const CsvTable<R> table = {
      {"t", &R::t},
      {"contact", [](const R& r) { return std::string_view(r.contact.name); }},
      {"state", [](const R& r) { return signorini::to_string(r.sample.state); }},
      {"node", [](const R& r) { return std::string_view(r.node.name); }},
      {"x", [](const R& r) { return r.drawn.x; }},
      {"y", [](const R& r) { return r.drawn.y; }},
      {"ux", [](const R& r) { return at(r.u, r.node.dofs[0]); }},
      {"uy", [](const R& r) { return at(r.u, r.node.dofs[1]); }},
      {"nx", [](const R& r) { return r.drawn.nx; }},
      {"ny", [](const R& r) { return r.drawn.ny; }},
      {"tx", [](const R& r) { return r.drawn.tx; }},
      {"ty", [](const R& r) { return r.drawn.ty; }},
      {"N", [](const R& r) { return r.sample.N; }},
      {"T", [](const R& r) { return r.sample.T; }},
  };
  return table;
}

const CsvTable<SeamRow>& seam_table() {
  using R = SeamRow;
  static const CsvTable<R> table = {{"t", &R::t},       {"seam", &R::seam},     {"N", &R::N},
                                    {"T", &R::T},       {"moment", &R::moment}, {"stick", &R::stick},
                                    {"slip", &R::slip}, {"open", &R::open}};
  return table;
}

SeamRow seam_row(const SeamSpec& seam, double t, const std::vector<ContactSample>& contacts) {
  SeamRow row{t, seam.name};
  double length = 0.0, x = 0.0, y = 0.0;
  for (const SeamNode& k : seam.nodes) {
    length += k.length;
    x += k.length * k.at[0];
    y += k.length * k.at[1];
  }
  x /= length;
  y /= length;
  for (std::size_t i = 0; i < seam.nodes.size(); ++i) {
    const SeamNode& k = seam.nodes[i];
    const ContactSample& c = contacts[seam.first_contact + i];
    row.N += c.N;
    row.T += c.T;
    const auto [nx, ny] = k.normal;  // the tangent is (ny, -nx)
    const double fx = -c.N * nx - c.T * ny, fy = -c.N * ny + c.T * nx;
    row.moment += (k.at[0] - x) * fy - (k.at[1] - y) * fx;
    (is_open(c.state) ? row.open : kind_of(c.state) == State::stick ? row.stick : row.slip) += k.length;
  }
  return row;
}

}  // namespace signorini::result
