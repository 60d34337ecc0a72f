#include "result/frames.hpp"

namespace signorini {

namespace {

const char* name_of(DrawnElement::Kind kind) {
  switch (kind) {
    case DrawnElement::Kind::bar:
      return "bar";
    case DrawnElement::Kind::spring:
      return "spring";
    case DrawnElement::Kind::rigid:
      return "rigid";
    case DrawnElement::Kind::mesh:
      return "mesh";
    case DrawnElement::Kind::beam:
      break;
  }
  return "beam";
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model),
      shapes_(directory / "frames.csv", frame_table()),
      contacts_(directory / "frame_contacts.csv", frame_contact_table()) {}

void FrameWriter::write(const Sample& sample) {
  write_shape(sample);
  write_contacts(sample);
}

void FrameWriter::write_shape(const Sample& sample) {
  int element = 0;
  for (const DrawnElement& e : model_.drawing) {
    ++element;
    for (const int node : e.nodes)
      shapes_.add({sample.t, name_of(e.kind), element, model_.drawn_nodes[static_cast<std::size_t>(node)],
                   *sample.u});
  }
  for (const DrawnNode& node : model_.drawn_nodes)
    if (node.named) shapes_.add({sample.t, node.held ? "support" : "node", std::nullopt, node, *sample.u});
  shapes_.flush();
}

void FrameWriter::write_contacts(const Sample& sample) {
  for (std::size_t k = 0; k < model_.drawn_contacts.size() && k < sample.contacts.size(); ++k) {
    const DrawnContact& c = model_.drawn_contacts[k];
    if (c.node < 0) continue;
    contacts_.add({sample.t, model_.contacts[k], c, model_.drawn_nodes[static_cast<std::size_t>(c.node)],
                   sample.contacts[k], *sample.u});
  }
  contacts_.flush();
}

}  // namespace signorini
