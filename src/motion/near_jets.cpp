#include "motion/near_jets.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "linear/restricted.hpp"
#include "motion/term_size.hpp"

namespace signorini {
namespace {

/// Of the greatest entry of a column of M^-1: below, it is rounding.
constexpr double of_nothing = rounding::eps / 16.0;
/// Each order spreads what is done by one more element, by M^-1 and by K.
constexpr int spread = 2 * (Jet::orders + 1);
/// Contacts up to this part of the radius away share a neighbourhood. Of the structure it is a quarter at most: chosen.
constexpr int sharing = 4, least_gain = 4;
/// So many contacts are looked at near, one by one; more of them take the whole structure. Chosen.
constexpr std::size_t most_open = 6;

bool is_plain(const Contact& c) {
  return !c.own && !c.bowl && !c.shear && !c.takes_impulses() && !c.sticks_rigidly() && !friction_varies(c);
}

std::vector<int> dofs_of(const Contact& contact) {
  std::vector<int> dofs;
  for (const Combination* form : {&contact.normal, &contact.tangent})
    for (const auto& term : form->terms) dofs.push_back(term.first);
  return dofs;
}

/// Has some guard an acceleration, of which order 1 is not known here?
bool accelerates(const Contact& contact, const ContactState& state) {
  for (const GuardForm& guard : guards(contact, state))
    if (guard.kind != Guard::none && (guard.form.an != 0.0 || guard.form.at != 0.0)) return true;
  return false;
}

}  // namespace

struct NearJets::Neighbourhood {
  Neighbourhood(Model part, std::vector<int> dofs_, std::vector<std::size_t> contacts_,
                std::vector<std::size_t> loads_)
      : model(std::move(part)),
        structure(model),
        systems(model, structure),
        jets(systems),
        dofs(std::move(dofs_)),
        contacts(std::move(contacts_)),
        loads(std::move(loads_)) {}

  Model model;
  Structure structure;
  ModeSystems systems;
  JetMaker jets;
  std::vector<int> dofs;                     // in the whole, ascending
  std::vector<std::size_t> contacts, loads;  // the same
  /// What ties row `at` here to column `dof` outside.
  struct Tie {
    int at, dof;
    double m, c, k;
  };
  std::vector<Tie> ties;
  /// Contacts that reach across the boundary: their forces act on `at`.
  struct Pull {
    int at;
    Eigen::Index force;
    double factor;
  };
  std::vector<Pull> pulls;
  std::vector<MotionJet> motions;

  /// What the rest does to it at order 0.
  [[nodiscard]] Vector from_outside(const Point& now) const {
    Vector P = Vector::Zero(model.size());
    for (const Tie& tie : ties)
      P[tie.at] -= tie.m * now.a[tie.dof] + tie.c * now.v[tie.dof] + tie.k * now.u[tie.dof];
    for (const Pull& pull : pulls) P[pull.at] -= pull.factor * now.forces[pull.force];
    return P;
  }
};

NearJets::NearJets(ModeSystems& systems, int least)
    : systems_(systems),
      model_(systems.model()),
      possible_(model_.size() >= least && !has_massless(model_) &&
                std::all_of(model_.contacts.begin(), model_.contacts.end(), is_plain)),
      taylor_(systems),
      of_contact_(model_.contacts.size(), nullptr),
      looked_for_(model_.contacts.size(), false) {
  if (!possible_) return;
  const Structure& structure = systems.structure();
  neighbours_.resize(static_cast<std::size_t>(structure.size));
  contacts_at_.resize(neighbours_.size());
  for (std::size_t j = 0; j < neighbours_.size(); ++j)
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p)
      if (static_cast<std::size_t>(structure.row[p]) != j) neighbours_[j].push_back(structure.row[p]);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const std::vector<int> dofs = dofs_of(model_.contacts[c]);
    for (const int i : dofs) {
      if (auto& at = contacts_at_[static_cast<std::size_t>(i)]; at.empty() || at.back() != c) at.push_back(c);
      for (const int j : dofs)
        if (i != j) neighbours_[static_cast<std::size_t>(i)].push_back(j);
    }
  }
}

NearJets::~NearJets() = default;

/// In elements, of each degree of freedom; -1: no way leads there.
std::vector<int> NearJets::distances(const std::vector<int>& from) const {
  std::vector<int> distance(neighbours_.size(), -1), queue = from;
  for (const int dof : from) distance[static_cast<std::size_t>(dof)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int next : neighbours_[static_cast<std::size_t>(queue[i])])
      if (int& d = distance[static_cast<std::size_t>(next)]; d < 0) {
        d = distance[static_cast<std::size_t>(queue[i])] + 1;
        queue.push_back(next);
      }
  return distance;
}

