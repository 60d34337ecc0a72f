#include "linear/pinned.hpp"

namespace signorini {

std::vector<Pinned> pinned_by(const Model& model, const std::vector<Rows>& rows) {
  std::vector<Pinned> result;
  const auto add = [&](const Combination& form, std::size_t contact, bool tangent) {
    if (form.terms.size() == 1)
      result.push_back(
          {static_cast<std::size_t>(form.terms[0].first), contact, form.terms[0].second, tangent});
  };
  for (std::size_t c = 0; c < rows.size(); ++c) {
    if (rows[c].normal.an != 0.0 && rows[c].normal.N == 0.0) add(model.contacts[c].normal, c, false);
    if (rows[c].tangent.at != 0.0) add(model.contacts[c].tangent, c, true);
  }
  return result;
}

void set_exactly(const Combination& form, double value, Vector& x) {
  if (form.terms.size() == 1) x[form.terms[0].first] = value / form.terms[0].second + 0.0;  // no -0
}

}  // namespace signorini
