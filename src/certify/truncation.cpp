#include "certify/truncation.hpp"

#include <algorithm>

namespace signorini {
namespace {

/// Contact force per error of its displacement; 0: unknown.
double stiffness_of(const Contact& contact, const ComplianceShare& share) {
  const double own = (share.normal ? contact.normal_spring() : contact.tangent_spring()).value_or(0.0);
  if (own > 0.0) return own;
  return share.compliance > 0.0 ? 1.0 / share.compliance : 0.0;
}

}  // namespace

Truncation truncation_of(const Model& model, const Reduction& reduction, const std::vector<Peak>& peaks) {
  if (peaks.size() < model.contacts.size()) return {};  // not computed
  std::vector<double> off(peaks.size(), reduction.ringing);
  for (const ComplianceShare& share : reduction.shares) {
    if (share.contact < 0) continue;
    const auto k = static_cast<std::size_t>(share.contact);
    const double force = share.normal ? peaks[k].N : peaks[k].T;
    off[k] = std::max(off[k], reduction.ringing + share.residual * force);
  }
  Truncation result;
  result.displacement = reduction.ringing;
  for (const ComplianceShare& share : reduction.shares) {
    if (share.contact < 0) continue;
    const auto k = static_cast<std::size_t>(share.contact);
    result.displacement = std::max(result.displacement, off[k]);
    result.force = std::max(result.force, off[k] * stiffness_of(model.contacts[k], share));
  }
  return result;
}

}  // namespace signorini