/// To where M^-1 n and M^-1 t are felt, each entry as a part of what its own mass makes of it.
int NearJets::reach(std::size_t contact, const ModeSystem& system, const std::vector<int>& distance) const {
  int farthest = 0;
  const Contact& c = model_.contacts[contact];
  std::vector<double> x(system.unknowns().size()), work(x.size());
  for (const Combination* form : {&c.normal, &c.tangent}) {
    std::fill(x.begin(), x.end(), 0.0);
    form->add_to(x, 1.0);
    system.solve(x.data(), work.data());
    const auto felt = [&](std::size_t i) { return std::abs(x[i]) / std::sqrt(taylor_.mobility()[i]); };
    double most = 0.0;
    for (std::size_t i = 0; i < distance.size(); ++i) most = std::max(most, felt(i));
    for (std::size_t i = 0; i < distance.size(); ++i)
      if (felt(i) > of_nothing * most) farthest = std::max(farthest, distance[i]);
  }
  return farthest;
}

std::unique_ptr<NearJets::Neighbourhood> NearJets::neighbourhood(const std::vector<int>& distance,
                                                                 int radius) const {
  std::vector<int> dofs, place(distance.size(), -1);
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] >= 0 && distance[i] <= radius) {
      place[i] = static_cast<int>(dofs.size());
      dofs.push_back(static_cast<int>(i));
    }
  if (least_gain * dofs.size() > distance.size()) return nullptr;
  const auto inside = [&](int dof) { return place[static_cast<std::size_t>(dof)] >= 0; };
  std::vector<std::size_t> contacts, across;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const std::vector<int> own = dofs_of(model_.contacts[c]);
    if (std::all_of(own.begin(), own.end(), inside))
      contacts.push_back(c);
    else if (std::any_of(own.begin(), own.end(), inside))
      across.push_back(c);
  }
  Model part = restricted(model_, dofs, contacts);
  std::vector<std::size_t> loads;
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    Load load;  // its history is the forcing's
    for (const auto& [dof, factor] : model_.loads[i].direction.terms)
      if (inside(dof)) load.direction.terms.emplace_back(place[static_cast<std::size_t>(dof)], factor);
    if (load.direction.terms.empty()) continue;
    loads.push_back(i);
    part.loads.push_back(std::move(load));
  }
  for (Contact& contact : part.contacts) contact.normal_force = contact.surface_motion = {};
  auto near = std::make_unique<Neighbourhood>(std::move(part), dofs, contacts, loads);
  const Structure& structure = systems_.structure();
  for (std::size_t j = 0; j < distance.size(); ++j) {
    if (place[j] >= 0) continue;
    for (auto p = static_cast<std::size_t>(structure.column_start[j]);
         p < static_cast<std::size_t>(structure.column_start[j + 1]); ++p)
      if (inside(structure.row[p]))
        near->ties.push_back({place[static_cast<std::size_t>(structure.row[p])], static_cast<int>(j),
                              structure.m[p], structure.c[p], structure.k[p]});
  }
  const auto pull = [&](const Combination& form, std::size_t force) {
    for (const auto& [dof, factor] : form.terms)
      if (inside(dof))
        near->pulls.push_back(
            {place[static_cast<std::size_t>(dof)], static_cast<Eigen::Index>(force), factor});
  };
  for (const std::size_t c : across) {
    pull(model_.contacts[c].normal, normal_slot(c));
    pull(model_.contacts[c].tangent, tangent_slot(c));
  }
  return near;
}

NearJets::Neighbourhood* NearJets::around(std::size_t contact, const ModeSystem& system) {
  if (looked_for_[contact]) return of_contact_[contact];
  const std::vector<int> distance = distances(dofs_of(model_.contacts[contact]));
  const int radius = reach(contact, system, distance) + spread, shared = radius / sharing;
  Neighbourhood* near = made_.emplace_back(neighbourhood(distance, radius + shared)).get();
  for (std::size_t i = 0; i < distance.size(); ++i)
    for (const std::size_t c : contacts_at_[i])
      if (!looked_for_[c] &&
          (c == contact || (near != nullptr && distance[i] >= 0 && distance[i] <= shared))) {
        looked_for_[c] = true;
        of_contact_[c] = near;
      }
  looked_for_[contact] = true;  // it may act on nothing
  return near;
}

/// The rate of the motion but for g''' and ut'''. Forces by their own rows.
void NearJets::order_one(const ModeSystem& system, const Forcing& forcing, std::size_t contact,
                         MotionJet& result) const {
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion& d = result.motion[1] = {};
  d.gap = m.vn;
  d.ut = m.vt;
  d.vn = m.an;
  d.vt = m.at;
  d.pressing = m.pressing_rate;
  d.pressing_rate = forcing.pressing(contact, series_.t, 2);
  d.N = -rows.normal.rate(d) / rows.normal.N;
  d.T = -rows.tangent.rate(d) / rows.tangent.T;
}

