#include "model/outputs/make_outputs.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/curves.hpp"
#include "model/outputs/reactions.hpp"
#include "model/outputs/structure_rows.hpp"
#include "model/reduce/reduction.hpp"
#include "scene/components.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/quantities.hpp"
#include "scene/units.hpp"
#include "signorini/output.hpp"

namespace signorini::outputs {
namespace {

Combination form_of(const Vector& x) {
  Combination form;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (x[i] != 0.0) form.terms.emplace_back(static_cast<int>(i), x[i]);
  return form;
}

/// Converts a form on the physical degrees of freedom to a form on the computed degrees of freedom.
Combination computed(const Vector& x, const Model& model) {
  if (model.reduction) return form_of(model.reduction->shapes.transpose() * x);
  if (model.basis) return form_of(model.basis->transpose() * x);
  return form_of(x);
}

bool is_motion(OutputKind kind) {
  return kind == OutputKind::displacement || kind == OutputKind::relative || kind == OutputKind::velocity ||
         kind == OutputKind::acceleration;
}

class Maker {
 public:
  Maker(const Scene& scene, const assembly::DofMap& map, const Model& model)
      : scene_(scene), map_(map), model_(model) {
    if (!map.is_matrix_scene()) rows_.emplace(scene, map, model.alpha, model.beta);
  }

  Output make(const OutputSpec& spec, const std::vector<Output>& before) {
    Output output;
    output.name = spec.name;
    output.kind = spec.kind;
    output.unit = scene::unit_of_output(spec, scene_.outputs);
    if (spec.kind == OutputKind::contact) {
      of_contact(spec, output);
    } else if (spec.kind == OutputKind::combination) {
      combine(spec, before, output);
    } else if (spec.kind == OutputKind::envelope) {
      envelope(spec, output);
    } else if (spec.kind == OutputKind::stress && spec.fibre == Fibre::both &&
               spec.quantity != OutputQuantity::N && !is_body_stress(spec.quantity)) {
      section_extremes(spec, output);
    } else {
      PhysicalRow row(map_.size());
      fill(spec, row, output);
      take(row, output);
    }
    return output;
  }

  /// Sum of all reactions along x (0) or y (1), minus loads and inertia; zero up to the residual.
  Output reaction_sum(std::size_t c) {
    PhysicalRow row(map_.size());
    std::vector<bool> held(map_.mesh.nodes.size(), false);
    for (const Support& support : scene_.supports) {
      const auto node = static_cast<std::size_t>(map_.mesh.by_name.at(support.node));
      if (!(c == 0 ? support.ux : support.uy) || held[node]) continue;
      for (const int all : nodes_moving_with(static_cast<int>(node))) {
        held[static_cast<std::size_t>(all)] = true;
        rows_->add_reaction(row, all, c, 1.0);
      }
    }
    rows_->add_total(row, c);
    Output sum;
    sum.kind = OutputKind::reaction;
    sum.unit = unit::force;
    take(row, sum);
    return sum;
  }

 private:
  [[noreturn]] static void refuse(const OutputSpec& spec, const char* key, const std::string& message) {
    throw SceneError(spec.place, fmt::format("output.{}.{}", spec.name, key), message);
  }

  void take(const PhysicalRow& row, Output& output) const {
    output.u = computed(row.u, model_);
    output.v = computed(row.v, model_);
    output.a = computed(row.a, model_);
    if (model_.reduction && !is_motion(output.kind)) balance(row, output);
    output.forces = row.forces;
    output.given = row.given;
    output.constant = row.constant;
    for (const LoadCorrection& seen : model_.load_corrections) see(seen, row, output);
    for (const PhysicalRow::CurvedContact& bowl : row.curved_contacts) restore(bowl, output);
  }

