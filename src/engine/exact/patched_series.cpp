#include "engine/exact/patched_series.hpp"

#include <algorithm>
#include <utility>

#include "base/simd.hpp"

namespace signorini::exact {
namespace {

/// One Horner step for each entry: sum := sum x + factor a.
SIGNORINI_WIDE_LANES void horner(double* sum, const double* x, const double* a, double factor,
                                 std::size_t n) {
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4)
    base::lanes_at<base::Double4>(sum + i).v =
        base::lanes_at<base::Double4>(sum + i).v * base::lanes_at<base::Double4>(x + i).v +
        factor * base::lanes_at<base::Double4>(a + i).v;
  for (; i < n; ++i) sum[i] = sum[i] * x[i] + factor * a[i];
}

/// Up to this number of entries, each sum is computed separately, because loops over so few entries take longer than their
/// arithmetic.
constexpr std::size_t few = 4;

/// Sum of factors_k a_k x^k, k = 0 .. degree; all factors are 1 in the second overload. a_k is a[k * stride].
double sum_at(double x, const double* a, std::size_t stride, std::size_t degree, const double* factors) {
  double sum = 0.0;
  for (std::size_t k = degree + 1; k-- > 0;) sum = sum * x + factors[k] * a[k * stride];
  return sum;
}
double sum_at(double x, const double* a, std::size_t stride, std::size_t degree) {
  double sum = 0.0;
  for (std::size_t k = degree + 1; k-- > 0;) sum = sum * x + a[k * stride];
  return sum;
}

void copy_shifted(const Eigen::MatrixXd& from, Eigen::Index row, std::size_t count, double x, double* out) {
  for (std::size_t k = 0; k < count; ++k) out[k] = from(row, static_cast<Eigen::Index>(k));
  if (x != 0.0) motion::shift(out, count - 1, x);
}

}  // namespace

PatchedSeries::PatchedSeries(const Model& model) : model_(model), contacts_(model.contacts.size()) {}

void PatchedSeries::set_complete(std::size_t degree) {
  degree_ = degree;
  for (std::size_t k = 0; k <= degree_; ++k) {
    to_rate_[k] = static_cast<double>(k + 1) / whole.scale;
    to_acceleration_[k] = to_rate_[k] * static_cast<double>(k + 2) / whole.scale;
  }
  origins_.clear();
  force_origins_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    contacts_[c].fill(model_.contacts[c], c, whole, degree_);
    contacts_[c].set_origin(0.0);
  }
}

void PatchedSeries::patch(const motion::LocalSeries::LocalExpansion& near, double x, double reach) {
  origins_.resize(static_cast<std::size_t>(whole.u.rows()), 0.0);
  force_origins_.resize(static_cast<std::size_t>(whole.forces.rows()), 0.0);
  const std::vector<int>& dofs = near.where->dofs;
  for (Eigen::Index k = 0; k < near.series->u.cols(); ++k) {
    const double* from = near.series->u.col(k).data();
    double* to = whole.u.col(k).data();
    for (std::size_t i = 0; i < dofs.size(); ++i) to[dofs[i]] = from[i];
  }
  for (const int dof : dofs) origins_[static_cast<std::size_t>(dof)] = x;
  const std::size_t count = whole.forcing.count, known = near.series->forcing.count;
  for (std::size_t i = 0; i < near.where->contacts.size(); ++i) {
    const std::size_t c = near.where->contacts[i];
    const ForceLayout &layout = model_.layout, &part = near.series->layout;
    for (const auto& [slot, from] :
         {std::pair{layout.normal(c), part.normal(i)}, std::pair{layout.tangent(c), part.tangent(i)}}) {
      whole.forces.row(static_cast<Eigen::Index>(slot)).head(near.series->forces.cols()) =
          near.series->forces.row(static_cast<Eigen::Index>(from));
      force_origins_[slot] = x;
    }
    std::copy_n(near.series->forcing.applied_normal_force.data() + i * known, known,
                whole.forcing.applied_normal_force.data() + c * count);
    std::copy_n(near.series->forcing.surface.data() + i * known, known,
                whole.forcing.surface.data() + c * count);
    contacts_[c].fill(model_.contacts[c], c, whole, degree_);
    contacts_[c].set_origin(x);
    contacts_[c].bound_rates(reach);
  }
}

void PatchedSeries::displacement(int dof, double x, double* out) const {
  copy_shifted(whole.u, dof, static_cast<std::size_t>(whole.levels) + 3,
               x - origin_of(static_cast<std::size_t>(dof)), out);
}

