#pragma once

#include <rviz/panel.h>

#include <memory>

#include "plot/scope_widget.h"

namespace anthrob {

/// The scope within RViz. Its layout is kept in the .rviz file.
class ScopePanel final : public rviz::Panel {
 public:
  ScopePanel();  ///< over ROS, see ros/plugins.cpp
  explicit ScopePanel(std::unique_ptr<ScopeModel> model);

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  ScopeWidget* scope_;
};

}  // namespace anthrob
