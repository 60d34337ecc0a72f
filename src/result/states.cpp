#include "result/states.hpp"

#include "model/assembly/loads.hpp"

namespace signorini {

StateWriter::StateWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model), file_(directory / "states.csv") {
  block_.text("t");
  for (const Dof& dof : model.physical_dofs()) block_.text(dof.displacement);
  for (const Dof& dof : model.physical_dofs()) block_.text(dof.velocity);
  for (const Load& load : model.loads)
    if (load.kind == LoadKind::support) supports_.push_back(&load);
  for (const Load* support : supports_) block_.text(support->name);
  for (const Load* support : supports_) block_.text(rate_of(support->name));
  for (const Contact& c : model.contacts)
    if (c.has_friction()) block_.text(c.name + ".T");
  for (const Contact& c : model.contacts)
    if (c.has_friction()) block_.text(c.name + ".state");
  block_.end_row();
  file_.write(block_);
}

void StateWriter::write(const Sample& sample) {
  if (sample.t == last_) return;
  last_ = sample.t;
  const auto n = static_cast<Eigen::Index>(model_.physical_dofs().size());
  block_.number(sample.t);
  for (const Vector* x : {sample.u, sample.v})
    for (Eigen::Index i = 0; i < n; ++i) block_.number((*x)[i]);
  for (const int order : {0, 1})
    for (const Load* support : supports_)
      block_.number(support->history.piece(sample.t).value(sample.t, order));
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (model_.contacts[k].has_friction()) block_.number(sample.contacts[k].T);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (model_.contacts[k].has_friction()) block_.text(std::string(to_string(sample.contacts[k].state)));
  block_.end_row();
  file_.write(block_);
}

}  // namespace signorini
