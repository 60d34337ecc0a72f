// powers.hpp: the rates at which the system gains and loses energy.
//
//   loads     P(t) . v                       damping   v^T C v + sum_closed cn g'^2
//   friction  T p'  of each contact          surface   -T s'(t)  of each contact
//
// Powers of a contact: contact/work.hpp.
#pragma once

#include <algorithm>
#include <vector>

#include "contact/work.hpp"
#include "linear/structure.hpp"
#include "motion/point.hpp"

namespace signorini {

/// Integrals of the powers. friction, surface: one for each contact; pressing: of -N, unit force * time.
struct Works {
  explicit Works(std::size_t contacts = 0)
      : friction(contacts, 0.0), surface(contacts, 0.0), pressing(contacts, 0.0) {}
  double loads = 0.0, damping = 0.0;
  std::vector<double> friction, surface, pressing;

  void clear() {
    loads = damping = 0.0;
    std::fill(friction.begin(), friction.end(), 0.0);
    std::fill(surface.begin(), surface.end(), 0.0);
    std::fill(pressing.begin(), pressing.end(), 0.0);
  }
  /// Adds factor times the work of contact k.
  void add(std::size_t k, const ContactWork& work, double factor) {
    damping += factor * work.damping;
    friction[k] += factor * work.friction;
    surface[k] += factor * work.surface;
    pressing[k] += factor * work.pressing;
  }
};

class Powers {
 public:
  Powers(const Model& model, const Structure& structure) : model_(model), structure_(structure) {}

  /// Number of powers at one time: loads, damping, then friction, surface and -N of each contact.
  [[nodiscard]] std::size_t count() const { return 2 + 3 * model_.contacts.size(); }
  /// Evaluates all powers into out[0 .. count()).
  void at(const Forcing& forcing, double t, const Mode& mode, const Point& point, double* out) const;
  /// works += factor * powers
  void add(const double* powers, double factor, Works& works) const;

 private:
  const Model& model_;
  const Structure& structure_;
};

}  // namespace signorini