  /// Removes terms that the reduced equation of motion neglects: inertia of massless shapes, and damping of massless shapes
  /// that respond immediately. Internal forces balance the loads only without these terms.
  void balance(const PhysicalRow& row, Output& output) const {
    const Reduction& reduction = *model_.reduction;
    Vector v = reduction.shapes.transpose() * row.v, a = reduction.shapes.transpose() * row.a;
    const Vector dampers = reduction.shapes.transpose() * (row.v - row.rayleigh);
    const bool creep = reduce::static_shapes_are_damped(model_.beta, reduction.first_truncated);
    for (Eigen::Index j = 0; j < a.size(); ++j) {
      if (!model_.dofs[static_cast<std::size_t>(j)].massless) continue;
      a[j] = 0.0;
      if (!creep) v[j] = dampers[j];
    }
    output.v = form_of(v);
    output.a = form_of(a);
  }

  void see(const LoadCorrection& seen, const PhysicalRow& row, Output& output) const {
    const Load& load = model_.loads[seen.load];
    const auto part = [&](const Vector& form) {
      return form.head(seen.displacements.size()).dot(seen.displacements);
    };
    const double u = part(row.u), v = part(row.v), a = part(row.a);
    if (v == 0.0 && a == 0.0) {
      if (u != 0.0) output.given.push_back({load.history.scaled(u), load.name, u, load.history_unit});
      return;
    }
    output.given.push_back({load.history.with_rates(u, v, a)});
  }

  /// Adds the restoring force N u / R of a pendulum minus N_0 u / R, the force of the scene's spring, which the row already
  /// contains.
  void restore(const PhysicalRow::CurvedContact& bowl, Output& output) const {
    const Contact& contact = model_.contacts[bowl.contact];
    const CurvedSurface& in_scene = *scene_.contacts[bowl.contact].pendulum_surface;
    output.restoring.push_back(
        {bowl.contact, contact.body_tangent(), bowl.factor / in_scene.radius, in_scene.nominal_force});
  }

  void fill(const OutputSpec& spec, PhysicalRow& row, Output& output) {
    switch (spec.kind) {
      case OutputKind::member_force:
      case OutputKind::stress:
        return is_body_stress(spec.quantity) ? body_stress(spec, row) : member_force(spec, row);
      case OutputKind::reaction:
        return reaction(spec, row);
      case OutputKind::spring:
        return spring(spec, row, output);
      case OutputKind::velocity:
        return motion(spec, 1, row);
      case OutputKind::acceleration:
        return motion(spec, 2, row);
      default:
        return motion(spec, 0, row);
    }
  }

  /// Adds a displacement (rate 0), velocity (1) or acceleration (2) to the row.
  void motion(const OutputSpec& spec, int rate, PhysicalRow& row) {
    const double u = rate == 0 ? 1.0 : 0.0, v = rate == 1 ? 1.0 : 0.0, a = rate == 2 ? 1.0 : 0.0;
    if (map_.is_matrix_scene()) {
      const Combination form =
          assembly::combination(map_, spec.direction, "output." + spec.name + ".direction", false);
      form.add_to(rate == 0 ? row.u : rate == 1 ? row.v : row.a, 1.0);
      for (const BaseMotionSpec& base : scene_.base_motion) {
        const Combination r = assembly::combination(map_, base.direction, "base_motion.direction", false);
        Vector moved = Vector::Zero(map_.size());
        r.add_to(moved, a);
        if (const double part = form.dot(moved); part != 0.0)
          row.given.push_back(
              {scene::make_history(base.acceleration, "base_motion.acceleration").scaled(part)});
      }
      return;
    }
    const std::array<double, 3> d{spec.rotation ? 0.0 : spec.direction.vector[0],
                                  spec.rotation ? 0.0 : spec.direction.vector[1], spec.rotation ? 1.0 : 0.0};
    for (std::size_t i = 0; i < spec.at.size(); ++i) {
      const int node = map_.mesh.by_name.at(spec.at[i]);
      const double sign = i == 0 ? 1.0 : -1.0;
      const auto numbers = map_.numbers_at(node);
      for (std::size_t c = 0; c < 3; ++c) {
        if (d[c] == 0.0) continue;
        if (numbers[c] == assembly::DofMap::absent)
          refuse(spec, "at",
                 fmt::format(
                     "node '{}' has no degree of freedom {}: no member, mass, spring or contact acts there",
                     spec.at[i],
                     c == 0   ? "in x"
                     : c == 1 ? "in y"
                              : "in rotation"));
        rows_->add_motion(row, numbers[c], sign * u * d[c], sign * v * d[c], sign * a * d[c]);
      }
      if (rate == 2) rows_->add_base_acceleration(row, d[0], d[1], false);
    }
  }

