#include "result/writers.hpp"

#include <variant>

namespace signorini {

EventWriter::EventWriter(const std::filesystem::path& path, const Model& model) : model_(model), file_(path) {
  for (const EventColumn& column : event_columns) block_.text(column.name);
  block_.end_row();
  file_.write(block_);
}

void EventWriter::write(const Event& event) {
  for (const EventColumn& column : event_columns) {
    if (event.contact < 0 && column.of_contact)
      block_.empty();
    else
      std::visit([&](const auto field) { cell(event.*field); }, column.field);
  }
  block_.end_row();
  file_.write(block_);
}

void EventWriter::cell(double value) { block_.number(value); }
void EventWriter::cell(const std::optional<double>& value) { block_.number(value); }
void EventWriter::cell(int contact) { block_.text(model_.contacts[static_cast<std::size_t>(contact)].name); }
void EventWriter::cell(EventType type) { block_.text(to_string(type)); }
void EventWriter::cell(State state) { block_.text(to_string(state)); }

ContactWriter::ContactWriter(const std::filesystem::path& path, const Model& model)
    : model_(model), file_(path) {
  for (const char* name : {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T"}) block_.text(name);
  block_.end_row();
  file_.write(block_);
}

void ContactWriter::row(double t, std::size_t k, const ContactSample& sample) {
  const Contact& contact = model_.contacts[k];
  block_.number(t).text(contact.name).text(to_string(sample.state));
  if (contact.has_gap()) {
    block_.number(sample.gap);
  } else {
    block_.empty();
  }
  block_.number(sample.ut).number(sample.vt).number(sample.slip).number(sample.N).number(sample.T);
  block_.end_row();
}

void ContactWriter::write(const Sample& sample) {
  for (std::size_t k = 0; k < sample.contacts.size(); ++k) row(sample.t, k, sample.contacts[k]);
  file_.write(block_);
}

void ContactWriter::write(int contact, const std::vector<MotionRow>& rows) {
  constexpr std::size_t most = 1000;  // a block: the text of all takes more memory than the rows
  for (std::size_t i = 0; i < rows.size(); ++i) {
    row(rows[i].t, static_cast<std::size_t>(contact), rows[i].sample);
    if (i % most == most - 1) file_.write(block_);
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

ResponseWriter::ResponseWriter(const std::filesystem::path& path, const Model& model) : file_(path) {
  block_.text("t");
  for (const Output& output : model.outputs) block_.text(output.name);
  block_.end_row();
  file_.write(block_);
}

void ResponseWriter::write(double t, const std::vector<double>& values) {
  block_.number(t);
  for (const double value : values) block_.number(value);
  block_.end_row();
  file_.write(block_);
}

EnergyWriter::EnergyWriter(const std::filesystem::path& path) : file_(path) {
  block_.text("t");
  for (const EnergyColumn& column : energy_columns) block_.text(column.name);
  block_.text(balance_column).end_row();
  file_.write(block_);
}

void EnergyWriter::write(const Sample& sample) {
  block_.number(sample.t);
  for (const EnergyColumn& column : energy_columns) block_.number(sample.energy.*column.value);
  block_.number(sample.energy.balance()).end_row();
  file_.write(block_);
}

}  // namespace signorini
