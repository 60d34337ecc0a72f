#include "run/motion_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "model/assembly/parts.hpp"

namespace signorini {
namespace {

// A file of five megabytes, where motions are slow enough for that.
constexpr std::size_t most_in_all = 40000, most_of_one = 8000, fewest_of_one = 400;
constexpr double fewest_intervals = 250.0;  // so that what stands still has rows, too
constexpr std::size_t most_drawn = 24;      // contacts with a picture of their own
// A step is some three radians of the fastest motion, which a line of eight pieces shows; but a picture shows
// no more than half a pixel, and must not be coarser than a pixel or two.
constexpr double pieces_of_step = 8.0, most_pieces_of_run = 2000.0, fewest_pieces_of_run = 600.0;
constexpr double most_pieces = 1000.0;

}  // namespace

MotionRecord::MotionRecord(const Model& model, double t_end, const Recorder& recorder)
    : t_end_(t_end), spacing_(t_end / most_pieces_of_run) {
  if (!recorder.wants_motion() || model.contacts.empty()) return;
  const std::size_t count = model.contacts.size();
  const std::size_t most = std::clamp(most_in_all / count, fewest_of_one, most_of_one);
  for (std::size_t k = 0; k < count; ++k)
    tracks_.push_back({{t_end, {most, k >= most_drawn, true, t_end / fewest_intervals}}});
  const auto parts = coupled_contacts(model);
  reached_.resize(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::size_t k : parts[i]) tracks_[k].part = i;
}

const std::vector<MotionRecord::Moment>& MotionRecord::moments(double begin, double end,
                                                               const std::vector<double>& turning_points) {
  moments_.clear();
  // Bodies that move alike turn at one time but for its rounding: a thousand of them are one moment.
  for (const double t : turning_points)
    if (moments_.empty() || t - moments_.back().t > rounding::of_time * std::abs(t))
      moments_.push_back({t, true});
  if (tracks_.empty()) return moments_;
  const double length = end - begin;
  const double spacing = std::min(std::max(length / pieces_of_step, spacing_), t_end_ / fewest_pieces_of_run);
  const int pieces = spacing > 0.0 ? static_cast<int>(std::min(length / spacing, most_pieces)) : 1;
  if (pieces <= 1) return moments_;
  for (int i = 1; i < pieces; ++i) moments_.push_back({begin + length * i / pieces, false});
  std::sort(moments_.begin(), moments_.end(), [](const Moment& a, const Moment& b) { return a.t < b.t; });
  return moments_;
}

bool MotionRecord::needs(double t) const {
  return !tracks_.empty() && (t - last_ >= spacing_ || t >= t_end_);
}

void MotionRecord::add(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode,
                       const Point& point) {
  if (tracks_.empty()) return;
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    keep(tracks_[k], {t, auditor.sample(k, forcing, t, mode[k], point)});
  last_ = t;
}

void MotionRecord::before(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode,
                          const Point& point) {
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    tracks_[k].before = {t, auditor.sample(k, forcing, t, mode[k], point)};
}

void MotionRecord::after(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode,
                         const Point& point, const std::optional<std::vector<std::size_t>>& changed) {
  if (tracks_.empty()) return;
  reached_.assign(reached_.size(), !changed);
  if (changed)
    for (const std::size_t k : *changed) reached_[tracks_[k].part] = true;
  bool all = true;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    Track& track = tracks_[k];
    const double last = track.rows.rows().empty() ? -t_end_ : track.rows.rows().back().t;
    if (!reached_[track.part] && t - last < spacing_) {
      all = false;
      continue;
    }
    if (reached_[track.part] && !track.rows.rows().empty() && last < track.before.t)
      keep(track, track.before);
    keep(track, {t, auditor.sample(k, forcing, t, mode[k], point)});
  }
  if (all) last_ = t;
}

void MotionRecord::keep(Track& track, const MotionRow& row) {
  track.rows.add(row);
  spacing_ = std::min(std::max(spacing_, track.rows.width()), t_end_ / fewest_pieces_of_run);
}

void MotionRecord::write(Recorder& recorder) {
  double length = 0.0, force = 0.0;
  for (const Track& track : tracks_) {
    force = std::max({force, track.rows.size(0), track.rows.size(1)});
    length = std::max({length, track.rows.size(2), track.rows.size(3)});
  }
  force *= rounding::of_elimination;
  length *= rounding::of_elimination;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    tracks_[k].rows.close({force, force, length, length, 0.0});
    recorder.motion(static_cast<int>(k), tracks_[k].rows.rows());
  }
}

}  // namespace signorini
