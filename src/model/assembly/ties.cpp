#include "model/assembly/ties.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/rounding.hpp"
#include "model/assembly/loads.hpp"
#include "scene/components.hpp"

namespace signorini::assembly {
namespace {

std::size_t node_slot(int i) { return static_cast<std::size_t>(i); }

/// Coordinate perpendicular to a component: y of the node for ux, x for uy.
double across(const DofMap& map, int node, std::size_t c) {
  const element::MeshNode& at = map.mesh.nodes[node_slot(node)];
  return c == 0 ? at.y : at.x;
}

/// a - b; zero if the difference is within the rounding of coordinates that are meant to be equal.
double lever_arm(double a, double b) {
  const double d = a - b;
  return std::abs(d) <= rounding::few_operations * (std::abs(a) + std::abs(b)) ? 0.0 : d;
}

BodyMotion nodes_of(const RigidBody& body, int number, DofMap& map) {
  const std::string key = "rigid." + body.name + ".";
  BodyMotion motion;
  motion.centre = element::find_node(map.mesh, body.centre, body.place, key + "centre");
  const auto take = [&](int node, const std::string& name, const char* of) {
    int& owner = map.body[node_slot(node)];
    if (owner == number) return;
    if (owner != DofMap::absent)
      throw SceneError(
          body.place, key + of,
          fmt::format("node '{}' already belongs to another rigid body; a node can belong to one only",
                      name));
    owner = number;
    motion.nodes.push_back(node);
  };
  take(motion.centre, body.centre, "centre");
  for (const std::string& name : body.nodes)
    take(element::find_node(map.mesh, name, body.place, key + "nodes"), name, "nodes");
  return motion;
}

[[noreturn]] void refuse_support(const Scene& scene, const BodyConstraint& hold, const RigidBody& body,
                                 const std::string& why) {
  const Support& s = scene.supports[hold.support];
  throw SceneError(s.place, s.key + ".node",
                   fmt::format("node '{}' is part of rigid body '{}': {}", s.node, body.name, why));
}

/// Adds one support to the constraints of the body; sets `turn` if this support and an earlier one together
/// fix rz.
void add_body_constraint(const Scene& scene, const RigidBody& body, const BodyConstraint& hold, std::size_t c,
                         BodyMotion& motion, std::optional<BodyConstraint>& turn) {
  std::optional<BodyConstraint>& before = motion.constraints[c];
  if (!before) {
    before = hold;
    return;
  }
  if (before->moving == hold.moving && before->node == hold.node) return;
  if (before->moving >= 0 || hold.moving >= 0)
    refuse_support(scene, hold, body,
                   fmt::format("another support also fixes the {} of this body, and one of the two supports "
                               "moves; remove one of them",
                               scene::plane_components[c].displacement));
  if (c < 2 && lever_arm(before->coordinate, hold.coordinate) != 0.0) turn = hold;
}

void find_body_constraints(const Scene& scene, const RigidBody& body, int number, const DofMap& map,
                           BodyMotion& motion) {
  std::optional<BodyConstraint> turn;
  for (std::size_t i = 0; i < scene.supports.size(); ++i) {
    const Support& s = scene.supports[i];
    const int node = map.mesh.by_name.at(s.node);
    if (map.body[node_slot(node)] != number) continue;
    const auto moving = std::find(map.supports.begin(), map.supports.end(), i);
    const std::array<bool, 3> fix{s.ux, s.uy, s.rz};
    for (std::size_t c = 0; c < 3; ++c)
      if (fix[c])
        add_body_constraint(
            scene, body,
            {c < 2 ? across(map, node, c) : 0.0,
             moving == map.supports.end() ? DofMap::absent : static_cast<int>(moving - map.supports.begin()),
             i, node_slot(node)},
            c, motion, turn);
  }
  if (!turn) return;
  if (motion.constraints[2] && motion.constraints[2]->moving >= 0)
    refuse_support(scene, *turn, body,
                   "two supports together fix the rz of this body, but another support moves rz; remove one "
                   "of these three supports");
  motion.constraints[2] = turn;
}

/// Motion of a body's node along component c, as terms of the free motions of the body and of moving supports.
std::vector<TiedTerm> terms_of(const BodyMotion& body, int node, std::size_t c, const DofMap& map) {
  std::vector<TiedTerm> terms;
  const auto add = [&](std::size_t of, double factor) {
    const std::optional<BodyConstraint>& hold = body.constraints[of];
    if (factor == 0.0 || (hold && hold->moving < 0)) return;
    terms.push_back(
        {hold ? DofMap::support_code(hold->moving) : map.number[node_slot(body.centre)][of], factor});
  };
  add(c, 1.0);
  if (c == 2) return terms;
  const double from = body.constraints[c] ? body.constraints[c]->coordinate : across(map, body.centre, c);
  const double arm = lever_arm(across(map, node, c), from);
  add(2, c == 0 ? -arm : arm);
  return terms;
}

void tie_component(const BodyMotion& body, int node, std::size_t c, DofMap& map) {
  int& moving = map.moving[node_slot(node)][c];
  std::vector<TiedTerm> terms = terms_of(body, node, c, map);
  // A node without an arm follows the support exactly; with an arm, its motion also contains a rotation.
  const bool follows = body.constraints[c] && body.constraints[c]->moving >= 0 && terms.size() == 1;
  moving = follows ? DofMap::support_of_code(terms[0].number) : DofMap::absent;
  if (terms.empty() || follows) {
    map.number[node_slot(node)][c] = DofMap::fixed;
    return;
  }
  map.tie(node, c, std::move(terms));
}

}  // namespace

std::vector<BodyMotion> find_bodies(const Scene& scene, DofMap& map) {
  map.body.assign(map.mesh.nodes.size(), DofMap::absent);
  std::vector<BodyMotion> bodies;
  for (std::size_t i = 0; i < scene.rigid.size(); ++i)
    bodies.push_back(nodes_of(scene.rigid[i], static_cast<int>(i), map));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyMotion& body = bodies[i];
    find_body_constraints(scene, scene.rigid[i], static_cast<int>(i), map, body);
    for (const int node : body.nodes)
      map.number[node_slot(node)] = {DofMap::absent, DofMap::absent, DofMap::absent};
    for (std::size_t c = 0; c < 3; ++c)
      map.number[node_slot(body.centre)][c] = body.constraints[c] ? DofMap::fixed : DofMap::needed;
  }
  return bodies;
}

