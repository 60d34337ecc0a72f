#include "run/steering.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/suggest.hpp"
#include "model/rescale.hpp"
#include "run/choose_flow.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

bool is_given(const Load& load) {
  return load.kind == LoadKind::force || load.kind == LoadKind::moment || load.kind == LoadKind::distributed;
}

}  // namespace

void LoadChanges::set_load(const std::string& name, const History& history) {
  std::vector<std::string> names;
  for (const Load& load : model_.loads)
    if (is_given(load)) names.push_back(load.name);
  const auto found = std::find_if(model_.loads.begin(), model_.loads.end(),
                                  [&](const Load& load) { return is_given(load) && load.name == name; });
  if (found == model_.loads.end())
    throw SceneError(run_.place, "set_load",
                     fmt::format("found \"{}\", expected a force or a moment of the scene{}", name,
                                 suggestion(name, names)));
  const History next = rescaled(history, found->of_history, inverse(model_.unit));
  const double before = found->history.value(t_), after = next.value(t_);
  past_.push_back(std::exchange(found->history, found->history.then(t_, next)));
  for (std::vector<Output>* outputs : {&model_.outputs, &model_.reaction_sums})
    for (Output& output : *outputs)
      for_each_linear(output, [&](Output& linear) {
        for (Output::Given& given : linear.given)
          if (given.load == found->name) given.history = found->history.scaled(given.factor);
      });
  engine_.refuse(model_, run_);
  if (method_.flow == "modal" && !choose_flow(model_, run_).modal)
    throw SceneError(run_.place, "set_load",
                     "the flow in modes follows loads that change in jumps only; use run.flow = \"taylor\"");
  asked_.any = true;
  asked_.jump = asked_.jump || before != after;
}

}  // namespace signorini
