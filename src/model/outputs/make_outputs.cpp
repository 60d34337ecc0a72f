#include "model/outputs/make_outputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "model/outputs/body_reaction.hpp"
#include "model/outputs/structure_rows.hpp"
#include "scene/history_from_spec.hpp"
#include "scene/quantities.hpp"

namespace signorini {
namespace {

Combination form_of(const Vector& x) {
  Combination form;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (x[i] != 0.0) form.terms.emplace_back(static_cast<int>(i), x[i]);
  return form;
}

/// From the physical degrees of freedom to those that are computed.
Combination computed(const Vector& x, const Model& model) {
  if (model.reduction) return form_of(model.reduction->shapes.transpose() * x);
  if (model.basis) return form_of(model.basis->transpose() * x);
  return form_of(x);
}

class Maker {
 public:
  Maker(const Scene& scene, const DofMap& map, const Model& model) : scene_(scene), map_(map), model_(model) {
    if (!map.matrices()) rows_.emplace(scene, map, model.alpha, model.beta);
  }

  Output make(const OutputSpec& spec, const std::vector<Output>& before) {
    Output output;
    output.name = spec.name;
    output.kind = spec.kind;
    if (spec.kind == OutputKind::contact) {
      of_contact(spec, output);
    } else if (spec.kind == OutputKind::combination) {
      combine(spec, before, output);
    } else {
      PhysicalRow row(map_.size());
      fill(spec, row, output.unit);
      take(row, output);
    }
    return output;
  }

