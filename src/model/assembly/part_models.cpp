#include "model/assembly/part_models.hpp"

#include <limits>
#include <utility>

#include "contact/constants.hpp"
#include "linear/restricted.hpp"
#include "model/assembly/parts.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_pieces = 2000000;  // pieces of histories in all copies together: about 300 MB

/// All motions that each contact acts on, one form per contact.
std::vector<Combination> reaches(const Model& model) {
  std::vector<Combination> forms;
  for (const Contact& contact : model.contacts) {
    auto& terms = forms.emplace_back().terms;
    visit_forms(contact,
                [&](const Combination& f) { terms.insert(terms.end(), f.terms.begin(), f.terms.end()); });
  }
  return forms;
}

std::size_t pieces_of(const Model& model) {
  std::size_t count = 0;
  for (const Load& load : model.loads) count += load.history.pieces().size();
  return count;
}

/// Assigns degrees of freedom, contacts and loads to parts, with their numbers there.
class Split {
 public:
  explicit Split(const Model& model) : model_(model), part_of_(model.dofs.size()), place_(model.dofs.size()) {
    const std::vector<Combination> forms = reaches(model);
    const Parts coupled({&model.mass, &model.damping, &model.stiffness}, forms);
    std::vector<std::size_t> part_of_set(coupled.count(), none);
    for (std::size_t k = 0; k < forms.size(); ++k) {
      // A form without terms goes with the first degree of freedom.
      const int dof = forms[k].terms.empty() ? 0 : forms[k].terms.front().first;
      std::size_t& part = part_of_set[coupled.part_of(dof)];
      if (part == none) {
        part = parts_.size();
        parts_.emplace_back();
      }
      parts_[part].contacts.push_back(k);
    }
    with_contacts_ = parts_.size();
    for (std::size_t i = 0; i < part_of_.size(); ++i) {
      std::size_t part = part_of_set[coupled.part_of(static_cast<int>(i))];
      if (part == none) {
        part = with_contacts_;
        if (parts_.size() == part) parts_.emplace_back();
      }
      part_of_[i] = part;
      place_[i] = static_cast<int>(parts_[part].dofs.size());
      parts_[part].dofs.push_back(static_cast<int>(i));
    }
  }

  /// Number of parts that have contacts.
  [[nodiscard]] std::size_t with_contacts() const { return with_contacts_; }
  [[nodiscard]] std::size_t count() const { return parts_.size(); }

  [[nodiscard]] std::vector<PartModel> models() {
    for (PartModel& part : parts_) part.model = restricted(model_, part.dofs, part.contacts);
    divide_loads();
    for (auto own : model_.columns) {
      std::size_t part = 0;
      if (own.dof >= 0) {
        part = part_of_[static_cast<std::size_t>(own.dof)];
        own.dof = place_[static_cast<std::size_t>(own.dof)];
      }
      parts_[part].model.columns.push_back(std::move(own));
    }
    return std::move(parts_);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void divide_loads() {
    std::vector<std::size_t> last(parts_.size(), none);  // last load given to each part
    for (std::size_t i = 0; i < model_.loads.size(); ++i) {
      const Load& load = model_.loads[i];
      const auto give = [&](std::size_t part) -> Load& {
        std::vector<Load>& loads = parts_[part].model.loads;
        if (std::exchange(last[part], i) != i) {
          Load own = without_direction(load);
          loads.push_back(std::move(own));
        }
        return loads.back();
      };
      for (const auto& [dof, factor] : load.direction.terms)
        give(part_of_[static_cast<std::size_t>(dof)])
            .direction.terms.emplace_back(place_[static_cast<std::size_t>(dof)], factor);
      if (load.direction.terms.empty()) give(0);
    }
  }

  const Model& model_;
  std::vector<PartModel> parts_;
  std::vector<std::size_t> part_of_;  // one per degree of freedom
  std::vector<int> place_;            // its number in its part
  std::size_t with_contacts_ = 0;
};

}  // namespace

std::vector<PartModel> part_models(const Model& model) {
  if (model.size() == 0 || !model.is_physical() || !model.outputs.empty() || !model.reaction_sums.empty())
    return {};
  Split split(model);
  if (split.with_contacts() < 2 || split.count() * pieces_of(model) > most_pieces) return {};
  return split.models();
}

}  // namespace signorini