  [[nodiscard]] MemberPath way(const OutputSpec& spec, std::size_t i, const char* key) const {
    const auto [piece, backwards] = assembly::piece_between(map_, spec.at[i], spec.at[i + 1], spec.place,
                                                            fmt::format("output.{}.{}", spec.name, key));
    return {piece, backwards};
  }

  /// row += requested quantity at a point of the path. at: element k on the path, and position x in it, 0 to 1.
  void cut(const OutputSpec& spec, const char* key, const MemberPath& way, std::pair<std::size_t, double> at,
           const SectionQuantity& wanted, PhysicalRow& row) const {
    const MemberForces cuts(scene_, map_);
    rows_->add_section_force(row, MemberForces::element_of(way, at.first),
                             cuts.section_force(way, at.first, at.second, wanted, spec.place,
                                                fmt::format("output.{}.{}", spec.name, key)));
  }

  void member_force(const OutputSpec& spec, PhysicalRow& row) {
    const SectionQuantity wanted = section_quantity(spec, spec.fibre);
    const MemberPath along = way(spec, 0, "at");
    cut(spec, "at", along, MemberForces::place_of(along, spec.station), wanted, row);
  }

  /// Stress in axes along d = `direction` = (c, s) and across d: xx = d . sigma d, yy across d, xy = d . sigma (-s, c).
  void body_stress(const OutputSpec& spec, PhysicalRow& row) {
    const int node = map_.mesh.by_name.at(spec.at[0]);
    const auto [c, s] = spec.direction.vector;
    Eigen::RowVector3d factors(c * c, s * s, 2.0 * c * s);
    if (spec.quantity == OutputQuantity::yy) factors << s * s, c * c, -2.0 * c * s;
    if (spec.quantity == OutputQuantity::xy) factors << -c * s, c * s, c * c - s * s;
    rows_->add_stress(row, scene::body_of_node(scene_, static_cast<std::size_t>(node)).value(), node,
                      factors);
  }

  /// Output of the requested quantity at one point of a path.
  Output point(const OutputSpec& spec, const char* key, const MemberPath& way,
               std::pair<std::size_t, double> at, const SectionQuantity& wanted) const {
    Output linear;
    linear.kind = spec.kind;
    linear.unit = scene::unit_of_output(spec, scene_.outputs);
    PhysicalRow row(map_.size());
    cut(spec, key, way, at, wanted, row);
    take(row, linear);
    return linear;
  }

  static std::vector<Fibre> fibres_of(const OutputSpec& spec) {
    const bool both = spec.fibre == Fibre::both &&
                      (spec.kind == OutputKind::stress || spec.quantity == OutputQuantity::stress);
    if (both) return {Fibre::left, Fibre::right};
    return {spec.fibre};
  }

  /// Adds the outputs of the fibres of one section.
  void section_extremes(const OutputSpec& spec, Output& output) const {
    const MemberPath along = way(spec, 0, "at");
    for (const Fibre fibre : fibres_of(spec)) {
      const SectionQuantity wanted = section_quantity(spec, fibre);
      output.segments.push_back(
          {{point(spec, "at", along, MemberForces::place_of(along, spec.station), wanted)},
           spec.at[0],
           spec.at[1],
           spec.station,
           spec.station,
           fibre});
    }
  }