  /// Zero but for the residual: along x (0) or y (1).
  Output reaction_sum(std::size_t c) {
    PhysicalRow row(map_.size());
    std::vector<bool> held(map_.mesh.nodes.size(), false);
    for (const Support& support : scene_.supports) {
      const auto node = static_cast<std::size_t>(map_.mesh.by_name.at(support.node));
      if (!(c == 0 ? support.ux : support.uy) || held[node]) continue;
      for (const int all : together_with(static_cast<int>(node))) {
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
    output.forces = row.forces;
    output.given = row.given;
    output.constant = row.constant;
  }

  void fill(const OutputSpec& spec, PhysicalRow& row, Unit& of) {
    switch (spec.kind) {
      case OutputKind::member_force:
        return member_force(spec, row, of);
      case OutputKind::reaction:
        return reaction(spec, row, of);
      case OutputKind::spring: {
        of = spec.rotation ? unit::energy : unit::force;
        return rows_->add_spring(row, scene_.springs[spec.spring], spec.rotation, 1.0);
      }
      case OutputKind::velocity:
        of = spec.rotation ? unit::rate : unit::velocity;
        return motion(spec, 1, row);
      case OutputKind::acceleration:
        of = spec.rotation ? Unit{0, 0, -2} : unit::acceleration;
        return motion(spec, 2, row);
      default:
        of = spec.rotation ? unit::plain : unit::length;
        return motion(spec, 0, row);
    }
  }

  /// rate: 0 displacement, 1 velocity, 2 acceleration.
  void motion(const OutputSpec& spec, int rate, PhysicalRow& row) {
    const double u = rate == 0 ? 1.0 : 0.0, v = rate == 1 ? 1.0 : 0.0, a = rate == 2 ? 1.0 : 0.0;
    if (map_.matrices()) {
      const Combination form = combination(map_, spec.direction, "output." + spec.name + ".direction", false);
      form.add_to(rate == 0 ? row.u : rate == 1 ? row.v : row.a, 1.0);
      for (const BaseMotionSpec& base : scene_.base_motion) {
        const Combination r = combination(map_, base.direction, "base_motion.direction", false);
        Vector moved = Vector::Zero(map_.size());
        r.add_to(moved, a);
        if (const double part = form.dot(moved); part != 0.0)
          row.given.push_back({make_history(base.acceleration, "base_motion.acceleration").scaled(part)});
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
        if (numbers[c] == DofMap::absent)
          refuse(
              spec, "at",
              fmt::format("nothing moves node '{}' {}: no member, mass, spring or contact there", spec.at[i],
                          c == 0   ? "in x"
                          : c == 1 ? "in y"
                                   : "by a rotation"));
        rows_->add_motion(row, numbers[c], sign * u * d[c], sign * v * d[c], sign * a * d[c]);
      }
      if (rate == 2) rows_->add_frame(row, d[0], d[1], false);
    }
  }

  void member_force(const OutputSpec& spec, PhysicalRow& row, Unit& of) {
    const auto [piece, backwards] =
        piece_between(map_, spec.at[0], spec.at[1], spec.place, "output." + spec.name + ".at");
    const auto count = static_cast<double>(piece->count);
    const double along = (backwards ? 1.0 - spec.station : spec.station) * count;
    // Between two elements: the one that the station's own direction leads to.
    const double element =
        std::clamp(backwards ? std::ceil(along) - 1.0 : std::floor(along), 0.0, count - 1.0);
    const std::size_t number = piece->first + static_cast<std::size_t>(element);
    const MeshElement& e = map_.mesh.elements[number];
    const Axis axis = axis_of(map_.mesh, e);
    Cut cut = cut_at(e, axis, scene_.sections[static_cast<std::size_t>(e.section)].mass_per_length,
                     spec.quantity, (along - element) * axis.length);
    of = spec.quantity == OutputQuantity::M ? unit::energy : unit::force;
    if (backwards && spec.quantity == OutputQuantity::M) {  // the other side is to the right
      cut.forces *= -1.0;
      cut.acceleration *= -1.0;
      cut.deflection *= -1.0;
      cut.load = {-cut.load[0], -cut.load[1]};
    }
    rows_->add_cut(row, number, cut);
  }

  void reaction(const OutputSpec& spec, PhysicalRow& row, Unit& of) {
    const int node = map_.mesh.by_name.at(spec.at[0]);
    of = spec.rotation ? unit::energy : unit::force;
    const std::array<double, 3> d{spec.rotation ? 0.0 : spec.direction.vector[0],
                                  spec.rotation ? 0.0 : spec.direction.vector[1], spec.rotation ? 1.0 : 0.0};
    bool held = false;
    for (const Support& support : scene_.supports) {
      if (support.node != spec.at[0]) continue;
      const std::array<bool, 3> fixed{support.ux, support.uy, support.rz};
      for (std::size_t c = 0; c < 3; ++c) held = held || (fixed[c] && d[c] != 0.0);
    }
    if (!held) refuse(spec, "at", fmt::format("no support holds node '{}' that way", spec.at[0]));
    if (const int body = map_.body[static_cast<std::size_t>(node)]; body >= 0)
      return add_body_reaction(scene_, map_, *rows_,
                               {body, node, d, spec.place, "output." + spec.name + ".at"}, row);
    for (std::size_t c = 0; c < 3; ++c)
      if (d[c] != 0.0 && is_held(node, c)) rows_->add_reaction(row, node, c, d[c]);
  }

  /// The nodes of its rigid body, or itself.
  [[nodiscard]] std::vector<int> together_with(int node) const {
    const int body = map_.body[static_cast<std::size_t>(node)];
    if (body < 0) return {node};
    return nodes_of_body(map_, body);
  }

  [[nodiscard]] bool is_held(int node, std::size_t c) const {
    const int number = map_.numbers_at(node)[c];
    return number == DofMap::fixed || DofMap::moving_of_code(number) >= 0;
  }

  void of_contact(const OutputSpec& spec, Output& output) const {
    const auto found = std::find_if(model_.contacts.begin(), model_.contacts.end(),
                                    [&](const Contact& c) { return c.name == spec.at[0]; });
    const auto k = static_cast<std::size_t>(found - model_.contacts.begin());
    const Contact& contact = *found;
    output.unit = unit::force;
    if (spec.quantity == OutputQuantity::N) output.forces.push_back({k, 1.0, 0.0});
    if (spec.quantity == OutputQuantity::T) output.forces.push_back({k, 0.0, 1.0});
    if (spec.quantity == OutputQuantity::gap) {
      output.unit = unit::length;
      output.u = contact.normal;
      output.constant = contact.gap;
    }
    if (spec.quantity == OutputQuantity::slip) {
      output.unit = unit::length;
      output.u = contact.tangent;
      if (!contact.surface_motion.is_constant() || contact.surface_motion.value(0.0) != 0.0)
        output.given.push_back({contact.surface_motion.scaled(-1.0)});
      if (contact.tangential_stiffness)
        output.forces.push_back({k, 0.0, -1.0 / *contact.tangential_stiffness});
    }
    if (spec.quantity == OutputQuantity::loss) {
      output.unit = unit::energy;
      output.loss = k;
    }
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

  static void combine(const OutputSpec& spec, const std::vector<Output>& before, Output& output) {
    bool first = true;
    for (const auto& [name, factor] : spec.terms) {
      const std::string& wanted = name;
      const Output& term =
          *std::find_if(before.begin(), before.end(), [&](const Output& o) { return o.name == wanted; });
      const Unit a = term.unit, b = output.unit;
      if (!first && (a.force != b.force || a.length != b.length || a.time != b.time))
        refuse(spec, "terms",
               fmt::format("'{}' and '{}' have different units, expected one", spec.terms[0].first, name));
      output.unit = term.unit;
      first = false;
      add(output.u, term.u, factor);
      add(output.v, term.v, factor);
      add(output.a, term.a, factor);
      for (const Output::ContactForces& f : term.forces)
        output.forces.push_back({f.contact, factor * f.N, factor * f.T});
      for (const Output::Given& g : term.given)
        output.given.push_back({g.history.scaled(factor), g.load, factor * g.factor, g.of_load});
      output.constant += factor * term.constant;
    }
  }

  const Scene& scene_;
  const DofMap& map_;
  const Model& model_;
  std::optional<StructureRows> rows_;
};

}  // namespace

void make_outputs(const Scene& scene, const DofMap& map, Model& model) {
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

}  // namespace signorini
