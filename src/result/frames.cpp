#include "result/frames.hpp"

namespace signorini {

namespace {

double at(const Vector& u, int dof) { return dof < 0 ? 0.0 : u[dof]; }

const char* name_of(DrawnElement::Kind kind) {
  switch (kind) {
    case DrawnElement::Kind::bar:
      return "bar";
    case DrawnElement::Kind::spring:
      return "spring";
    case DrawnElement::Kind::rigid:
      return "rigid";
    case DrawnElement::Kind::beam:
      break;
  }
  return "beam";
}

void header(CsvBlock& block, CsvFile& file, std::initializer_list<const char*> names) {
  for (const char* name : names) block.text(name);
  block.end_row();
  file.write(block);
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model), shapes_(directory / "frames.csv"), contacts_(directory / "frame_contacts.csv") {
  header(block_, shapes_, {"t", "kind", "element", "node", "x", "y", "ux", "uy", "rz"});
  header(block_, contacts_,
         {"t", "contact", "state", "node", "x", "y", "ux", "uy", "nx", "ny", "tx", "ty", "N", "T"});
}

void FrameWriter::write(const Sample& sample) {
  write_shape(sample);
  write_contacts(sample);
}

void FrameWriter::node_cells(const DrawnNode& node, const Vector& u) {
  block_.text(node.name).number(node.x).number(node.y);
  for (const int dof : node.dofs) block_.number(at(u, dof));
  block_.end_row();
}

void FrameWriter::write_shape(const Sample& sample) {
  const Vector& u = *sample.u;
  int element = 0;
  for (const DrawnElement& e : model_.drawing) {
    ++element;
    for (const int node : e.nodes) {
      block_.number(sample.t).text(name_of(e.kind)).number(element);
      node_cells(model_.drawn_nodes[static_cast<std::size_t>(node)], u);
    }
  }
  for (const DrawnNode& node : model_.drawn_nodes) {
    if (!node.named) continue;
    block_.number(sample.t).text(node.held ? "support" : "node").empty();
    node_cells(node, u);
  }
  shapes_.write(block_);
}

void FrameWriter::write_contacts(const Sample& sample) {
  for (std::size_t k = 0; k < model_.drawn_contacts.size() && k < sample.contacts.size(); ++k) {
    const DrawnContact& c = model_.drawn_contacts[k];
    if (c.node < 0) continue;
    const DrawnNode& node = model_.drawn_nodes[static_cast<std::size_t>(c.node)];
    const ContactSample& now = sample.contacts[k];
    block_.number(sample.t).text(model_.contacts[k].name).text(to_string(now.state)).text(node.name);
    block_.number(c.x).number(c.y).number(at(*sample.u, node.dofs[0])).number(at(*sample.u, node.dofs[1]));
    block_.number(c.nx).number(c.ny).number(c.tx).number(c.ty).number(now.N).number(now.T);
    block_.end_row();
  }
  contacts_.write(block_);
}

}  // namespace signorini
