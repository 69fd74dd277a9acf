#pragma once

#include <QTreeWidget>
#include <string>
#include <vector>

#include "diagnostics.h"

namespace anthrob {

/// Everything that /diagnostics tells: a robot, its parts, and their values.
class DiagnosticsTree final : public QTreeWidget {
 public:
  DiagnosticsTree();
  void show_all(const std::vector<Diagnosis>& diagnoses);

 private:
  QTreeWidgetItem* whole_item(const std::string& name);
  void show_one(QTreeWidgetItem* whole, const std::string& part, const Diagnosis& diagnosis);
};

}  // namespace anthrob
