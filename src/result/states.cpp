#include "result/states.hpp"

namespace signorini {

StateWriter::StateWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model), file_(directory / "states.csv") {
  block_.text("t");
  for (const Dof& dof : model.physical_dofs()) block_.text(dof.displacement);
  for (const Dof& dof : model.physical_dofs()) block_.text(dof.velocity);
  for (const Contact& c : model.contacts)
    if (c.has_friction()) block_.text(c.name + ".T");
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
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (model_.contacts[k].has_friction()) block_.number(sample.contacts[k].T);
  block_.end_row();
  file_.write(block_);
}

}  // namespace signorini
