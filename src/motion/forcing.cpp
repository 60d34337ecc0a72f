#include "motion/forcing.hpp"

#include "base/history/pieces.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::motion {
namespace {

const Piece* piece(const History& history, double t, Side side) {
  return side == Side::after ? &history.piece(t) : &history.piece_before(t);
}

bool changes(const Piece& piece) {
  return piece.function || piece.amplitude != 0.0 ||
         std::any_of(piece.coefficients.begin(), piece.coefficients.end(),
                     [&](const double& c) { return &c != piece.coefficients.data() && c != 0.0; });
}

bool vanishes(const Piece& piece) {
  return !changes(piece) && (piece.coefficients.empty() || piece.coefficients[0] == 0.0);
}

}  // namespace

Forcing::Forcing(const Model& model, double t, Side side) : Forcing(model) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Piece* p = piece(model.loads[i].history, t, side);
    if (changes(*p))
      varying_.emplace_back(i, p);
    else if (!vanishes(*p))
      model.loads[i].direction.add_to(constant_, p->coefficients[0]);
    if (changes(*p) || vanishes(*p)) continue;
    for (const auto& [dof, factor] : model.loads[i].direction.terms)
      constant_terms_[dof] += std::abs(factor * p->coefficients[0]);
  }
  for (const Contact& contact : model.contacts) {
    applied_normal_force_.push_back(piece(contact.normal_force, t, side));
    surface_.push_back(piece(contact.surface_motion, t, side));
    moves_.push_back(changes(*surface_.back()));
    normal_force_varies_.push_back(changes(*applied_normal_force_.back()));
    constant_surface_.push_back(surface_.back()->value(t));
    constant_normal_force_.push_back(applied_normal_force_.back()->value(t));
    driven_.push_back(moves_.back() || normal_force_varies_.back());
    varies_ = varies_ || driven_.back();
    if (!vanishes(*applied_normal_force_.back()))
      loaded_contacts_.push_back(applied_normal_force_.size() - 1);
    if (!vanishes(*surface_.back())) moving_surfaces_.push_back(surface_.size() - 1);
    unloaded_.push_back(contact.normal_force_given() && vanishes(*applied_normal_force_.back()));
  }
  varies_ = varies_ || !varying_.empty();
  has_loads_ = !varying_.empty() || !constant_.isZero(0.0);
}

double Forcing::surface_rounding(std::size_t k, double t) const {
  return moves_[k] ? history::roundoff_of_rate(*surface_[k], t) : 0.0;
}

void Forcing::add_load(double t, int order, double* P, double factor) const {
  if (order == 0)
    for (Eigen::Index i = 0; i < constant_.size(); ++i) P[i] += factor * constant_[i];
  for (const auto& [load, p] : varying_) model_->loads[load].direction.add_to(P, factor * p->value(t, order));
}

std::size_t Forcing::surface_terms(std::size_t k) const {
  constexpr std::size_t of_wave = 13, of_function = 9;  // user-defined functions have orders up to 8
  const Piece& p = *surface_[k];
  return std::max({p.coefficients.size(), std::size_t{1}, p.amplitude != 0.0 ? of_wave : 0,
                   p.function ? of_function : 0});
}

Forcing Forcing::none(const Model& model) {
  static const Piece still;
  Forcing f(model);
  f.applied_normal_force_.assign(model.contacts.size(), &still);
  f.surface_ = f.applied_normal_force_;
  f.unloaded_.assign(model.contacts.size(), false);
  f.moves_ = f.normal_force_varies_ = f.driven_ = f.unloaded_;
  f.constant_normal_force_.assign(model.contacts.size(), 0.0);
  f.constant_surface_ = f.constant_normal_force_;
  return f;
}

Forcing Forcing::on_part(const Model& part, const std::vector<int>& dofs,
                         const std::vector<std::size_t>& loads, const std::vector<std::size_t>& contacts,
                         const Vector& more) const {
  Forcing f(part);
  f.constant_ = constant_(dofs) + more;
  f.constant_terms_ = constant_terms_(dofs) + more.cwiseAbs();
  for (const auto& [load, p] : varying_) {
    const auto at = std::lower_bound(loads.begin(), loads.end(), load);
    if (at != loads.end() && *at == load)
      f.varying_.emplace_back(static_cast<std::size_t>(at - loads.begin()), p);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::size_t k = contacts[i];
    f.applied_normal_force_.push_back(applied_normal_force_[k]);
    f.surface_.push_back(surface_[k]);
    f.moves_.push_back(moves_[k]);
    f.normal_force_varies_.push_back(normal_force_varies_[k]);
    f.driven_.push_back(driven_[k]);
    f.unloaded_.push_back(unloaded_[k]);
    f.constant_normal_force_.push_back(constant_normal_force_[k]);
    f.constant_surface_.push_back(constant_surface_[k]);
    f.varies_ = f.varies_ || driven_[k];
    if (!vanishes(*applied_normal_force_[k])) f.loaded_contacts_.push_back(i);
    if (!vanishes(*surface_[k])) f.moving_surfaces_.push_back(i);
  }
  f.varies_ = f.varies_ || !f.varying_.empty();
  f.has_loads_ = !f.varying_.empty() || !f.constant_.isZero(0.0);
  return f;
}

