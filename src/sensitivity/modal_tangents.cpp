#include "sensitivity/modal_tangents.hpp"

#include <algorithm>
#include <set>

#include "sensitivity/contact_rates.hpp"
#include "sensitivity/modal_stretch.hpp"

namespace signorini::sensitivity {
namespace {

constexpr double negligible_damping = 1e-13;  // rounding error of C_p - alpha M_p, relative to C_p

bool has_constant_excitation(const ForcingDerivatives& f) {
  const auto still = [&](const std::vector<double>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (i % f.count != 0 && rows[i] != 0.0) return false;
    return true;
  };
  return (!f.loaded || f.load.rightCols(f.load.cols() - 1).isZero(0.0)) && still(f.applied_normal_force) &&
         still(f.surface);
}

/// Degrees of freedom of columns and of contacts; all degrees of freedom in a reduced model.
std::vector<Eigen::Index> shown_dofs(const Model& model, const std::vector<const ModelDerivative*>& rates) {
  const std::vector<Eigen::Index> affected = contact_dofs(model, rates);
  std::set<Eigen::Index> dofs(affected.begin(), affected.end());
  if (model.is_physical())
    for (const Column& column : model.columns)
      if (column.dof >= 0) dofs.insert(column.dof);
  if (!model.is_physical())
    for (Eigen::Index i = 0; i < model.size(); ++i) dofs.insert(i);
  return {dofs.begin(), dofs.end()};
}

}  // namespace

ModalTangents::ModalTangents(const Model& model, const std::vector<const ModelDerivative*>& derivatives,
                             double usual)
    : model_(model), derivatives_(derivatives), shown_(shown_dofs(model, derivatives)), usual_(usual) {}
ModalTangents::~ModalTangents() = default;

bool ModalTangents::start(modal::ModalSystem& modes, const decide::Decision& decision,
                          const motion::Forcing& forcing, std::vector<TangentSource> sources) {
  stretch_.reset();
  if (!modes.basis().failure().empty() || forcing.varies()) return false;
  for (const TangentSource& source : sources)
    if (source.start != nullptr && !has_constant_excitation(source.forcing)) return false;
  std::shared_ptr<const modal::StateModes> state = modes.state(decision.states);
  if (!state->spectrum.failure().empty()) return false;
  if (!store_) {
    store_ = std::make_unique<TangentCache>();
    for (const ModelDerivative* d : derivatives_) {
      UnconstrainedRates& open = store_->open.emplace_back();
      const auto in_modes = [&](const SparseMatrix& a) {
        return Eigen::MatrixXd(modes.basis().shapes().transpose() * (a * modes.basis().shapes()));
      };
      if (d->stiffness.nonZeros() > 0) open.stiffness = in_modes(d->stiffness);
      if (d->mass.nonZeros() > 0) open.mass = in_modes(d->mass);
      const SparseMatrix drag = d->damping - modes.alpha() * d->mass;
      if (drag.norm() > negligible_damping * (d->damping.norm() + modes.alpha() * d->mass.norm()))
        open.damping = in_modes(drag);
    }
  }
  if (state->spectrum.pairs().empty())
    stretch_ =
        std::make_unique<ModalStretchOf<double>>(model_, derivatives_, *store_, modes, std::move(state),
                                                 decision, forcing, std::move(sources), shown_, usual_);
  else
    stretch_ = std::make_unique<ModalStretchOf<modal::Complex>>(model_, derivatives_, *store_, modes,
                                                                std::move(state), decision, forcing,
                                                                std::move(sources), shown_, usual_);
  return true;
}

MotionAndTangents ModalTangents::at(double t, bool whole) { return stretch_->at(t, whole); }
MotionAndTangents ModalTangents::motion(double t) const { return stretch_->motion(t); }

}  // namespace signorini::sensitivity
