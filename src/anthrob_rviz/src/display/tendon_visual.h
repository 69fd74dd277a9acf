#pragma once

#include <QColor>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/force_colour.h"
#include "display/tendon_selection.h"
#include "display/tube_object.h"

namespace rviz {
class MovableText;
}

namespace anthrob {

/// How all tendons are drawn.
struct TendonStyle {
  double thickness = 0.003;              ///< [m]
  double full_force = kFullColourForce;  ///< [N] where the scale of colours ends
  bool names = false;
  QColor text = Qt::white;  ///< of names
};

/// One tendon in RViz's scene: its tube, its name, and what a selection of it tells.
class TendonVisual {
 public:
  TendonVisual(const std::string& name, rviz::DisplayContext* context, Ogre::SceneNode* parent);
  ~TendonVisual();
  TendonVisual(const TendonVisual&) = delete;
  TendonVisual& operator=(const TendonVisual&) = delete;

  /// What is known of it; old facts are drawn grey.
  void tell(const TendonFacts& facts) { facts_ = facts; }
  /// @param line in the fixed frame [m]; not drawn if it is empty
  void draw(const std::vector<Vec3>& line, const TendonStyle& style);
  const TendonFacts& facts() const { return facts_; }
  const TubeObject& tube_object() const { return *tube_; }

 private:
  void draw_name(const std::vector<Vec3>& line, const TendonStyle& style);

  TendonFacts facts_;
  Ogre::SceneNode* node_;
  std::unique_ptr<TubeObject> tube_;
  TendonSelection selection_;
  std::unique_ptr<rviz::MovableText> label_;
  Ogre::SceneNode* label_node_ = nullptr;
};

}  // namespace anthrob
