#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStackedWidget>
#include <QString>
#include <QTableWidget>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plot/plot_area.h"
#include "plot/quantity_tree.h"
#include "plot/source_list.h"
#include "plot/trigger_bar.h"
#include "scope/scope_model.h"

class QDragEnterEvent;
class QDropEvent;
class QHBoxLayout;
class QVBoxLayout;

namespace anthrob {

/// Any number of any topic over time: of a running robot, of recordings, or of both.
class ScopeWidget final : public QWidget {
 public:
  enum class Mode { kNormal, kOscilloscope };

  explicit ScopeWidget(std::unique_ptr<ScopeModel> model, QWidget* parent = nullptr);

  /// Shows in the window what is wrong with a recording.
  /// @return that line; none if it was opened
  std::optional<std::string> open(const std::string& path);
  ScopeModel& model() { return *model_; }
  PlotArea& plots() { return *plots_; }

  /// Writes all samples of what is plotted, or the picture, by the file's ending: csv, svg, pdf,
  /// png.
  /// @return what is wrong, one line; none if it was written
  std::optional<std::string> export_to(const std::string& file);

  /// What is ticked, opened and set, as JSON.
  QString layout_text() const;
  /// @return what is wrong with it, one line; none if it was understood
  std::optional<std::string> restore_layout(const QString& text);
  /// The same; what is wrong is shown in the window.
  void load_layout(const QString& text);

  /// As a click in the tree would.
  void tick(const std::set<std::string>& paths);
  void set_mode(Mode mode);
  void set_frozen(bool frozen);
  void set_differences(bool shown);
  /// To all that there is.
  void fit();
  /// Takes what came and draws it, as the timer does.
  void refresh();

 private:
  void build_toolbar(QVBoxLayout* column);
  QWidget* build_left();
  QWidget* build_right();
  QPushButton* add_switch(QHBoxLayout* line, const char* text, const char* name,
                          const char* tip);
  void add_menu(QHBoxLayout* line);
  void connect_parts();

  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

  void refresh_tree();
  void redraw();
  PlotContents contents_of(std::vector<Curve> curves) const;
  void follow(const std::vector<Curve>& curves);
  std::optional<double> trigger_origin(const std::vector<Curve>& curves);
  void show_cursor_values(const std::vector<Curve>& curves);
  void show_empty_state();
  std::string empty_text() const;
  std::string live_text(const MasterView& master) const;
  void note(const std::string& text, bool error);
  void ask_to_open();
  void ask_to_export();
  void ask_to_save_layout();
  void ask_to_load_layout();
  void print();
  std::string csv_text() const;

  std::unique_ptr<ScopeModel> model_;
  SourceList* sources_;
  QLineEdit* filter_;
  QuantityTree* tree_;
  PlotArea* plots_;
  TriggerBar* trigger_;
  QStackedWidget* stack_;
  QLabel* empty_;
  QLabel* note_;
  QTableWidget* values_;
  QComboBox* mode_;
  QComboBox* arrangement_;
  QPushButton* freeze_;
  QPushButton* follow_;
  QPushButton* cursors_;
  QPushButton* differences_;
  QTimer timer_;
  bool dirty_ = true;
  double origin_ = 0.0;  ///< [s] of the time axis
  int tree_version_ = 0;
  std::set<std::string> tree_topics_;
};

}  // namespace anthrob
