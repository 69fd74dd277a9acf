#include "plot/source_list.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QToolButton>
#include <QVBoxLayout>

namespace anthrob {
namespace {

constexpr double kMostShift = 1e6;  // [s]

}  // namespace

SourceList::SourceList(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
}

void SourceList::show_sources(const std::vector<SourceView>& sources,
                              const std::string& live_text) {
  std::vector<std::string> paths;
  for (const SourceView& source : sources) paths.push_back(source.path);
  if (rows_ == nullptr || paths != shown_paths_) rebuild(sources);
  shown_paths_ = paths;
  const QString text = QString::fromStdString(live_text);
  if (live_->text() == text) return;
  live_->setText(text);
  live_->setToolTip(text);
}

void SourceList::rebuild(const std::vector<SourceView>& sources) {
  // The button that was pressed is one of the old row's children.
  if (rows_ != nullptr) rows_->hide(), rows_->deleteLater();
  rows_ = new QWidget;
  grid_ = new QGridLayout(rows_);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setVerticalSpacing(2);
  grid_->setColumnStretch(0, 1);
  layout()->addWidget(rows_);
  for (std::size_t i = 0; i < sources.size(); ++i) add_row(sources[i], static_cast<int>(i));
}

void SourceList::add_row(const SourceView& source, int row) {
  const auto index = static_cast<std::size_t>(row);
  auto* box = new QCheckBox(QString::fromStdString(source.name));
  box->setObjectName(QString("source_%1").arg(row));
  box->setChecked(source.shown);
  box->setToolTip(QString::fromStdString(source.path));
  // Long names of files must not widen the list.
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  connect(box, &QCheckBox::toggled, this, [this, index](bool shown) {
    if (on_show_) on_show_(index, shown);
  });
  grid_->addWidget(box, row, 0, 1, source.live ? 3 : 1);
  if (source.live) {
    live_ = box;
    return;
  }
  auto* shift = new QDoubleSpinBox;
  shift->setObjectName(QString("shift_%1").arg(row));
  shift->setRange(-kMostShift, kMostShift);
  shift->setDecimals(3);
  shift->setSingleStep(0.01);
  shift->setSuffix(" s");
  shift->setValue(source.later);
  shift->setMaximumWidth(110);
  shift->setToolTip(
      "Shifts this recording to the right. Each recording begins at 0 with its first sample.");
  connect(shift, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this, index](double later) {
            if (on_shift_) on_shift_(index, later);
          });
  grid_->addWidget(shift, row, 1);
  auto* close = new QToolButton;
  close->setObjectName(QString("close_%1").arg(row));
  close->setText("x");
  close->setToolTip("Closes this recording");
  connect(close, &QToolButton::clicked, this, [this, index] {
    if (on_close_) on_close_(index);
  });
  grid_->addWidget(close, row, 2);
}

}  // namespace anthrob
