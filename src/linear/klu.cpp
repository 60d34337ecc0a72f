#include "linear/klu.hpp"

#include <stdexcept>

#include "base/rounding.hpp"
#include "linear/factor_reader.hpp"

namespace signorini {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

// KLU reads only, but its interface is not const.
SuiteSparse_long* raw(const std::vector<std::int64_t>& v) {
  return reinterpret_cast<SuiteSparse_long*>(const_cast<std::int64_t*>(v.data()));
}
double* raw(const std::vector<double>& v) { return const_cast<double*>(v.data()); }

// Pivots kept from another step size may lose this much of their quality before new ones are chosen.
constexpr double kept_quality = 1e-3;

}  // namespace

struct Klu::Handles {
  klu_l_common common{};
  klu_l_symbolic* symbolic = nullptr;
  klu_l_numeric* numeric = nullptr;
  FactorReader reader;
  TriangularFactors factors;
  std::vector<double> work;
};

Klu::Klu(const std::vector<std::int64_t>& column_start, const std::vector<std::int64_t>& row)
    : h_(std::make_unique<Handles>()), column_start_(column_start), row_(row) {
  klu_l_defaults(&h_->common);
  const auto n = static_cast<SuiteSparse_long>(column_start.size()) - 1;
  h_->work.resize(column_start.size() - 1);
  h_->symbolic = klu_l_analyze(n, raw(column_start_), raw(row_), &h_->common);
  if (h_->symbolic == nullptr && h_->common.status != KLU_SINGULAR)
    throw std::runtime_error("KLU could not analyse the system matrix");
}

Klu::~Klu() {
  klu_l_free_numeric(&h_->numeric, &h_->common);
  klu_l_free_symbolic(&h_->symbolic, &h_->common);
}

bool Klu::factor(const std::vector<double>& values) {
  ++factorisations;
  if (h_->symbolic == nullptr) return false;
  klu_l_free_numeric(&h_->numeric, &h_->common);
  h_->numeric = klu_l_factor(raw(column_start_), raw(row_), raw(values), h_->symbolic, &h_->common);
  if (h_->numeric == nullptr || h_->common.status == KLU_SINGULAR) return false;
  klu_l_rcond(h_->symbolic, h_->numeric, &h_->common);
  fresh_rcond_ = h_->common.rcond;
  h_->reader.read(h_->symbolic, h_->numeric, &h_->common, true, h_->factors);
  return fresh_rcond_ >= rounding::eps;
}

bool Klu::refactor(const std::vector<double>& values) {
  if (h_->numeric == nullptr) return factor(values);
  ++refactorisations;
  if (klu_l_refactor(raw(column_start_), raw(row_), raw(values), h_->symbolic, h_->numeric, &h_->common) ==
          0 ||
      h_->common.status == KLU_SINGULAR)
    return factor(values);
  klu_l_rcond(h_->symbolic, h_->numeric, &h_->common);
  if (h_->common.rcond < kept_quality * fresh_rcond_) return factor(values);
  h_->reader.read(h_->symbolic, h_->numeric, &h_->common, false, h_->factors);
  return true;
}

void Klu::solve(double* b) { h_->factors.solve(b, h_->work.data()); }

const TriangularFactors& Klu::factors() const { return h_->factors; }

}  // namespace signorini