void Forcing::expand(double t, double scale, std::size_t count, ForcingSeries& out) const {
  const auto clear = [&](std::vector<double>& rows, const std::vector<std::size_t>& held) {
    if (out.count != count || rows.size() != applied_normal_force_.size() * count)
      rows.assign(applied_normal_force_.size() * count, 0.0);
    else
      for (const std::size_t k : held) std::fill_n(rows.data() + k * count, count, 0.0);
  };
  clear(out.applied_normal_force, out.loaded_contacts);
  clear(out.surface, out.moving_surfaces);
  out.loaded_contacts = loaded_contacts_;
  out.moving_surfaces = moving_surfaces_;
  out.count = count;
  out.loads.resize(varying_.size() * count);
  out.rounding.resize(surface_.size());
  for (std::size_t k = 0; k < surface_.size(); ++k) out.rounding[k] = surface_rounding(k, t);
  for (std::size_t i = 0; i < varying_.size(); ++i)
    varying_[i].second->taylor(t, scale, count, out.loads.data() + i * count);
  for (const std::size_t k : loaded_contacts_)
    applied_normal_force_[k]->taylor(t, scale, count, out.applied_normal_force.data() + k * count);
  for (const std::size_t k : moving_surfaces_)
    surface_[k]->taylor(t, scale, count, out.surface.data() + k * count);
}

void Forcing::add_load(const ForcingSeries& series, std::size_t k, double* P) const {
  if (k == 0)
    for (Eigen::Index i = 0; i < constant_.size(); ++i) P[i] += constant_[i];
  for (std::size_t i = 0; i < varying_.size(); ++i)
    if (const double f = series.loads[i * series.count + k]; f != 0.0)
      model_->loads[varying_[i].first].direction.add_to(P, f);
}

void Forcing::add_load_terms(const ForcingSeries& series, std::size_t k, double* P) const {
  if (k == 0)
    for (Eigen::Index i = 0; i < constant_terms_.size(); ++i) P[i] += constant_terms_[i];
  for (std::size_t i = 0; i < varying_.size(); ++i)
    if (const double f = series.loads[i * series.count + k]; f != 0.0)
      for (const auto& [dof, factor] : model_->loads[varying_[i].first].direction.terms)
        P[dof] += std::abs(factor * f);
}

double Forcing::power(double t, const double* v) const {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < constant_.size(); ++i) sum += constant_[i] * v[i];
  for (const auto& [load, p] : varying_) sum += p->value(t) * model_->loads[load].direction.dot(v);
  return sum;
}

double Forcing::max_omega() const {
  double omega = 0.0;
  const auto consider = [&](const Piece* p) {
    if (p->amplitude != 0.0) omega = std::max(omega, std::abs(p->omega));
  };
  for (const auto& [load, p] : varying_) consider(p);
  for (const std::size_t k : loaded_contacts_) consider(applied_normal_force_[k]);
  for (const std::size_t k : moving_surfaces_) consider(surface_[k]);
  return omega;
}

double Forcing::surface_omega() const {
  double omega = 0.0;
  for (const std::size_t k : moving_surfaces_)
    if (const Piece* p = surface_[k]; p->amplitude != 0.0) omega = std::max(omega, std::abs(p->omega));
  return omega;
}

std::size_t Forcing::max_degree() const {
  std::size_t degree = 0;
  const auto consider = [&](const Piece* p) {
    for (std::size_t j = degree + 1; j < p->coefficients.size(); ++j)
      if (p->coefficients[j] != 0.0) degree = j;
  };
  for (const auto& [load, p] : varying_) consider(p);
  for (const std::size_t k : loaded_contacts_) consider(applied_normal_force_[k]);
  for (const std::size_t k : moving_surfaces_) consider(surface_[k]);
  return degree;
}

}  // namespace signorini::motion
