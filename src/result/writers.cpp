#include "result/writers.hpp"

#include <initializer_list>

namespace signorini {

namespace {

void header(CsvBlock& block, std::initializer_list<const char*> names) {
  for (const char* name : names) block.text(name);
  block.end_row();
}

}  // namespace

EventWriter::EventWriter(const std::filesystem::path& path, const Model& model) : model_(model), file_(path) {
  header(block_, {"t", "contact", "event", "from", "to", "gap", "N", "T", "N_after", "T_after", "vn",
                  "vn_after", "vt", "vt_after", "impulse_n", "impulse_t", "guard_rate", "t_uncertainty"});
  file_.write(block_);
}

void EventWriter::write(const Event& event) {
  block_.number(event.t);
  if (event.contact < 0) {
    block_.empty().text(to_string(event.type));
    for (int cell = 0; cell < 15; ++cell) block_.empty();
  } else {
    const Contact& contact = model_.contacts[static_cast<std::size_t>(event.contact)];
    block_.text(contact.name).text(to_string(event.type)).text(to_string(event.from));
    block_.text(to_string(event.to));
    if (contact.has_gap()) {
      block_.number(event.gap);
    } else {
      block_.empty();
    }
    block_.number(event.N).number(event.T).number(event.N_after).number(event.T_after);
    block_.number(event.vn).number(event.vn_after).number(event.vt).number(event.vt_after);
    block_.number(event.impulse_n).number(event.impulse_t);
    block_.number(event.guard_rate).number(event.t_uncertainty);
  }
  block_.end_row();
  file_.write(block_);
}

ContactWriter::ContactWriter(const std::filesystem::path& path, const Model& model)
    : model_(model), file_(path) {
  header(block_, {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T"});
  file_.write(block_);
}

void ContactWriter::write(const Sample& sample) {
  for (std::size_t k = 0; k < sample.contacts.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const ContactSample& row = sample.contacts[k];
    block_.number(sample.t).text(contact.name).text(to_string(row.state));
    if (contact.has_gap()) {
      block_.number(row.gap);
    } else {
      block_.empty();
    }
    block_.number(row.ut).number(row.vt).number(row.slip).number(row.N).number(row.T);
    block_.end_row();
  }
  file_.write(block_);
}

HistoryWriter::HistoryWriter(const std::filesystem::path& path, const Model& model)
    : model_(model), file_(path) {
  block_.text("t");
  for (const Column& column : model.columns) block_.text(column.name);
  block_.end_row();
  file_.write(block_);
}

void HistoryWriter::write(const Sample& sample) {
  block_.number(sample.t);
  for (const Column& column : model_.columns) {
    const Vector& vector = column.velocity ? *sample.v : *sample.u;
    block_.number(column.dof < 0 ? 0.0 : vector[column.dof]);  // below zero: held by a support
  }
  block_.end_row();
  file_.write(block_);
}

EnergyWriter::EnergyWriter(const std::filesystem::path& path) : file_(path) {
  header(block_, {"t", "kinetic", "elastic", "contact", "damping", "friction", "impact", "loads", "surface",
                  "balance"});
  file_.write(block_);
}

void EnergyWriter::write(const Sample& sample) {
  const Energy& e = sample.energy;
  block_.number(sample.t).number(e.kinetic).number(e.elastic).number(e.contact).number(e.damping);
  block_.number(e.friction).number(e.impact).number(e.loads).number(e.surface).number(e.balance());
  block_.end_row();
  file_.write(block_);
}

}  // namespace signorini