void PatchedSeries::force(std::size_t slot, double x, double* out) const {
  copy_shifted(whole.forces, static_cast<Eigen::Index>(slot), static_cast<std::size_t>(whole.levels) + 1,
               x - (force_origins_.empty() ? 0.0 : force_origins_[slot]), out);
}

void PatchedSeries::evaluate_patches(double x, motion::Point& point) const {
  const std::size_t n = origins_.size(), forces = force_origins_.size();
  dof_offsets_.resize(n);
  force_offsets_.resize(forces);
  for (std::size_t i = 0; i < n; ++i) dof_offsets_[i] = x - origins_[i];
  for (std::size_t i = 0; i < forces; ++i) force_offsets_[i] = x - force_origins_[i];
  for (std::size_t k = degree_ + 1; k-- > 0;) {
    const double* u = whole.u.data() + k * n;
    horner(point.u.data(), dof_offsets_.data(), u, 1.0, n);
    horner(point.v.data(), dof_offsets_.data(), u + n, to_rate_[k], n);
    horner(point.forces.data(), force_offsets_.data(), whole.forces.data() + k * forces, 1.0, forces);
  }
}

void PatchedSeries::evaluate_without_accelerations(double x, motion::Point& point) const {
  const auto n = static_cast<std::size_t>(whole.u.rows());
  point.u.setZero(whole.u.rows());
  point.v.setZero(whole.u.rows());
  point.forces.setZero(whole.forces.rows());
  if (!origins_.empty()) return evaluate_patches(x, point);
  double *u = point.u.data(), *v = point.v.data(), *f = point.forces.data();
  const auto forces = static_cast<std::size_t>(whole.forces.rows());
  if (n <= few) {
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = sum_at(x, whole.u.data() + i, n, degree_);
      v[i] = sum_at(x, whole.u.data() + n + i, n, degree_, to_rate_.data());
    }
    for (std::size_t i = 0; i < forces; ++i) f[i] = sum_at(x, whole.forces.data() + i, forces, degree_);
    return;
  }
  for (std::size_t k = degree_ + 1; k-- > 0;) {
    const double* c0 = whole.u.data() + k * n;
    const double* c1 = c0 + n;
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = u[i] * x + c0[i];
      v[i] = v[i] * x + to_rate_[k] * c1[i];
    }
    const double* g = whole.forces.data() + k * forces;
    for (std::size_t i = 0; i < forces; ++i) f[i] = f[i] * x + g[i];
  }
}

void PatchedSeries::evaluate_at(double x, motion::Point& point) const {
  evaluate_without_accelerations(x, point);
  const auto n = static_cast<std::size_t>(whole.u.rows());
  point.a.setZero(whole.u.rows());
  double* a = point.a.data();
  if (n <= few && origins_.empty()) {
    for (std::size_t i = 0; i < n; ++i)
      a[i] = sum_at(x, whole.u.data() + 2 * n + i, n, degree_, to_acceleration_.data());
    return;
  }
  for (std::size_t k = degree_ + 1; k-- > 0;) {
    const double* c2 = whole.u.data() + (k + 2) * n;
    if (!origins_.empty()) {
      horner(a, dof_offsets_.data(), c2, to_acceleration_[k], n);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) a[i] = a[i] * x + to_acceleration_[k] * c2[i];
  }
}

void PatchedSeries::evaluate_without_accelerations(double x, std::size_t contact,
                                                   motion::Point& point) const {
  point.u.resize(whole.u.rows());
  point.v.resize(whole.u.rows());
  point.forces.resize(whole.forces.rows());
  const Contact& c = model_.contacts[contact];
  for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent()})
    for (const auto& term : form->terms) {
      const auto n = static_cast<std::size_t>(whole.u.rows()), i = static_cast<std::size_t>(term.first);
      const double at = x - origin_of(i);
      point.u[term.first] = sum_at(at, whole.u.data() + i, n, degree_);
      point.v[term.first] = sum_at(at, whole.u.data() + n + i, n, degree_, to_rate_.data());
    }
  for (const std::size_t slot : {model_.layout.normal(contact), model_.layout.tangent(contact)}) {
    const double at = x - (force_origins_.empty() ? 0.0 : force_origins_[slot]);
    point.forces[static_cast<Eigen::Index>(slot)] =
        sum_at(at, whole.forces.data() + slot, static_cast<std::size_t>(whole.forces.rows()), degree_);
  }
}

}  // namespace signorini::exact
