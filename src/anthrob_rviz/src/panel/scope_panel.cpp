#include "panel/scope_panel.h"

#include <QVBoxLayout>
#include <utility>

namespace anthrob {
namespace {

const char* const kLayoutKey = "Layout";  // in the .rviz file

}  // namespace

ScopePanel::ScopePanel(std::unique_ptr<ScopeModel> model)
    : scope_(new ScopeWidget(std::move(model))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(scope_);
}

void ScopePanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString layout;
  if (config.mapGetString(kLayoutKey, &layout)) scope_->load_layout(layout);
}

void ScopePanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kLayoutKey, scope_->layout_text());
}

}  // namespace anthrob
