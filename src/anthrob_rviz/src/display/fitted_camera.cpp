#include "display/fitted_camera.h"

#include <OgreAxisAlignedBox.h>
#include <OgreCamera.h>
#include <OgreSceneNode.h>
#include <rviz/display.h>
#include <rviz/display_context.h>
#include <rviz/display_group.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

namespace anthrob {
namespace {

Ogre::AxisAlignedBox box_of(Ogre::SceneNode& node) {
  node._update(true, false);
  return node._getWorldAABB();
}

Vec3 to_vec3(const Ogre::Vector3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

bool looks_at_fixed_frame(const rviz::DisplayContext& context, rviz::ViewController& view) {
  const QString target = view.subProp("Target Frame")->getValue().toString();
  return target == context.getFixedFrame() || target == "<Fixed Frame>";
}

}  // namespace

std::optional<Box> robot_box(rviz::DisplayContext& context, Ogre::SceneNode& node) {
  Ogre::AxisAlignedBox models;
  rviz::DisplayGroup* displays = context.getRootDisplayGroup();
  for (int i = 0; i < displays->numDisplays(); ++i) {
    rviz::Display* display = displays->getDisplayAt(i);
    if (display->getClassId() != "rviz/RobotModel" || !display->isEnabled()) continue;
    models.merge(box_of(*display->getSceneNode()));
  }
  if (!models.isFinite()) return std::nullopt;
  models.merge(box_of(node));
  return Box{to_vec3(models.getMinimum()), to_vec3(models.getMaximum())};
}

void fit_camera(rviz::DisplayContext& context, const Box& box) {
  rviz::ViewController* view = context.getViewManager()->getCurrent();
  if (view == nullptr || view->getClassId() != "rviz/Orbit") return;
  if (!looks_at_fixed_frame(context, *view)) return;
  const Ogre::Camera& camera = *view->getCamera();
  const auto angle = [view](const char* name) {
    return view->subProp(name)->getValue().toDouble();
  };
  const OrbitView fitting = fitting_view(box, angle("Yaw"), angle("Pitch"),
                                         static_cast<double>(camera.getFOVy().valueRadians()),
                                         static_cast<double>(camera.getAspectRatio()));
  view->subProp("Distance")->setValue(fitting.distance);
  const char* const axes[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    view->subProp("Focal Point")->subProp(axes[i])->setValue(fitting.focus[i]);
  }
}

}  // namespace anthrob
