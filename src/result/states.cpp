#include "result/states.hpp"

#include "model/assembly/loads.hpp"
#include "result/csv.hpp"
#include "scene/saved_state.hpp"

namespace signorini::result {

StateWriter::StateWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model), file_(directory / "states.csv") {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (c.sliding_point()) sliding_.push_back(k);
    if (!c.surface_motion.is_constant()) surfaces_.push_back(k);
    if (c.has_friction()) frictional_.push_back(k);
    if (!c.obeys_coulomb()) user_laws_.push_back(k);
  }
  // Sliding points are the last degrees of freedom. They have separate columns, which reduced models also
  // need.
  structural_ = model.physical_dofs().size() - (model.reduction ? 0 : sliding_.size());
  for (const Load& load : model.loads)
    if (load.kind == LoadKind::support) supports_.push_back(&load);
  write_header();
}

void StateWriter::write_header() {
  block_.text("t");
  for (std::size_t i = 0; i < structural_; ++i) block_.text(model_.physical_dofs()[i].displacement);
  for (std::size_t i = 0; i < structural_; ++i) block_.text(model_.physical_dofs()[i].velocity);
  for (const Load* support : supports_) block_.text(support->name);
  for (const Load* support : supports_) block_.text(assembly::rate_of(support->name));
  const auto name = [&](const std::vector<std::size_t>& contacts, const char* what) {
    for (const std::size_t k : contacts) block_.text(model_.contacts[k].name + what);
  };
  name(sliding_, ".slip");
  name(surfaces_, ".surface");
  name(frictional_, ".T");
  name(frictional_, ".state");
  name(user_laws_, ".own");
  name(user_laws_, ".memory");
  block_.end_row();
  file_.write(block_);
}

void StateWriter::write(const Sample& sample) {
  if (sample.t == last_) return;
  last_ = sample.t;
  block_.number(sample.t);
  for (const Vector* x : {sample.u, sample.v})
    for (std::size_t i = 0; i < structural_; ++i) block_.number((*x)[static_cast<Eigen::Index>(i)]);
  for (const int order : {0, 1})
    for (const Load* support : supports_)
      block_.number(support->history.piece(sample.t).value(sample.t, order));
  const auto surface = [&](std::size_t k) { return model_.contacts[k].surface_motion.value(sample.t); };
  for (const std::size_t k : sliding_) block_.number(sample.contacts[k].slip + surface(k));
  for (const std::size_t k : surfaces_) block_.number(surface(k));
  for (const std::size_t k : frictional_) block_.number(sample.contacts[k].T);
  for (const std::size_t k : frictional_)
    block_.text(std::string(signorini::to_string(sample.contacts[k].state)));
  for (const std::size_t k : user_laws_)
    block_.number(static_cast<double>(signorini::user_law_state_number(sample.contacts[k].state)));
  for (const std::size_t k : user_laws_) block_.number(sample.contacts[k].memory);
  block_.end_row();
  file_.write(block_);
}

std::string prestress_csv(const Prestress& forces) {
  CsvBlock block;
  for (const std::string& name : scene::prestress_columns()) block.text(name);
  block.end_row();
  for (const Prestress::Element& e : forces.elements) {
    block.text("member").text(e.from).text(e.to).number(e.at_from).number(e.at_to).empty();
    block.end_row();
  }
  for (const Prestress::Body& body : forces.bodies) {
    block.text("rigid").text(body.name).empty().empty().empty().number(body.stiffness);
    block.end_row();
  }
  return block.str();
}

}  // namespace signorini::result
