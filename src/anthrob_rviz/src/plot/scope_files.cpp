// What a ScopeWidget writes and reads: pictures, numbers, layouts.
#include <QFile>
#include <QFileDialog>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPrintDialog>
#include <QPrinter>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "anthrob_core/files.h"
#include "plot/scope_widget.h"
#include "scope/csv.h"

namespace anthrob {
namespace {

QJsonObject json_of(const TriggerChoice& choice) {
  return {{"quantity", QString::fromStdString(choice.path)},
          {"level", choice.trigger.level},
          {"edge", static_cast<int>(choice.trigger.edge)},
          {"width_s", seconds(choice.trigger.width)},
          {"before", choice.trigger.pre},
          {"single", choice.single}};
}

TriggerChoice trigger_in(const QJsonObject& json) {
  TriggerChoice choice;
  choice.path = json["quantity"].toString().toStdString();
  choice.trigger.level = json["level"].toDouble();
  choice.trigger.edge = static_cast<Trigger::Edge>(std::min(std::max(json["edge"].toInt(), 0), 2));
  choice.trigger.width =
      std::llround(1e9 * std::min(std::max(json["width_s"].toDouble(1.0), 0.001), 60.0));
  choice.trigger.pre = std::min(std::max(json["before"].toDouble(0.2), 0.0), 1.0);
  choice.single = json["single"].toBool();
  return choice;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string ScopeWidget::csv_text() const {
  const std::vector<Curve> curves = model_->curves();
  std::set<std::size_t> sources;
  for (const Curve& curve : curves) sources.insert(curve.source);
  const bool several = sources.size() > 1;
  std::vector<CsvColumn> columns;
  for (const Curve& curve : curves) {
    const std::string source = several ? model_->sources()[curve.source].name + ":" : std::string();
    columns.push_back({source + curve.quantity.path, curve.samples, several ? curve.zero : 0});
  }
  std::ostringstream text;
  // Stamps of two recordings are of different days: there it is the time axis of the plots.
  write_csv(several ? "t" : "stamp", columns, text);
  return text.str();
}

std::optional<std::string> ScopeWidget::export_to(const std::string& file) {
  if (model_->curves().empty())
    return file + ": nothing is plotted, so that there is nothing to export";
  redraw();
  bool done = true;
  try {
    if (ends_with(file, ".csv")) {
      write_file_atomically(file, csv_text());
    } else if (ends_with(file, ".svg")) {
      write_file_atomically(file, plots_->svg("Scope"));
    } else if (ends_with(file, ".png")) {
      done = plots_->save_png(file);
    } else if (ends_with(file, ".pdf")) {
      done = plots_->save_pdf(file);
    } else {
      return file + ": expected a name that ends in .csv, .svg, .pdf or .png";
    }
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  if (!done) return file + ": cannot be written";
  return std::nullopt;
}

void ScopeWidget::ask_to_export() {
  const QString file = QFileDialog::getSaveFileName(
      this, "Export", QString(), "Numbers (*.csv);;Picture (*.svg *.pdf *.png);;All files (*)");
  if (file.isEmpty()) return;
  const auto wrong = export_to(file.toStdString());
  note(wrong.value_or("wrote " + file.toStdString()), wrong.has_value());
}

void ScopeWidget::print() {
  QPrinter printer(QPrinter::HighResolution);
  printer.setPageOrientation(QPageLayout::Landscape);
  if (QPrintDialog(&printer, this).exec() != QDialog::Accepted) return;
  plots_->print(printer);
}

QString ScopeWidget::layout_text() const {
  QJsonArray ticked, recordings;
  for (const std::string& path : model_->ticked()) ticked.append(QString::fromStdString(path));
  for (const SourceView& source : model_->sources()) {
    if (source.live) continue;
    recordings.append(QJsonObject{{"path", QString::fromStdString(source.path)},
                                  {"shown", source.shown},
                                  {"shift_s", source.later}});
  }
  const QJsonObject json{
      {"ticked", ticked},
      {"recordings", recordings},
      {"arrangement", arrangement_->currentIndex()},
      {"oscilloscope", mode_->currentIndex() == static_cast<int>(Mode::kOscilloscope)},
      {"trigger", json_of(trigger_->choice())},
      {"difference", differences_->isChecked()},
      {"width_s", plots_->range().end - plots_->range().begin}};
  return QString::fromUtf8(QJsonDocument(json).toJson(QJsonDocument::Compact));
}

std::optional<std::string> ScopeWidget::restore_layout(const QString& text) {
  QJsonParseError error;
  const QJsonDocument document = QJsonDocument::fromJson(text.toUtf8(), &error);
  if (!document.isObject()) return "no layout of a scope: " + error.errorString().toStdString();
  const QJsonObject json = document.object();
  for (std::size_t i = model_->sources().size(); i-- > 1;) model_->close(i);
  model_->tick(std::set<std::string>(model_->ticked()), false);
  std::optional<std::string> wrong;
  for (const auto& value : json["recordings"].toArray()) {
    const QJsonObject recording = value.toObject();
    const auto refused = open(recording["path"].toString().toStdString());
    if (refused) {
      wrong = refused;
      continue;
    }
    const std::size_t last = model_->sources().size() - 1;
    model_->show(last, recording["shown"].toBool(true));
    model_->shift(last, recording["shift_s"].toDouble());
  }
  std::set<std::string> ticked;
  for (const auto& value : json["ticked"].toArray()) ticked.insert(value.toString().toStdString());
  tick(ticked);
  trigger_->choose(trigger_in(json["trigger"].toObject()));
  arrangement_->setCurrentIndex(json["arrangement"].toInt());
  set_mode(json["oscilloscope"].toBool() ? Mode::kOscilloscope : Mode::kNormal);
  set_differences(json["difference"].toBool());
  fit();
  const double width = json["width_s"].toDouble();
  const double begin = plots_->range().begin;
  if (width > 0.0) plots_->set_range({begin, begin + width});
  return wrong;
}

void ScopeWidget::load_layout(const QString& text) {
  if (const auto wrong = restore_layout(text)) note(*wrong, true);
}

void ScopeWidget::ask_to_save_layout() {
  QString file =
      QFileDialog::getSaveFileName(this, "Save layout", "layout.scope", "Layouts (*.scope)");
  if (file.isEmpty()) return;
  try {
    write_file_atomically(file.toStdString(), layout_text().toStdString() + "\n");
    note("wrote " + file.toStdString(), false);
  } catch (const std::runtime_error& error) {
    note(error.what(), true);
  }
}

void ScopeWidget::ask_to_load_layout() {
  const QString name = QFileDialog::getOpenFileName(this, "Load layout", QString(),
                                                    "Layouts (*.scope);;All files (*)");
  if (name.isEmpty()) return;
  QFile file(name);
  const bool readable = file.open(QIODevice::ReadOnly);
  const auto wrong = readable ? restore_layout(QString::fromUtf8(file.readAll()))
                              : file.errorString().toStdString();
  if (wrong) note(name.toStdString() + ": " + *wrong, true);
}

}  // namespace anthrob
