#include "sensitivity/contact_rates.hpp"

#include <fmt/core.h>
#include <set>

#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "signorini/error.hpp"

namespace signorini::sensitivity {

std::vector<Eigen::Index> contact_dofs(const Model& model, const std::vector<const ModelDerivative*>& rates) {
  std::set<Eigen::Index> dofs;
  const auto add = [&](const Combination& form) {
    for (const auto& term : form.terms) dofs.insert(term.first);
  };
  for (const Contact& contact : model.contacts)
    for (const Combination* form : {&contact.normal, &contact.tangent, &contact.body_tangent()}) add(*form);
  for (const ModelDerivative* d : rates)
    for (const ContactRates& c : d->contacts)
      for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent}) add(*form);
  return {dofs.begin(), dofs.end()};
}

DrivenRates driven_rates(const ForcingDerivatives& series, double scale, std::size_t c, double x) {
  DrivenRates d;
  const auto value = [&](const std::vector<double>& rows, std::size_t order) {
    double sum = 0.0;
    const double* row = rows.data() + c * series.count;
    for (std::size_t k = series.count; k-- > order;) {
      double factor = 1.0;
      for (std::size_t j = 0; j < order; ++j) factor *= static_cast<double>(k - j) / scale;
      sum = sum * x + factor * row[k];
    }
    return sum;
  };
  for (std::size_t order = 0; order < 3; ++order) d.surface[order] = value(series.surface, order);
  for (std::size_t order = 0; order < 2; ++order)
    d.applied_normal_force[order] = value(series.applied_normal_force, order);
  return d;
}

ContactMotion motion_of(const Contact& contact, std::size_t k, const motion::Forcing& forcing, double t,
                        const SeriesPoint& point) {
  return motion::motion_of(contact, k, forcing, t, motion::Point{point.u, point.v, point.forces, point.a});
}

ContactMotion time_rate(const ForceLayout& layout, std::size_t k, const ContactMotion& m,
                        const SeriesPoint& point) {
  ContactMotion rate;
  rate.N = point.force_rates[static_cast<Eigen::Index>(layout.normal(k))];
  rate.T = point.force_rates[static_cast<Eigen::Index>(layout.tangent(k))];
  rate.gap = m.vn;
  rate.ut = m.vt;
  rate.vn = m.an;
  rate.vt = m.at;
  rate.applied_normal_force = m.applied_normal_force_rate;
  return rate;
}

ContactMotion parameter_rate(const Contact& contact, const ContactRates& rates, const ForceLayout& layout,
                             std::size_t k, const SeriesPoint& point, const SeriesPoint& w,
                             const DrivenRates& driven) {
  ContactMotion m;
  m.N = w.forces[static_cast<Eigen::Index>(layout.normal(k))];
  m.T = w.forces[static_cast<Eigen::Index>(layout.tangent(k))];
  m.gap = contact.normal.dot(w.u) + rates.normal.dot(point.u) + rates.gap;
  m.vn = contact.normal.dot(w.v) + rates.normal.dot(point.v);
  m.an = contact.normal.dot(w.a) + rates.normal.dot(point.a);
  m.ut = contact.tangent.dot(w.u) + rates.tangent.dot(point.u) - driven.surface[0];
  m.vt = contact.tangent.dot(w.v) + rates.tangent.dot(point.v) - driven.surface[1];
  m.at = contact.tangent.dot(w.a) + rates.tangent.dot(point.a) - driven.surface[2];
  m.applied_normal_force = driven.applied_normal_force[0];
  m.applied_normal_force_rate = driven.applied_normal_force[1];
  return m;
}

ContactMotion sum(const ContactMotion& a, const ContactMotion& b, double factor) {
  ContactMotion m;
  for (const auto field : {&ContactMotion::N, &ContactMotion::T, &ContactMotion::gap, &ContactMotion::ut,
                           &ContactMotion::vn, &ContactMotion::vt, &ContactMotion::an, &ContactMotion::at,
                           &ContactMotion::applied_normal_force, &ContactMotion::applied_normal_force_rate})
    m.*field = a.*field + factor * b.*field;
  return m;
}

