#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "scope/scope_model.h"

class QCheckBox;
class QGridLayout;

namespace anthrob {

/// Where numbers come from: a row each, with a box to show it, its shift in time, and a button to
/// close it.
class SourceList final : public QWidget {
 public:
  explicit SourceList(QWidget* parent = nullptr);

  /// @param live_text what to say of the live topics
  void show_sources(const std::vector<SourceView>& sources, const std::string& live_text);

  void on_show(std::function<void(std::size_t, bool)> call) { on_show_ = std::move(call); }
  void on_shift(std::function<void(std::size_t, double)> call) { on_shift_ = std::move(call); }
  void on_close(std::function<void(std::size_t)> call) { on_close_ = std::move(call); }

 private:
  void rebuild(const std::vector<SourceView>& sources);
  void add_row(const SourceView& source, int row);

  QWidget* rows_ = nullptr;
  QGridLayout* grid_ = nullptr;
  QCheckBox* live_ = nullptr;
  std::vector<std::string> shown_paths_;
  std::function<void(std::size_t, bool)> on_show_;
  std::function<void(std::size_t, double)> on_shift_;
  std::function<void(std::size_t)> on_close_;
};

}  // namespace anthrob
