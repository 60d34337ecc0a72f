#include "engine/newmark/newmark_works.hpp"

namespace signorini {

void NewmarkWorks::add(const Forcing& forcing, const Mode& mode, const Point& a, double t0, const Point& b,
                       double t1, double factor, Works& works) {
  const double h = t1 - t0;
  if (!(h > 0.0)) return;
  du_ = b.u - a.u;
  v_ = 0.5 * (a.v + b.v);
  if (forcing.loaded())
    works.loads += 0.5 * factor * (forcing.power(t0, du_.data()) + forcing.power(t1, du_.data()));
  works.damping += factor * h * structure_.damping_power(v_.data());
  const ForceLayout& layout = model_.layout;
  for (std::size_t k = 0; k < mode.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const State state = mode[k].state;
    const double surface = forcing.surface(k, t1, 0) - forcing.surface(k, t0, 0);
    const double slip = slip_of(contact, contact.tangent.dot(du_) - surface, b.T(layout, k) - a.T(layout, k));
    const ContactPath path{slip, surface, contact.normal.dot(du_), contact.normal.dot(v_), h};
    works.add(k,
              work_on(contact, state, 0.5 * (a.N(layout, k) + b.N(layout, k)),
                      0.5 * (a.T(layout, k) + b.T(layout, k)), path),
              factor);
    if (state == State::inside)
      works.damping += factor * inside_loss(contact, state, contact.gap_at(a.u), contact.gap_at(b.u));
  }
}

}  // namespace signorini
