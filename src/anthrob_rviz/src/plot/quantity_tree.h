#pragma once

#include <QTimer>
#include <QTreeWidget>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "scope/quantity.h"

namespace anthrob {

/// All quantities below their topics, with boxes to tick. A live topic tells what it has once it is
/// opened.
class QuantityTree final : public QTreeWidget {
 public:
  explicit QuantityTree(QWidget* parent = nullptr);

  /// @param topics those that are live
  void show_quantities(const std::map<std::string, Quantity>& quantities,
                       const std::set<std::string>& topics, const std::set<std::string>& ticked);
  /// Shows only what has the text in its path.
  void filter(const QString& text);
  std::set<std::string> open_topics() const;
  /// Ticks a quantity, as a click would.
  void tick(const std::string& path, bool ticked);
  /// Shows what is ticked elsewhere, as by a layout, and calls nobody.
  void show_ticks(const std::set<std::string>& ticked);

  /// Called with paths that were ticked, or no longer are.
  void on_tick(std::function<void(const std::set<std::string>& paths, bool ticked)> call) {
    on_tick_ = std::move(call);
  }
  void on_open(std::function<void()> call) { on_open_ = std::move(call); }

 private:
  QTreeWidgetItem* topic_item(const std::string& topic);
  QTreeWidgetItem* add(const Quantity& quantity);
  void remove_others(const std::map<std::string, Quantity>& quantities,
                     const std::set<std::string>& topics);
  void remove(QTreeWidgetItem* item);
  void hear(QTreeWidgetItem* item);
  void pass_on();

  std::map<std::string, QTreeWidgetItem*> topics_, branches_, leaves_;
  std::map<std::string, bool> changed_;
  bool filling_ = false;
  QString filter_;
  QTimer later_;
  std::function<void(const std::set<std::string>&, bool)> on_tick_;
  std::function<void()> on_open_;
};

}  // namespace anthrob
