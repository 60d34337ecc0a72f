#include "sensitivity/law_rates.hpp"

#include "contact/law.hpp"

namespace signorini {

LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                   const ContactRates& rates, const Forcing& forcing, double t, const TangentSource& source) {
  LawRates result;
  const double pressing = forcing.pressing(c, t, 0);
  result.law = force_law(contact, state, pressing);
  const Rows row = rows(contact, state);
  const Rows& by = rates.rows[index_of(state.state)];
  const std::size_t place = c * source.forcing.count;
  ForceLaw& d = result.rates;
  d.N_gap = -by.normal.gap;
  d.N_constant = -(by.normal.pressing * pressing + row.normal.pressing * source.forcing.pressing[place] +
                   by.normal.constant);
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

}  // namespace signorini
