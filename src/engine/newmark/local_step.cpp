#include "engine/newmark/local_step.hpp"

#include <algorithm>
#include <utility>

namespace signorini::newmark {
namespace {

/// Initial radius in band widths; chosen. The entries of M^-1 of a beam with a consistent mass matrix decay by the factor
/// 2 - sqrt(3) per element, so they are below rounding after 28 elements. An element has about three positions, and the band
/// width is five. If the decay is slower, double_radius() is called.
constexpr std::size_t first_radius = 16;
constexpr std::size_t least_parts = 4;  // W contains at most a quarter of the structure; else no local step

}  // namespace

LocalStep::LocalStep(const Model& model, const linear::CondensedRows& rows)
    : model_(model),
      rows_(rows),
      radius_(first_radius * std::max<std::size_t>(1, rows.width())),
      by_N_(rows.contacts() > 0 ? rows.end_of_contact_dofs(rows.contacts() - 1) : 0),
      by_T_(by_N_.size()) {
  load_.setZero(static_cast<Eigen::Index>(rows.size()));
  std::vector<std::size_t> place_of(rows.size());
  for (std::size_t place = 0; place < rows.size(); ++place) place_of[rows.dof_at(place)] = place;
  for (const Load& load : model.loads) {
    Places& of_load = loads_.emplace_back(Places{rows.size(), 0});
    for (const auto& [dof, factor] : load.direction.terms) {
      const std::size_t place = place_of[static_cast<std::size_t>(dof)];
      of_load = {std::min(of_load.begin, place), std::max(of_load.end, place + 1)};
    }
  }
  end_ = {load_, load_, Vector::Zero(model.force_count()), load_};
}

std::optional<LocalStep::Window> LocalStep::window(std::size_t contact) const {
  const std::size_t n = rows_.size();
  Window w{n, 0, 0, 0};
  for (std::size_t i = rows_.first_contact_dof(contact); i < rows_.end_of_contact_dofs(contact); ++i) {
    w.begin = std::min<std::size_t>(w.begin, rows_.contact_dof(i).place);
    w.end = std::max<std::size_t>(w.end, rows_.contact_dof(i).place + 1);
  }
  if (w.begin >= w.end) return std::nullopt;  // the contact acts on no degree of freedom
  w.begin -= std::min(w.begin, radius_);
  w.end = std::min(n, w.end + radius_);
  if (least_parts * (w.end - w.begin) > n) return std::nullopt;
  w.outer_begin = w.begin - std::min(w.begin, rows_.width());
  w.outer_end = std::min(n, w.end + rows_.width());
  return w;
}

void LocalStep::predict(const Window& w, const motion::Point& from, double h) {
  const double *u0 = from.u.data(), *v0 = from.v.data(), *a0 = from.a.data();
  for (std::size_t place = w.outer_begin; place < w.outer_end; ++place) {
    const std::size_t i = rows_.dof_at(place);
    end_.u.data()[i] = u0[i] + h * (v0[i] + 0.25 * h * a0[i]);
    end_.v.data()[i] = v0[i] + 0.5 * h * a0[i];
  }
}

/// Computes b_W, and the coefficients in the matrix of the forces of each contact in W.
void LocalStep::assemble_loads(const Window& w, const motion::Forcing& forcing, const std::vector<Rows>& rows,
                               double t1) {
  for (std::size_t place = w.begin; place < w.end; ++place) {
    const std::size_t i = rows_.dof_at(place);
    load_.data()[i] = forcing.constant_load(i);
  }
  forcing.add_varying(
      t1, [&](std::size_t load) { return loads_[load].begin < w.end && loads_[load].end > w.begin; },
      load_.data());
  b_.resize(static_cast<Eigen::Index>(w.end - w.begin));
  contacts_.clear();
  for (std::size_t place = w.begin; place < w.end; ++place) {
    double sum = load_.data()[rows_.dof_at(place)];
    for (const linear::CondensedRows::Entry& e : rows_.entries(place))
      sum -= e.c * end_.v.data()[e.dof] + e.k * end_.u.data()[e.dof];
    b_.data()[place - w.begin] = sum;
    for (const std::uint32_t i : rows_.contact_dofs_at(place))
      contacts_.push_back(rows_.contact_dof(i).contact);
  }
  std::sort(contacts_.begin(), contacts_.end());
  contacts_.erase(std::unique(contacts_.begin(), contacts_.end()), contacts_.end());
  for (const std::size_t k : contacts_) {
    const Contact& contact = model_.contacts[k];
    const linear::CondensedRows::ContactCoefficients& held = rows_.coefficients(k);
    ContactMotion m;  // the part of the contact's motion that does not depend on the unknowns x
    contact::set_displacement(contact, end_.u, forcing.surface(k, t1, 0), m);
    contact::set_velocity(contact, end_.v, forcing.surface(k, t1, 1), m);
    m.applied_normal_force = forcing.applied_normal_force(k, t1, 0);
    double &N = end_.forces.data()[model_.layout.normal(k)],
           &T = end_.forces.data()[model_.layout.tangent(k)];
    N = -rows[k].normal.value(m) / held.normal_N;
    T = (-rows[k].tangent.value(m) - held.tangent_N * N) / held.tangent_T;
    if (held.on_motion) rows_.force_coefficients(k, weights_, by_N_.data(), by_T_.data());
    for (std::size_t i = rows_.first_contact_dof(k); i < rows_.end_of_contact_dofs(k); ++i)
      if (const linear::CondensedRows::ContactDof& at = rows_.contact_dof(i);
          at.place >= w.begin && at.place < w.end)
        b_.data()[at.place - w.begin] -= at.n * N + at.t * T;
  }
}

/// Solves A_WW x_W = b_W - A_WO y and writes x_W to b_. False: the elimination loses digits.
bool LocalStep::solve(const Window& w, const motion::Point& from, double h, const motion::Point& whole,
                      double longer) {
  const std::size_t size = w.end - w.begin, width = rows_.width();
  if (!band_ || band_->size() != size) band_.emplace(size, width);
  band_->clear(0, size);
  const double part = h / longer;
  const auto beside = [&](std::size_t place) {
    const std::size_t i = rows_.dof_at(place);
    return from.a.data()[i] + part * (whole.a.data()[i] - from.a.data()[i]);
  };
  for (std::size_t place = w.begin; place < w.end; ++place) {
    double *row = band_->row(place - w.begin), &b = b_.data()[place - w.begin];
    rows_.fill(place, weights_, by_N_.data(), by_T_.data(), row);
    const auto take_out = [&](std::size_t begin, std::size_t end) {
      for (std::size_t other = begin; other < end; ++other)
        b -= std::exchange(row[width + other - place], 0.0) * beside(other);
    };
    take_out(std::max(w.outer_begin, place - std::min(place, width)), w.begin);
    take_out(w.end, std::min(w.outer_end, place + width + 1));
  }
  if (!band_->factor()) return false;
  band_->solve(b_.data());
  return true;
}

/// Completes u and v of the contact's degrees of freedom and the contact forces in end_.
void LocalStep::read(std::size_t k, const std::vector<Rows>& rows, double h) {
  double &N = end_.forces.data()[model_.layout.normal(k)], &T = end_.forces.data()[model_.layout.tangent(k)];
  for (std::size_t i = rows_.first_contact_dof(k); i < rows_.end_of_contact_dofs(k); ++i) {
    const std::size_t dof = rows_.contact_dof(i).dof;
    const double x = end_.a.data()[dof];
    end_.u.data()[dof] += 0.25 * h * h * x;
    end_.v.data()[dof] += 0.5 * h * x;
    if (!rows_.coefficients(k).on_motion) continue;
    N -= by_N_[i] * x;
    T -= by_T_[i] * x;
  }
  if (const Form& tangent = rows[k].tangent; tangent.T == 1.0 && tangent.N != 0.0) T = -tangent.N * N;
}

const motion::Point* LocalStep::end(std::size_t contact, const motion::Forcing& forcing,
                                    const std::vector<Rows>& rows, const motion::Point& from, double t1,
                                    double h, const motion::Point& whole, double longer) {
  const auto w = window(contact);
  if (!w) return nullptr;
  weights_ = {1.0, 0.5 * h, 0.25 * h * h};
  predict(*w, from, h);
  assemble_loads(*w, forcing, rows, t1);
  if (!solve(*w, from, h, whole, longer)) return nullptr;
  for (std::size_t i = rows_.first_contact_dof(contact); i < rows_.end_of_contact_dofs(contact); ++i)
    end_.a.data()[rows_.contact_dof(i).dof] = b_.data()[rows_.contact_dof(i).place - w->begin];
  read(contact, rows, h);
  return &end_;
}

}  // namespace signorini::newmark
