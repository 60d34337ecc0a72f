#include "motion/neighbourhoods.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "linear/unknowns.hpp"

namespace signorini::motion {
namespace {

/// Entries of a column of M^-1 below this fraction of the largest entry are rounding errors.
constexpr double negligible_fraction = rounding::eps / 16.0;
/// Contacts within the distance radius / sharing of each other share a neighbourhood. A neighbourhood must not have more than
/// 1 / least_gain of all degrees of freedom. Chosen values.
constexpr int sharing = 4, least_gain = 4;

bool is_plain(const Contact& c) {
  return c.forces_follow_motion() && c.is_linear() && !c.takes_impulses() && !c.sticks_rigidly();
}

std::vector<int> dofs_of(const Contact& contact) {
  std::vector<int> dofs;
  for (const Combination* form : {&contact.normal, &contact.tangent})
    for (const auto& term : form->terms) dofs.push_back(term.first);
  return dofs;
}

}  // namespace

bool follows_from_motion(const Model& model) {
  return !linear::has_massless(model) && std::all_of(model.contacts.begin(), model.contacts.end(), is_plain);
}

Neighbourhoods::Neighbourhoods(StateSystems& systems, int spread)
    : model_(systems.model()),
      structure_(systems.structure()),
      spread_(spread),
      of_contact_(model_.contacts.size(), nullptr),
      searched_(model_.contacts.size(), false) {
  neighbours_.resize(static_cast<std::size_t>(structure_.size));
  contacts_at_.resize(neighbours_.size());
  for (std::size_t j = 0; j < neighbours_.size(); ++j)
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
         p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p)
      if (static_cast<std::size_t>(structure_.row[p]) != j) neighbours_[j].push_back(structure_.row[p]);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const std::vector<int> dofs = dofs_of(model_.contacts[c]);
    for (const int i : dofs) {
      if (auto& at = contacts_at_[static_cast<std::size_t>(i)]; at.empty() || at.back() != c) at.push_back(c);
      for (const int j : dofs)
        if (i != j) neighbours_[static_cast<std::size_t>(i)].push_back(j);
    }
  }
  for (Eigen::Index i = 0; i < model_.size(); ++i)
    root_of_mass_.push_back(std::sqrt(model_.mass.coeff(i, i)));
}

/// Distance of each degree of freedom from those in `from`, as a number of elements; -1: not connected.
std::vector<int> Neighbourhoods::distances(const std::vector<int>& from) const {
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

/// Distance up to which M^-1 n and M^-1 t are above rounding. Each entry is weighted by the square root of its mass.
int Neighbourhoods::reach(std::size_t contact, const StateSystem& system,
                          const std::vector<int>& distance) const {
  int farthest = 0;
  const Contact& c = model_.contacts[contact];
  std::vector<double> x(system.unknowns().size()), work(x.size());
  for (const Combination* form : {&c.normal, &c.tangent}) {
    std::fill(x.begin(), x.end(), 0.0);
    double* const begin = x.data();
    form->add_to(begin, 1.0);
    system.solve(x.data(), work.data());
    const auto weighted = [&](std::size_t i) { return std::abs(x[i]) * root_of_mass_[i]; };
    double most = 0.0;
    for (std::size_t i = 0; i < distance.size(); ++i) most = std::max(most, weighted(i));
    for (std::size_t i = 0; i < distance.size(); ++i)
      if (weighted(i) > negligible_fraction * most) farthest = std::max(farthest, distance[i]);
  }
  return farthest;
}

std::unique_ptr<Neighbourhood> Neighbourhoods::make(const std::vector<int>& distance, int radius) const {
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
  Model part = linear::restricted(model_, dofs, contacts);
  std::vector<std::size_t> loads;
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    Load load;  // without history: the Forcing contains the histories
    for (const auto& [dof, factor] : model_.loads[i].direction.terms)
      if (inside(dof)) load.direction.terms.emplace_back(place[static_cast<std::size_t>(dof)], factor);
    if (load.direction.terms.empty()) continue;
    loads.push_back(i);
    part.loads.push_back(std::move(load));
  }
  for (Contact& contact : part.contacts) contact.normal_force = contact.surface_motion = {};
  auto near = std::make_unique<Neighbourhood>(std::move(part), dofs, contacts, loads);
  for (std::size_t j = 0; j < distance.size(); ++j) {
    if (place[j] >= 0) continue;
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
         p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p)
      if (inside(structure_.row[p]))
        near->couplings.push_back({place[static_cast<std::size_t>(structure_.row[p])], static_cast<int>(j),
                                   structure_.m[p], structure_.c[p], structure_.k[p]});
  }
  const auto pull = [&](const Combination& form, std::size_t force) {
    for (const auto& [dof, factor] : form.terms)
      if (inside(dof)) near->crossing_forces.push_back({place[static_cast<std::size_t>(dof)], force, factor});
  };
  for (const std::size_t c : across) {
    pull(model_.contacts[c].normal, model_.layout.normal(c));
    pull(model_.contacts[c].tangent, model_.layout.tangent(c));
  }
  return near;
}

Neighbourhood* Neighbourhoods::around(std::size_t contact, const StateSystem& system) {
  if (searched_[contact]) return of_contact_[contact];
  const std::vector<int> distance = distances(dofs_of(model_.contacts[contact]));
  const int radius = reach(contact, system, distance) + spread_, shared = radius / sharing;
  std::unique_ptr<Neighbourhood> made = make(distance, radius + shared);
  Neighbourhood* near = made.get();
  if (near != nullptr) {
    near->number = made_.size();
    made_.push_back(std::move(made));
  } else {
    ++failures_;
  }
  for (std::size_t i = 0; i < distance.size(); ++i)
    for (const std::size_t c : contacts_at_[i])
      if (!searched_[c] && (c == contact || (near != nullptr && distance[i] >= 0 && distance[i] <= shared))) {
        searched_[c] = true;
        of_contact_[c] = near;
      }
  searched_[contact] = true;  // also set if the contact acts on no degree of freedom
  return near;
}

}  // namespace signorini::motion
