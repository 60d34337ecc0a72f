#include "linear/pinned.hpp"

#include <array>
#include <optional>

namespace signorini {
namespace {

/// x_dof = (normal r + tangent q)/divisor.
struct Share {
  int dof = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// Shares of the two degrees of freedom that are common to both forms, from n . x = r and t . x = q.
std::optional<std::array<Share, 2>> shares(const Combination& n, const Combination& t) {
  if (n.terms.size() != 2 || t.terms.size() != 2) return std::nullopt;
  const auto [i, ni] = n.terms[0];
  const auto [j, nj] = n.terms[1];
  const bool same = t.terms[0].first == i && t.terms[1].first == j;
  if (!same && !(t.terms[0].first == j && t.terms[1].first == i)) return std::nullopt;
  const double ti = t.terms[same ? 0 : 1].second, tj = t.terms[same ? 1 : 0].second;
  const double det = ni * tj - nj * ti;
  if (det == 0.0) return std::nullopt;
  return std::array<Share, 2>{{{i, tj, -nj, det}, {j, -ti, ni, det}}};
}

}  // namespace

std::vector<Pinned> pinned_by(const Model& model, const std::vector<Rows>& rows) {
  std::vector<Pinned> result;
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const bool held = rows[c].normal.an != 0.0 && rows[c].normal.N == 0.0, sticks = rows[c].tangent.at != 0.0;
    if (held && contact.normal.terms.size() == 1) {
      const auto [dof, factor] = contact.normal.terms[0];
      result.push_back({static_cast<std::size_t>(dof), c, 1.0, 0.0, factor});
    }
    if (sticks && contact.tangent.terms.size() == 1) {
      const auto [dof, factor] = contact.tangent.terms[0];
      result.push_back({static_cast<std::size_t>(dof), c, 0.0, 1.0, factor});
    }
    if (!held || !sticks) continue;
    if (const auto both = shares(contact.normal, contact.tangent))
      for (const Share& share : *both)
        result.push_back(
            {static_cast<std::size_t>(share.dof), c, share.normal, share.tangent, share.divisor});
  }
  return result;
}

void set_exactly(const Combination& form, double value, Vector& x) {
  if (form.terms.size() == 1) x[form.terms[0].first] = value / form.terms[0].second + 0.0;  // no -0
}

void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x) {
  set_exactly(n, r, x);
  set_exactly(t, q, x);
  if (const auto both = shares(n, t))
    for (const Share& share : *both)
      x[share.dof] = (share.normal * r + share.tangent * q) / share.divisor + 0.0;
}

}  // namespace signorini
