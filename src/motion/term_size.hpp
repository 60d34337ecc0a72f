// term_size.hpp: uncertainty of form . x due to one rounding of the data, in roundings.
//
//   |form| |x|  in the plane, whatever the angle between them and the axes;  sum |form_i x_i|  of unlike coordinates
#pragma once

#include <cmath>

#include "signorini/model.hpp"

namespace signorini {

inline constexpr std::size_t most_plane_terms = 4;  // for a form on the translations of one node, or of two

/// x: maps a degree of freedom to its size. Components that the form does not contain do not count.
template <class Size>
double size_by(const Model& model, const Combination& form, const Size& x) {
  double terms = 0.0, form_squared = 0.0, x_squared = 0.0;
  for (const auto& [dof, factor] : form.terms) {
    const bool in_plane =
        form.terms.size() <= most_plane_terms && !model.dofs[static_cast<std::size_t>(dof)].rotation;
    if (!in_plane) {
      terms += std::abs(factor * x(dof));
    } else if (factor != 0.0) {
      form_squared += factor * factor;
      x_squared += x(dof) * x(dof);
    }
  }
  return terms + std::sqrt(form_squared * x_squared);
}
template <class Entries>
double size_of(const Model& model, const Combination& form, const Entries& x) {
  return size_by(model, form, [&x](int dof) { return x[dof]; });
}

}  // namespace signorini
