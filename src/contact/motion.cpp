#include "contact/motion.hpp"

#include <unordered_map>

namespace signorini::contact {

Eigen::MatrixXd form_columns(const std::vector<const Combination*>& forms,
                             const std::function<double(int)>& weight) {
  std::unordered_map<int, Eigen::Index> place;
  for (const Combination* form : forms)
    for (const auto& term : form->terms) place.emplace(term.first, static_cast<Eigen::Index>(place.size()));
  Eigen::MatrixXd h =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(place.size()), static_cast<Eigen::Index>(forms.size()));
  for (std::size_t j = 0; j < forms.size(); ++j)
    for (const auto& [dof, factor] : forms[j]->terms)
      h(place.at(dof), static_cast<Eigen::Index>(j)) += factor * (weight ? weight(dof) : 1.0);
  return h;
}

}  // namespace signorini::contact
