// matrix_forms.hpp: random matrices and linear forms of scenes with [matrices].
//
//   gram          factor L L^T of the given rank
//   normal_form   a sparse form on displacements
//   tangent_form  more often than not one along which a normal impulse does no work: t . M^-1 n = 0, so
//                 that Painleve's paradox is rare
#pragma once

#include <vector>

#include "differential/random.hpp"

namespace signorini::differential {

using Form = std::vector<double>;
using Matrix = std::vector<Form>;

[[nodiscard]] Matrix square(std::size_t n);
[[nodiscard]] Matrix gram(Random& draw, std::size_t n, std::size_t rank, double factor);
/// Greatest magnitude.
[[nodiscard]] double greatest(const Form& f);
[[nodiscard]] Form unit(std::size_t n, std::size_t i);
[[nodiscard]] Form sparse_form(Random& draw, std::size_t n);
/// k, the number of the contact, where chance leaves nothing of the form.
[[nodiscard]] Form normal_form(Random& draw, std::size_t n, std::size_t k);
[[nodiscard]] Form tangent_form(Random& draw, const Matrix& mass, const Form& normal, std::size_t k);
[[nodiscard]] Matrix mass_matrix(Random& draw, std::size_t n);
/// alpha M + beta K
[[nodiscard]] Matrix damping_matrix(Random& draw, const Matrix& mass, const Matrix& stiffness);

}  // namespace signorini::differential