WatchedMotion watched(const Contact& contact, const ForceLayout& layout, std::size_t k, const Vector& u0,
                      const SeriesPoint& point, const Vector& force_bends) {
  const auto n = static_cast<Eigen::Index>(layout.normal(k)),
             t = static_cast<Eigen::Index>(layout.tangent(k));
  const Combination& body = contact.body_tangent();
  const Vector moved = point.u - u0;
  return {{point.forces[n], point.forces[t], contact.normal.dot(moved), body.dot(moved)},
          {point.force_rates[n], point.force_rates[t], contact.normal.dot(point.v), body.dot(point.v)},
          {force_bends[n], force_bends[t], contact.normal.dot(point.a), body.dot(point.a)}};
}

motion::BodySlide slide_rate(const Contact& contact, const ContactRates& rates, const SeriesPoint& point,
                             const SeriesPoint& w, const DrivenRates& driven) {
  const Combination& body = contact.body_tangent();
  return {body.dot(w.u) + rates.body_tangent.dot(point.u) - driven.surface[0],
          body.dot(w.v) + rates.body_tangent.dot(point.v) - driven.surface[1]};
}

LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                   const ContactRates& rates, const motion::Forcing& forcing, double t,
                   const TangentSource& source) {
  LawRates result;
  const double applied = forcing.applied_normal_force(c, t, 0);
  result.law = modal::force_law(contact, state, applied);
  const Rows row = contact::rows(contact, state);
  const Rows& by = rates.rows[index_of(state.state)];
  const std::size_t place = c * source.forcing.count;
  modal::ForceLaw& d = result.rates;
  d.N_gap = -by.normal.gap;
  d.N_constant =
      -(by.normal.applied_normal_force * applied +
        row.normal.applied_normal_force * source.forcing.applied_normal_force[place] + by.normal.constant);
  d.T_gap = -(by.tangent.N * result.law.N_gap + row.tangent.N * d.N_gap);
  d.T_ut = -by.tangent.ut;
  d.T_constant = -(by.tangent.N * result.law.N_constant + row.tangent.N * d.N_constant + by.tangent.constant);
  if (state.state == State::stick && contact.tangential_stiffness)
    d.T_constant -=
        rates.tangential_stiffness * state.anchor + *contact.tangential_stiffness * source.start->anchors[c];
  result.gap = contact.gap;
  result.gap_rate = rates.gap;
  result.surface = forcing.surface(c, t, 0);
  result.surface_rate = source.forcing.surface[place];
  return result;
}

void check_tangent_laws(const Scene& scene, const Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const bool rises = c.friction.is_rate_strengthening();
    const bool remembers = c.law->has_memory();
    const bool multiplies = !c.law->capabilities.linear_guards;
    const char* what = remembers                        ? "a contact law with memory"
                       : multiplies                     ? "a contact law whose guards contain products"
                       : c.curved_surface()             ? "a pendulum whose normal force varies"
                       : rises && c.sliding_point()     ? "friction that rises with the slip rate together "
                                                          "with a tangential_stiffness"
                       : c.friction.is_load_dependent() ? contact::friction_description(c)
                       : c.compliance_split()           ? "a rigid contact on massless parts"
                       : rises && c.takes_impulses()
                           ? "friction that rises with the slip rate at a rigid contact"
                           : nullptr;
    if (what != nullptr)
      throw SceneError(
          scene.contacts[k].place,
          scene.contacts[k].key(remembers || multiplies || c.compliance_split() ? "law"
                                : c.curved_surface()                            ? "radius"
                                                                                : "friction"),
          fmt::format("sensitivities cannot differentiate {}; use differences between runs of a sweep",
                      what));
  }
}

}  // namespace signorini::sensitivity