/// At most the noise of motion/jet.cpp: there the terms count once, and |x - y| as often as they are disturbed: places and
/// velocities as data, N in its row besides, T in its own row and through N. The rounding of x and y themselves is less than
/// one time more.
void NearJets::bound_rounding(const ModeSystem& system, const Forcing& forcing, const Point& now,
                              std::size_t contact, MotionJet& result) const {
  const Contact& c = model_.contacts[contact];
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion terms, &d = result.noise[0] = {};
  terms.gap = size_of(model_, c.normal, now.u) + std::abs(c.gap);
  terms.ut = size_of(model_, c.tangent, now.u) + std::abs(forcing.surface(contact, series_.t, 0));
  terms.vn = size_of(model_, c.normal, now.v);
  terms.vt = size_of(model_, c.tangent, now.v) + std::abs(forcing.surface(contact, series_.t, 1));
  terms.pressing = std::abs(m.pressing);
  terms.pressing_rate = std::abs(m.pressing_rate);
  constexpr double once = rounding::of_many;
  terms.N = rows.normal.magnitude(terms) + std::abs(rows.normal.constant) + std::abs(m.N);
  terms.T = rows.tangent.magnitude(terms) + std::abs(rows.tangent.constant) + std::abs(m.T);
  d.N = 4.0 * once * terms.N;
  d.T = 5.0 * once * terms.T;
  d.gap = 3.0 * once * terms.gap;
  d.ut = 3.0 * once * terms.ut;
  d.vn = 3.0 * once * terms.vn;
  d.vt = 3.0 * once * terms.vt + forcing.surface_rounding(contact, series_.t);
  d.pressing = once * terms.pressing;
  d.pressing_rate = once * terms.pressing_rate;
}

/// False: it is not told here.
bool NearJets::look_near(const ModeSystemPtr& system, const Forcing& forcing, const Point& now,
                         std::size_t contact, const JetMaker::Told& told, MotionJet& motion) {
  Neighbourhood* near = around(contact, *system);
  if (near == nullptr) return false;
  Mode mode;
  for (const std::size_t c : near->contacts) mode.push_back(system->mode()[c]);
  const ModeSystemPtr own = near->systems.of(mode);
  if (!own) return false;
  const auto at = static_cast<std::size_t>(
      std::lower_bound(near->contacts.begin(), near->contacts.end(), contact) - near->contacts.begin());
  const Vector outside = near->from_outside(now);
  const auto with = [&](const Vector& more) {
    return forcing.on_part(near->model, near->dofs, near->loads, near->contacts, more);
  };
  const Forcing given = with(outside), alone = with(Vector::Zero(outside.size()));
  bool is_told = false;
  (void)near->jets.make(
      own, given, series_.t, now.u(near->dofs), now.v(near->dofs), near->motions,
      [&](std::size_t c, const MotionJet& jet, std::size_t orders) {
        if (c != at) return true;
        const bool enough = told(contact, jet, orders);
        is_told = enough && orders < MotionJet::orders;
        return enough;
      },
      &alone);
  motion = near->motions[at];
  return is_told;
}

/// Order 0 told it, and tells the same to the last bit: forces follow from its own rows, places and velocities.
bool NearJets::stays(std::size_t contact, const Jet& jet, const Beside& beside) const {
  if (jet.system->mode()[contact] != beside.jet.system->mode()[contact] ||
      std::binary_search(beside.open.begin(), beside.open.end(), contact))
    return false;
  const auto same = [&](const auto& term) { return jet.u(term.first, 2) == beside.jet.u(term.first, 2); };
  const Contact& c = model_.contacts[contact];
  return std::all_of(c.normal.terms.begin(), c.normal.terms.end(), same) &&
         std::all_of(c.tangent.terms.begin(), c.tangent.terms.end(), same);
}

std::optional<NearJets::Made> NearJets::make(const ModeSystemPtr& system, const Forcing& forcing, double t,
                                             const Vector& u, const Vector& v,
                                             std::vector<MotionJet>& motions, const JetMaker::Told& told,
                                             const std::optional<Beside>& beside) {
  if (!system->factorised().by_mass) return std::nullopt;
  taylor_.begin(system, forcing, t, u, v, 0, 1.0, series_);
  taylor_.extend(forcing, 0, series_);
  const std::size_t count = model_.contacts.size();
  Jet jet{t, series_.u, Eigen::MatrixXd(series_.forces.rows(), 2), system};
  jet.u.col(2) *= 2.0;
  jet.forces.col(0) = series_.forces.col(0);
  const Point now{u, v, jet.forces.col(0), jet.u.col(2)};
  motions.resize(count);
  std::vector<std::size_t> open;
  for (std::size_t c = 0; c < count; ++c) {
    MotionJet& motion = motions[c];
    const bool known = beside && stays(c, jet, *beside);
    if (!known) {
      motion.motion[0] = motion_of(model_.contacts[c], c, forcing, t, now);
      order_one(*system, forcing, c, motion);
      bound_rounding(*system, forcing, now, c, motion);
    }
    jet.forces(static_cast<Eigen::Index>(normal_slot(c)), 1) = motion.motion[1].N;
    jet.forces(static_cast<Eigen::Index>(tangent_slot(c)), 1) = motion.motion[1].T;
    if (known || (!accelerates(model_.contacts[c], system->mode()[c]) && told(c, motion, 1))) continue;
    open.push_back(c);
    if (open.size() > most_open) return std::nullopt;
  }
  for (const std::size_t c : open)
    if (!look_near(system, forcing, now, c, told, motions[c])) return std::nullopt;
  return Made{std::move(jet), std::move(open)};
}

}  // namespace signorini
