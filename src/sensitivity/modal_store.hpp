// modal_store.hpp: what modal_tangents.hpp keeps of states of contacts that come again.
//
//   of a state: B and G of every parameter (state_rates.hpp), what is shown of its modes, the numbers of the usual step
#pragma once

#include <map>

#include "sensitivity/oscillator_pairs.hpp"
#include "sensitivity/state_rates.hpp"

namespace signorini {

/// Chosen: states beyond it are forgotten, all at once.
inline constexpr std::size_t most_bytes_of_states = std::size_t{1} << 28;

template <class S>
struct StateStore {
  std::vector<ParameterModes<S>> parameters;
  RowMatrix shown;           // of amplitudes in a row (flat): the degrees of freedom that are shown
  OscillatorPairs<S> usual;  // of the usual time; empty: not asked for yet
};

/// Room for the numbers of one step.
template <class S>
struct Workshop {
  OscillatorPairs<S> pairs;
  Square<S> driven, driven_rate, dragging, dragging_rate;
};

struct ModalStore {
  std::vector<OpenRates> open;
  std::map<std::vector<State>, StateStore<double>> real;
  std::map<std::vector<State>, StateStore<Complex>> pairs;
  std::size_t bytes = 0;
  Workshop<double> real_work;
  Workshop<Complex> pair_work;
  Workshop<double>& work(double) { return real_work; }
  Workshop<Complex>& work(Complex) { return pair_work; }

  StateStore<double>* find(const std::vector<State>& states, double) {
    const auto at = real.find(states);
    return at == real.end() ? nullptr : &at->second;
  }
  StateStore<Complex>* find(const std::vector<State>& states, Complex) {
    const auto at = pairs.find(states);
    return at == pairs.end() ? nullptr : &at->second;
  }
  StateStore<double>& keep(const std::vector<State>& states, StateStore<double> made) {
    return real.insert_or_assign(states, std::move(made)).first->second;
  }
  StateStore<Complex>& keep(const std::vector<State>& states, StateStore<Complex> made) {
    return pairs.insert_or_assign(states, std::move(made)).first->second;
  }
};

}  // namespace signorini
