#include "study/reduction/left_out.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

Vector vector_of(const Combination& form, Eigen::Index n) {
  Vector x = Vector::Zero(n);
  form.add_to(x, 1.0);
  return x;
}

}  // namespace

namespace {

/// A tied node's motion follows from that of its body.
Vector form_of(const Column& column, const Model& full) {
  const Eigen::Index n = full.size();
  if (column.dof < n) return Vector::Unit(n, column.dof);
  return full.ties->rows.transpose() * Vector::Unit(full.ties->rows.rows(), column.dof - n);
}

}  // namespace

std::vector<AskedPlace> asked_places(const Model& full) {
  std::vector<AskedPlace> places;
  const Eigen::Index n = full.size();
  for (const Contact& contact : full.contacts) {
    if (!contact.normal_force_given())
      places.push_back({fmt::format("normal of contact '{}'", contact.name), vector_of(contact.normal, n)});
    if (contact.has_friction())
      places.push_back({fmt::format("tangent of contact '{}'", contact.name), vector_of(contact.tangent, n)});
  }
  for (const Column& column : full.columns)
    if (!column.velocity && column.dof >= 0 && !full.turns(column))
      places.push_back({column.name, form_of(column, full)});
  return places;
}

LeftOut::LeftOut(const Model& full, const Eigen::VectorXd& square, const Eigen::MatrixXd& shapes,
                 Eigen::Index kept, double step)
    : full_(full), step_(step) {
  const Eigen::Index n = full.size(), modes = square.size() - kept;
  const Eigen::MatrixXd phi = shapes.rightCols(modes);
  square_ = square.tail(modes).array();
  decay_ = (phi.array() * (full.damping * phi).array()).colwise().sum().transpose();
  const std::vector<AskedPlace> places = asked_places(full);
  const Eigen::MatrixXd seen = full.basis ? Eigen::MatrixXd(*full.basis * phi) : phi;
  places_.resize(static_cast<Eigen::Index>(places.size()), modes);
  for (std::size_t p = 0; p < places.size(); ++p)
    places_.row(static_cast<Eigen::Index>(p)) = places[p].form.transpose() * seen;
  missed_.assign(places.size(), 0.0);
  inputs_.setZero(modes, full.force_count());
  for (std::size_t c = 0; c < full.contacts.size(); ++c) {
    inputs_.col(static_cast<Eigen::Index>(full.layout.normal(c))) =
        -phi.transpose() * vector_of(full.contacts[c].normal, n);
    inputs_.col(static_cast<Eigen::Index>(full.layout.tangent(c))) =
        -phi.transpose() * vector_of(full.contacts[c].tangent, n);
  }
  loads_.resize(modes, static_cast<Eigen::Index>(full.loads.size()));
  for (std::size_t i = 0; i < full.loads.size(); ++i)
    loads_.col(static_cast<Eigen::Index>(i)) = phi.transpose() * vector_of(full.loads[i].direction, n);
  z_ = (phi.transpose() * (full.mass * full.u0)).array();
  v_ = (phi.transpose() * (full.mass * full.v0)).array();
  to_z_z_.resize(modes);
  to_z_v_ = to_v_z_ = to_v_v_ = to_z_z_;
  for (Eigen::Index j = 0; j < modes; ++j) {
    const double half = 0.5 * decay_[j], inside = square_[j] - half * half,
                 size = std::sqrt(std::abs(inside));
    const double fall = std::exp(-half * step);
    double even = std::cos(size * step), odd = size > 0.0 ? std::sin(size * step) / size : step;
    if (inside < 0.0) {
      even = std::cosh(size * step);
      odd = std::sinh(size * step) / size;
    }
    to_z_z_[j] = fall * (even + half * odd);
    to_z_v_[j] = fall * odd;
    to_v_z_[j] = -fall * square_[j] * odd;
    to_v_v_[j] = fall * (even - half * odd);
  }
}

/// Advances from one sample to the next, with their neighbours: F = a0 + a1 s + a2 s^2 + a3 s^3, slopes by parabolas.
void LeftOut::advance(const Array& before, const Array& from, const Array& to, const Array& after) {
  const double h = step_;
  const Array slope = 0.5 * (to - before) / h, end_slope = 0.5 * (after - from) / h, rise = (to - from) / h;
  const Array a3 = (slope + end_slope - 2.0 * rise) / (h * h),
              a2 = (3.0 * rise - 2.0 * slope - end_slope) / h;
  const Array p3 = a3 / square_, p2 = (a2 - 3.0 * decay_ * p3) / square_;
  const Array p1 = (slope - 2.0 * decay_ * p2 - 6.0 * p3) / square_;
  const Array p0 = (from - decay_ * p1 - 2.0 * p2) / square_;
  const Array y = z_ - p0, w = v_ - p1;
  z_ = to_z_z_ * y + to_z_v_ * w + p0 + h * (p1 + h * (p2 + h * p3));
  v_ = to_v_z_ * y + to_v_v_ * w + p1 + h * (2.0 * p2 + 3.0 * h * p3);
  observe(to);
}

void LeftOut::observe(const Array& force) {
  const Eigen::VectorXd off = places_ * (z_ - force / square_).matrix();
  for (std::size_t p = 0; p < missed_.size(); ++p)
    missed_[p] = std::max(missed_[p], std::abs(off[static_cast<Eigen::Index>(p)]));
}

void LeftOut::sample(double t, const std::vector<double>& forces) {
  if (square_.size() == 0) return;
  Eigen::VectorXd acting(static_cast<Eigen::Index>(full_.loads.size()));
  for (std::size_t i = 0; i < full_.loads.size(); ++i)
    acting[static_cast<Eigen::Index>(i)] = full_.loads[i].history.value(t);
  const Eigen::Map<const Eigen::VectorXd> contacts(forces.data(), static_cast<Eigen::Index>(forces.size()));
  Array now = (loads_ * acting + inputs_ * contacts).array();
  if (forces_.empty()) {
    observe(now);
    forces_.push_back(now);  // the first sample is its own neighbour
  }
  forces_.push_back(std::move(now));
  if (forces_.size() < 4) return;
  advance(forces_[0], forces_[1], forces_[2], forces_[3]);
  forces_.erase(forces_.begin());
}

void LeftOut::finish() {
  if (forces_.size() == 3) advance(forces_[0], forces_[1], forces_[2], forces_[2]);
}

}  // namespace signorini
