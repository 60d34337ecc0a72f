#include "result/frozen_forces.hpp"

#include "result/csv.hpp"
#include "scene/frozen_file.hpp"

namespace signorini {

std::string frozen_text(const FrozenForces& forces) {
  CsvBlock block;
  for (const std::string& name : frozen_heading()) block.text(name);
  block.end_row();
  for (const FrozenForces::Element& e : forces.elements) {
    block.text("member").text(e.from).text(e.to).number(e.at_from).number(e.at_to).empty();
    block.end_row();
  }
  for (const FrozenForces::Body& body : forces.bodies) {
    block.text("rigid").text(body.name).empty().empty().empty().number(body.stiffness);
    block.end_row();
  }
  return block.str();
}

}  // namespace signorini
