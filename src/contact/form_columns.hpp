// form_columns.hpp: linear forms as columns of a matrix, restricted to the degrees of freedom that they depend on.
//
//   H_ij = weight_d factor_d of form j,   d: i-th degree of freedom of the forms, in the order of first occurrence
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// Matrix H, degrees of freedom x forms. weight: of a degree of freedom; 1 if absent.
[[nodiscard]] Eigen::MatrixXd form_columns(const std::vector<const Combination*>& forms,
                                           const std::function<double(int)>& weight = {});

}  // namespace signorini