  void envelope(const OutputSpec& spec, Output& output) const {
    const std::size_t points = points_of(spec.quantity);
    for (std::size_t i = 0; i + 1 < spec.at.size(); ++i) {
      const MemberPath along = way(spec, i, "nodes");
      const auto count = static_cast<double>(along.piece->count);
      for (std::size_t k = 0; k < along.piece->count; ++k)
        for (const Fibre fibre : fibres_of(spec)) {
          const auto at = static_cast<double>(k);
          Output::Segment stretch{{}, spec.at[i], spec.at[i + 1], at / count, (at + 1.0) / count, fibre};
          for (std::size_t j = 0; j < points; ++j)
            stretch.at.push_back(point(spec, "nodes", along,
                                       {k, base::PolynomialInterpolation::point(points, j)},
                                       section_quantity(spec, fibre)));
          output.segments.push_back(std::move(stretch));
        }
    }
  }

  void spring(const OutputSpec& spec, PhysicalRow& row, Output& output) const {
    const Spring& spring = scene_.springs[spec.spring];
    rows_->add_spring(row, spring, spec.rotation, 1.0);
    const double stiffness = spec.rotation ? spring.rotation_stiffness : spring.stiffness;
    const double damping = spec.rotation ? spring.rotation_damping : spring.damping;
    if (!spec.rotation && spring.preload != 0.0) output.contains.emplace_back("preload");
    if (stiffness != 0.0) output.contains.emplace_back("stiffness");
    const double beta = spring.restoring ? 0.0 : model_.beta;
    if (damping + beta * stiffness != 0.0) output.contains.emplace_back("damper");
  }

  void reaction(const OutputSpec& spec, PhysicalRow& row) {
    const int node = map_.mesh.by_name.at(spec.at[0]);
    const std::array<double, 3> d{spec.rotation ? 0.0 : spec.direction.vector[0],
                                  spec.rotation ? 0.0 : spec.direction.vector[1], spec.rotation ? 1.0 : 0.0};
    bool held = false;
    for (const Support& support : scene_.supports) {
      if (support.node != spec.at[0]) continue;
      const std::array<bool, 3> fixed{support.ux, support.uy, support.rz};
      for (std::size_t c = 0; c < 3; ++c) held = held || (fixed[c] && d[c] != 0.0);
    }
    if (!held) refuse(spec, "at", fmt::format("no support fixes node '{}' in this direction", spec.at[0]));
    for (const TieSpec& tie : scene_.ties)
      for (const auto& [l, weight] : tie.master)
        if (l == node)
          refuse(spec, "at",
                 fmt::format(
                     "tied seam '{}' transfers forces of its slave to node '{}', and a reaction does not "
                     "include these forces: choose another support, or exchange the boundaries of the seam",
                     tie.seam, spec.at[0]));
    if (const int body = map_.body[static_cast<std::size_t>(node)]; body >= 0)
      add_body_reaction(scene_, map_, *rows_, {body, node, d, spec.place, "output." + spec.name + ".at"},
                        row);
    else
      for (std::size_t c = 0; c < 3; ++c)
        if (d[c] != 0.0 && is_held(node, c)) rows_->add_reaction(row, node, c, d[c]);
  }

  /// All nodes of the rigid body to which the node belongs; the node alone if it belongs to no body.
  [[nodiscard]] std::vector<int> nodes_moving_with(int node) const {
    const int body = map_.body[static_cast<std::size_t>(node)];
    if (body < 0) return {node};
    return nodes_of_body(map_, body);
  }

  [[nodiscard]] bool is_held(int node, std::size_t c) const {
    const int number = map_.numbers_at(node)[c];
    return number == assembly::DofMap::fixed || assembly::DofMap::support_of_code(number) >= 0;
  }

