#include "differential/deviation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini::differential {
namespace {

std::string side(const std::vector<compare::LoggedEvent>& events, const std::optional<std::size_t>& i) {
  return i ? fmt::format("{:.9g} {}", events[*i].t, events[*i].name()) : std::string("no more events");
}

/// Distance of event i to the nearest at another time, in units of their uncertainties.
double room_of(const std::vector<compare::LoggedEvent>& events, const std::optional<std::size_t>& i,
               double roundoff) {
  double room = Deviation::never;
  if (!i) return room;
  for (const compare::LoggedEvent& other : events) {
    const double distance = std::abs(other.t - events[*i].t);
    const double blur = std::max(other.uncertainty, events[*i].uncertainty);
    if (distance > roundoff && blur > 0.0) room = std::min(room, distance / blur);
  }
  return room;
}

/// |a - b|; std::max would drop what is not a number.
double apart(double a, double b) {
  const double difference = std::abs(a - b);
  return std::isfinite(difference) ? difference : Deviation::never;
}

double greatest(const Vector& a, const Vector& b, const std::vector<double>& weights) {
  double most = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    most = std::max(most, apart(a[at], b[at]) / weights[i]);
  }
  return most;
}

double greatest_force(const Result::Row& a, const Result::Row& b, double weight) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.contacts.size(); ++k)
    most = std::max({most, apart(a.contacts[k].N, b.contacts[k].N) / weight,
                     apart(a.contacts[k].T, b.contacts[k].T) / weight});
  return most;
}

void raise(std::vector<double>& list, const std::vector<double>& other) {
  if (list.size() < other.size()) list.resize(other.size(), list.empty() ? 0.0 : list.back());
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!other.empty()) list[i] = std::max(list[i], other[std::min(i, other.size() - 1)]);
}

bool same_but_end(const compare::LoggedEvent& a, const compare::LoggedEvent& b) {
  return a.contact == b.contact && a.type == b.type && a.from == b.from;
}

}  // namespace

Weights weights_of(const Model& model, const Track& reference) {
  // Of one kind together: a degree of freedom at rest has no scale of its own.
  double most[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, force = model.scales.force;
  for (const Result::Row& row : reference.rows) {
    for (std::size_t i = 0; i < model.dofs.size(); ++i) {
      double(&kind)[2] = most[model.dofs[i].rotation ? 1 : 0];
      kind[0] = std::max(kind[0], std::abs(row.u[static_cast<Eigen::Index>(i)]));
      kind[1] = std::max(kind[1], std::abs(row.v[static_cast<Eigen::Index>(i)]));
    }
    for (const ContactSample& c : row.contacts)
      force = std::max({force, model.scales.force + std::abs(c.N), model.scales.force + std::abs(c.T)});
  }
  Weights w;
  const Scales& s = model.scales;
  for (const Dof& dof : model.dofs) {
    w.u.push_back(dof.rotation ? s.rotation + most[1][0] : s.displacement + most[0][0]);
    w.v.push_back(dof.rotation ? s.angular_velocity + most[1][1] : s.velocity + most[0][1]);
  }
  w.force = force;
  return w;
}

void Deviation::include(const Deviation& other) {
  raise(u, other.u);
  raise(v, other.v);
  raise(force, other.force);
  reached = std::max(reached, other.reached);
  complete = complete || other.complete;
  for (const auto& [contact, list] : other.time) raise(time[contact], list);
  for (const auto& [contact, list] : other.uncertainty) raise(uncertainty[contact], list);
  if (other.splits() && (!splits() || other.aligned < aligned)) {
    aligned = other.aligned;
    split = other.split;
    room = other.room;
    until = other.until;
  } else if (!splits()) {
    aligned = std::max(aligned, other.aligned);
  }
}

Deviation deviation(const Track& reference, const Track& other, const Weights& weights, double t_end) {
  Deviation d;
  const double roundoff = 8.0 * std::numeric_limits<double>::epsilon() * t_end;
  const auto given_up = [](const Track& track) { return track.end == Track::End::too_long; };
  // A run that was given up ends there; one that stopped has said so by an event.
  for (const Track* track : {&reference, &other})
    if (given_up(*track)) t_end = std::min(t_end, track->t);
  const compare::Alignment alignment = compare::align(reference.events, other.events, {t_end, 0.0});
  d.aligned = alignment.pairs.size();
  std::vector<std::pair<double, double>> gaps;  // between the two times of each event
  double latest = 0.0, blurred = 0.0;
  for (const compare::AlignedPair& pair : alignment.pairs) {
    const compare::LoggedEvent &a = reference.events[pair.reference], &b = other.events[pair.other];
    latest = std::max(latest, apart(a.t, b.t));
    d.time[a.contact].push_back(latest);
    blurred = std::max(blurred, a.uncertainty + b.uncertainty);
    d.uncertainty[a.contact].push_back(blurred);
    gaps.emplace_back(std::min(a.t, b.t), std::max(a.t, b.t));
  }
  double last = std::min({t_end, reference.t, other.t});
  if (alignment.split && ((!alignment.split->reference && given_up(reference)) ||
                          (!alignment.split->other && given_up(other)))) {
    last = std::min(last, alignment.split->t);  // its next event was not made any more
  } else if (alignment.split) {
    const auto& s = *alignment.split;
    d.until = s.t;
    last = std::min(last, s.t);
    d.room =
        std::min(room_of(reference.events, s.reference, roundoff), room_of(other.events, s.other, roundoff));
    d.split = side(reference.events, s.reference) + " | " + side(other.events, s.other);
  }
  d.reached = last;
  d.complete = !d.splits() && !given_up(reference) && !given_up(other);
  for (std::size_t i = 0; i < std::min(reference.rows.size(), other.rows.size()); ++i) {
    const Result::Row &a = reference.rows[i], &b = other.rows[i];
    if (a.t != b.t || a.t >= last - roundoff) break;
    const bool between = std::any_of(gaps.begin(), gaps.end(), [&](const auto& gap) {
      return gap.first - roundoff <= a.t && a.t <= gap.second + roundoff;
    });
    const auto push = [](std::vector<double>& list, double value) {
      list.push_back(std::max(value, list.empty() ? 0.0 : list.back()));
    };
    push(d.u, greatest(a.u, b.u, weights.u));
    push(d.v, between ? 0.0 : greatest(a.v, b.v, weights.v));
    push(d.force, between ? 0.0 : greatest_force(a, b, weights.force));
  }
  return d;
}

bool rests_by_rounding(const Track& a, const Track& b, double t_end) {
  std::size_t i = 0;
  while (i < a.events.size() && i < b.events.size() && same_but_end(a.events[i], b.events[i]) &&
         a.events[i].to == b.events[i].to)
    ++i;
  if (i >= a.events.size() || i >= b.events.size() || !same_but_end(a.events[i], b.events[i])) return false;
  const compare::LoggedEvent& here = a.events[i];
  if (here.type != to_string(EventType::impact)) return false;
  const bool first_goes_on = here.to == to_string(State::open);
  const std::vector<compare::LoggedEvent>& goes_on = first_goes_on ? a.events : b.events;
  const double longest = std::sqrt(64.0 * std::numeric_limits<double>::epsilon()) * t_end;
  double left = here.t;
  for (std::size_t k = i; k < goes_on.size(); ++k) {
    const compare::LoggedEvent& e = goes_on[k];
    if (e.contact != here.contact) continue;
    if (!(e.t - left < longest)) return false;
    if (e.to != to_string(State::open)) return true;
    left = e.t;
  }
  return false;
}

}  // namespace signorini::differential