void tie(const std::vector<BodyMotion>& bodies, DofMap& map) {
  for (const BodyMotion& body : bodies)
    for (const int node : body.nodes)
      for (std::size_t c = 0; c < 3; ++c)
        if (node != body.centre || body.constraints[c]) tie_component(body, node, c, map);
}

std::vector<std::pair<int, std::size_t>> constrained_components(const Scene& scene, const DofMap& map,
                                                                int body) {
  std::vector<std::pair<int, std::size_t>> held;
  for (const Support& s : scene.supports) {
    const int node = map.mesh.by_name.at(s.node);
    if (map.body[node_slot(node)] != body) continue;
    const std::array<bool, 3> fix{s.ux, s.uy, s.rz};
    for (std::size_t c = 0; c < 3; ++c)
      if (fix[c] && std::find(held.begin(), held.end(), std::pair(node, c)) == held.end())
        held.emplace_back(node, c);
  }
  return held;
}

void TiedForm::add(int number, double factor) {
  if (factor == 0.0) return;
  for (const TiedTerm& term : map_.terms(number)) {
    const double part = factor * term.factor;
    const auto same =
        std::find_if(sums_.begin(), sums_.end(), [&](const Sum& s) { return s.number == term.number; });
    if (same == sums_.end()) {
      sums_.push_back({term.number, part, std::abs(part)});
    } else {
      same->sum += part;
      same->size += std::abs(part);
    }
  }
}

bool TiedForm::follows_support() const {
  return std::any_of(sums_.begin(), sums_.end(), [](const Sum& s) {
    return s.number < 0 && std::abs(s.sum) > rounding::few_operations * s.size;
  });
}

Combination TiedForm::combination() const {
  Combination form;
  for (const Sum& s : sums_)
    if (s.number >= 0 && std::abs(s.sum) > rounding::few_operations * s.size)
      form.terms.emplace_back(s.number, s.sum);
  return form;
}

Elongation TiedForm::with_supports() const {
  Elongation form;
  std::vector<double> factors;
  for (const Sum& s : sums_) {
    if (std::abs(s.sum) <= rounding::few_operations * s.size) continue;
    form.numbers.push_back(s.number);
    factors.push_back(s.sum);
  }
  form.factors = Eigen::Map<const Vector>(factors.data(), static_cast<Eigen::Index>(factors.size()));
  return form;
}

bool any_tied(const DofMap& map, const int* numbers, std::size_t count) {
  return std::any_of(numbers, numbers + count, [&](int n) { return map.is_tied(n); });
}

TiedElement::TiedElement(const DofMap& map, const int* of, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    for (const TiedTerm& term : map.terms(of[i]))
      if (std::find(numbers.begin(), numbers.end(), term.number) == numbers.end())
        numbers.push_back(term.number);
  t = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < count; ++i)
    for (const TiedTerm& term : map.terms(of[i])) {
      const auto at = std::find(numbers.begin(), numbers.end(), term.number) - numbers.begin();
      t(static_cast<Eigen::Index>(i), at) += term.factor;
    }
}

