#include "decide/enumeration.hpp"

#include <algorithm>
#include <utility>

#include "decide/delassus.hpp"
#include "motion/hold.hpp"

namespace signorini {

bool Enumeration::Best::acceptable() const { return forgiveness <= std::max(1.0, condition); }

std::vector<State> Enumeration::choices(const Participant& who) const {
  const Contact& contact = model_.contacts[who.contact];
  if (!contact.has_gap()) return {State::stick, State::slip_plus, State::slip_minus};
  if (!contact.has_friction()) return {State::open, State::closed};
  if (who.slipping) return {State::open, slip_along(who.sign)};
  return {State::open, State::stick, State::slip_plus, State::slip_minus};
}

/// Nothing: the rows of the mode are dependent.
std::optional<double> Enumeration::forgiveness_of(const Instant& instant, const Forcing& forcing,
                                                  const Block& block, const Mode& mode) {
  const ModeSystemPtr system = systems_.of(mode);
  if (!system) return std::nullopt;
  Vector u = instant.u, v = instant.v;
  hold(model_, *system, forcing, instant.t, u, v);
  std::vector<MotionJet> jets;
  (void)jets_.make(system, forcing, instant.t, u, v, jets);
  double most = 0.0;
  for (std::size_t c = 0; c < mode.size(); ++c)
    for (const GuardForm& guard : guards(model_.contacts[c], mode[c]))
      if (guard.kind != Guard::none)
        most = std::max(
            most, forgiveness(guard.form, jets[c], instant, block.known[c].of_motion().of(guard.kind).zeros));
  return most;
}

/// Of what the block's forces do to its accelerations when all of it is open.
double Enumeration::condition(const Block& block, Mode mode) {
  std::vector<std::size_t> contacts;
  CoulombProblem problem;
  for (const Participant& who : block.participants) {
    contacts.push_back(who.contact);
    mode[who.contact] = {State::open, 0.0};
  }
  const ModeSystemPtr system = systems_.of(mode);
  if (!system) return 1.0;
  problem.W = delassus(model_, *system, contacts).W;
  problem.b = Eigen::VectorXd::Zero(problem.W.rows());
  return condition_of(problem);
}

std::optional<Enumeration::Best> Enumeration::least_failing(const Instant& instant, const Forcing& forcing,
                                                            const Block& block, const Mode& mode) {
  const std::vector<Participant>& who = block.participants;
  if (who.empty() || who.size() > most_contacts) return std::nullopt;
  std::vector<std::vector<State>> options;
  std::size_t combinations = 1;
  for (const Participant& participant : who) {
    options.push_back(choices(participant));
    combinations *= options.back().size();
  }
  std::optional<Best> best;
  for (std::size_t code = 0; code < combinations; ++code) {
    Mode tried = mode;
    std::size_t rest = code;
    for (std::size_t i = 0; i < who.size(); ++i) {
      tried[who[i].contact].state = options[i][rest % options[i].size()];
      rest /= options[i].size();
    }
    const auto forgiven = forgiveness_of(instant, forcing, block, tried);
    if (forgiven && (!best || *forgiven < best->forgiveness)) best = Best{std::move(tried), *forgiven, 1.0};
  }
  if (best) best->condition = condition(block, mode);
  return best;
}

}  // namespace signorini