  void of_contact(const OutputSpec& spec, Output& output) const {
    const auto found = std::find_if(model_.contacts.begin(), model_.contacts.end(),
                                    [&](const Contact& c) { return c.name == spec.at[0]; });
    const auto k = static_cast<std::size_t>(found - model_.contacts.begin());
    const Contact& contact = *found;
    if (spec.quantity == OutputQuantity::N) output.forces.push_back({k, 1.0, 0.0});
    if (spec.quantity == OutputQuantity::T) output.forces.push_back({k, 0.0, 1.0});
    if (spec.quantity == OutputQuantity::gap) {
      output.u = contact.normal;
      output.constant = contact.gap;
      if (contact.compliance_split()) output.forces.push_back({k, -1.0 / contact.normal_stiffness, 0.0});
    }
    if (spec.quantity == OutputQuantity::slip) {
      output.u = contact.tangent;
      if (!contact.surface_motion.is_constant() || contact.surface_motion.value(0.0) != 0.0)
        output.given.push_back({contact.surface_motion.scaled(-1.0)});
      if (contact.tangential_stiffness)
        output.forces.push_back({k, 0.0, -1.0 / *contact.tangential_stiffness});
    }
    if (spec.quantity == OutputQuantity::loss) output.loss = k;
  }

  static void add(Combination& to, const Combination& from, double factor) {
    for (const auto& [i, x] : from.terms) {
      const int dof = i;
      const auto same =
          std::find_if(to.terms.begin(), to.terms.end(), [&](const auto& term) { return term.first == dof; });
      if (same == to.terms.end())
        to.terms.emplace_back(i, factor * x);
      else
        same->second += factor * x;
    }
  }

  static const Output& named(const std::string& name, const std::vector<Output>& all) {
    return *std::find_if(all.begin(), all.end(), [&](const Output& o) { return o.name == name; });
  }

  static void combine(const OutputSpec& spec, const std::vector<Output>& before, Output& output) {
    for (const OutputTerm& part : spec.terms) {
      const Output& term = named(part.name, before);
      const double factor = part.factor;
      if (!scene::same_unit(scene::product_of_units(term.unit, part.unit),
                            // the units can differ only in a scene that a program creates
                            output.unit))
        refuse(spec, "terms",
               fmt::format("'{}' and '{}' have different units; expected terms of one unit", part.name,
                           spec.terms.front().name));
      add(output.u, term.u, factor);
      add(output.v, term.v, factor);
      add(output.a, term.a, factor);
      for (const Output::ContactForces& f : term.forces)
        output.forces.push_back({f.contact, factor * f.N, factor * f.T});
      for (const Output::Restoring& r : term.restoring)
        output.restoring.push_back({r.contact, r.slip, factor * r.factor, r.scene_force});
      for (const Output::Given& g : term.given)
        output.given.push_back({g.history.scaled(factor), g.load, factor * g.factor, g.load_unit});
      output.constant += factor * term.constant;
    }
  }

  const Scene& scene_;
  const assembly::DofMap& map_;
  const Model& model_;
  std::optional<StructureRows> rows_;
};

}  // namespace

void make_outputs(const Scene& scene, const assembly::DofMap& map, Model& model) {
  if (scene.outputs.empty()) return;
  Maker maker(scene, map, model);
  bool reactions = false;
  for (const OutputSpec& spec : scene.outputs) {
    model.outputs.push_back(maker.make(spec, model.outputs));
    reactions = reactions || spec.kind == OutputKind::reaction;
  }
  if (!reactions || model.reduction) return;
  for (const std::size_t c : {std::size_t(0), std::size_t(1)})
    model.reaction_sums.push_back(maker.reaction_sum(c));
}

namespace {

void add(std::string& text, const std::string& name, int power) {
  if (power <= 0) return;
  if (!text.empty()) text += ' ';
  text += name;
  if (power > 1) text += '^' + std::to_string(power);
}

}  // namespace

}  // namespace signorini::outputs

namespace signorini {

std::string unit_text(const Unit& unit, const Units& names) {
  std::string above, below;
  if (unit.force == 0 && unit.length == 0) above = "rad";
  outputs::add(above, names.force, unit.force);
  outputs::add(above, names.length, unit.length);
  outputs::add(above, names.time, unit.time);
  outputs::add(below, names.force, -unit.force);
  outputs::add(below, names.length, -unit.length);
  outputs::add(below, names.time, -unit.time);
  if (above.empty()) above = "1";
  return below.empty() ? above : above + '/' + below;
}

}  // namespace signorini