Eigen::MatrixXd TiedElement::transform(const Eigen::MatrixXd& a) const {
  const Eigen::MatrixXd whole = t.transpose() * a * t;
  const Eigen::MatrixXd size = t.cwiseAbs().transpose() * a.cwiseAbs() * t.cwiseAbs();
  Eigen::MatrixXd result = 0.5 * (whole + whole.transpose());
  for (Eigen::Index j = 0; j < result.cols(); ++j)
    for (Eigen::Index i = 0; i < result.rows(); ++i)
      if (std::abs(result(i, j)) <= rounding::few_operations * size(i, j)) result(i, j) = 0.0;
  return result;
}

void add_ties(const Scene& scene, const DofMap& map, Model& model) {
  if (map.tied.empty()) return;
  Ties ties;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < map.tied.size(); ++i)
    for (const TiedTerm& term : map.tied[i].terms) {
      const auto row = static_cast<int>(i);
      if (term.number >= 0)
        entries.emplace_back(row, term.number, term.factor);
      else
        ties.given.push_back(
            {row, motion_of_support(scene, map, DofMap::support_of_code(term.number)).scaled(term.factor)});
    }
  ties.rows.resize(static_cast<Eigen::Index>(map.tied.size()), map.size());
  ties.rows.setFromTriplets(entries.begin(), entries.end());
  model.ties = std::move(ties);
  name_tied_dofs(map, model);
}

void name_tied_dofs(const DofMap& map, Model& model) {
  if (!model.ties) return;
  const std::vector<Dof>& structure = model.reduction ? model.reduction->dofs : model.dofs;
  model.ties->dofs.assign(structure.begin(), structure.begin() + map.size());
  for (const TiedDof& tied : map.tied) model.ties->dofs.push_back(tied.dof);
  if (!model.reduction)
    model.ties->dofs.insert(model.ties->dofs.end(), model.dofs.begin() + map.size(), model.dofs.end());
}

namespace {

[[noreturn]] void refuse_tie(const TieSpec& tie, const DofMap& map, const std::string& why) {
  throw SceneError(tie.place, fmt::format("seams.{}.slave", tie.seam),
                   fmt::format("node '{}' follows the master of this tied seam, but {}",
                               map.mesh.node(tie.node).name, why));
}

/// Motion of a tied node along component c, as terms of master motions; terms that cancel up to rounding are omitted.
std::vector<TiedTerm> followed(const TieSpec& tie, std::size_t c, const DofMap& map) {
  struct Sum {
    TiedTerm term;
    double size = 0.0;
  };
  std::vector<Sum> sums;
  for (const auto& [l, weight] : tie.master)
    for (const TiedTerm& term : map.terms(map.numbers_at(l)[c])) {
      const double part = weight * term.factor;
      const auto same =
          std::find_if(sums.begin(), sums.end(), [&](const Sum& s) { return s.term.number == term.number; });
      if (same == sums.end()) {
        sums.push_back({{term.number, part}, std::abs(part)});
      } else {
        same->term.factor += part;
        same->size += std::abs(part);
      }
    }
  std::vector<TiedTerm> terms;
  for (const Sum& s : sums)
    if (std::abs(s.term.factor) > rounding::few_operations * s.size) terms.push_back(s.term);
  return terms;
}

}  // namespace

void mark_slave_dofs(const Scene& scene, DofMap& map) {
  std::unordered_set<int> slaves;
  for (const TieSpec& tie : scene.ties) slaves.insert(tie.node);
  for (const TieSpec& tie : scene.ties) {
    const auto node = static_cast<std::size_t>(tie.node);
    if (map.body[node] >= 0)
      refuse_tie(
          tie, map,
          fmt::format("the node is also part of rigid body '{}': remove it from the seam or from the body",
                      scene.rigid[static_cast<std::size_t>(map.body[node])].name));
    for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
      if (map.number[node][c] == DofMap::fixed || map.moving[node][c] >= 0)
        refuse_tie(tie, map,
                   "a support fixes the node: put the support on the master, or exchange the two boundaries");
      map.number[node][c] = DofMap::absent;
    }
    for (const auto& [l, weight] : tie.master)
      if (slaves.contains(l))
        refuse_tie(tie, map,
                   fmt::format(
                       "node '{}' of this master is itself a tied node: expected a master without tied nodes",
                       map.mesh.node(l).name));
  }
}

void tie_seams(const Scene& scene, DofMap& map) {
  for (const TieSpec& tie : scene.ties)
    for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
      std::vector<TiedTerm> terms = followed(tie, c, map);
      if (terms.empty())
        map.number[static_cast<std::size_t>(tie.node)][c] = DofMap::fixed;
      else
        map.tie(tie.node, c, std::move(terms));
    }
}

}  // namespace signorini::assembly
