#include "panel/diagnostics_tree.h"

#include <QBrush>
#include <QHeaderView>

#include "panel/connected_panel.h"

namespace anthrob {
namespace {

/// The child with a text, made if there is none: what is unfolded and selected stays so.
QTreeWidgetItem* child_item(QTreeWidgetItem* parent, const std::string& text) {
  const QString wanted = QString::fromStdString(text);
  for (int i = 0; i < parent->childCount(); ++i) {
    if (parent->child(i)->text(0) == wanted) return parent->child(i);
  }
  auto* item = new QTreeWidgetItem(parent);
  item->setText(0, wanted);
  return item;
}

void show_value(QTreeWidgetItem* item, const std::string& value) {
  const QString text = QString::fromStdString(value);
  if (item->text(1) == text) return;
  item->setText(1, text);
  item->setToolTip(1, text);
}

}  // namespace

DiagnosticsTree::DiagnosticsTree() {
  setObjectName("diagnostics");
  setHeaderLabels({"Diagnostics", ""});
  setIndentation(14);
  header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
}

void DiagnosticsTree::show_all(const std::vector<Diagnosis>& diagnoses) {
  for (const Diagnosis& diagnosis : diagnoses) {
    const auto [whole, part] = whole_and_part(diagnosis.name);
    show_one(whole_item(whole.empty() ? "other nodes" : whole), part, diagnosis);
  }
}

QTreeWidgetItem* DiagnosticsTree::whole_item(const std::string& name) {
  QTreeWidgetItem* item = child_item(invisibleRootItem(), name);
  if (item->childCount() == 0) item->setExpanded(true);
  return item;
}

void DiagnosticsTree::show_one(QTreeWidgetItem* whole, const std::string& part,
                               const Diagnosis& diagnosis) {
  QTreeWidgetItem* item = child_item(whole, part);
  const bool stale = diagnosis.level == Level::kStale;
  show_value(item, stale ? "stale: " + diagnosis.message : diagnosis.message);
  item->setForeground(1, QBrush(QColor(colour_of(diagnosis.level))));
  for (const auto& [key, value] : diagnosis.values) show_value(child_item(item, key), value);
}

}  // namespace anthrob
