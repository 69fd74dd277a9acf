#pragma once

#include <OgreCamera.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgrePixelFormat.h>
#include <OgreRenderTargetListener.h>
#include <OgreRenderWindow.h>
#include <rviz/config.h>
#include <rviz/default_plugin/robot_model_display.h>
#include <rviz/display_group.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/render_panel.h>
#include <rviz/robot/robot.h>
#include <rviz/robot/robot_link.h>
#include <rviz/visualization_manager.h>
#include <rviz/yaml_config_reader.h>

#include <QApplication>
#include <QTest>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/monotonic_clock.h"
#include "display/tube_object.h"

namespace anthrob {

/// RViz's view without its window. Of a program's life there can only be one: RViz's materials are
/// never removed.
class Screen : public Ogre::RenderTargetListener {
 public:
  explicit Screen(const QString& rviz_file) {
    panel_.resize(1000, 800);
    panel_.show();
    manager_ = std::make_unique<rviz::VisualizationManager>(&panel_);
    panel_.initialize(manager_->getSceneManager(), manager_.get());
    manager_->initialize();
    rviz::Config config;
    rviz::YamlConfigReader().readFile(config, rviz_file);
    manager_->load(config.mapGetChild("Visualization Manager"));
    panel_.getRenderWindow()->addListener(this);
    manager_->startUpdate();
  }
  ~Screen() override {
    manager_->stopUpdate();
    panel_.getRenderWindow()->removeListener(this);
    manager_->removeAllDisplays();
  }

  /// Called when a frame is drawn, before it is shown.
  std::function<void()> on_frame;
  void postRenderTargetUpdate(const Ogre::RenderTargetEvent& /*event*/) override {
    if (on_frame) on_frame();
  }

  template <class Condition>
  bool wait_for(Condition condition, double patience) {
    const double end = monotonic_now() + patience;
    while (!condition() && monotonic_now() < end) QTest::qWait(10);
    return condition();
  }

  rviz::VisualizationManager& manager() { return *manager_; }
  /// As the user sets it among the displays: {"Global Options", "Frame Rate"}.
  void set(const std::vector<QString>& path, const QVariant& value) {
    rviz::Property* property = manager_->getDisplayTreeModel()->getRoot();
    for (const QString& name : path) property = property->subProp(name);
    property->setValue(value);
  }
  template <class Display>
  Display* display(const char* name) {
    auto* group = manager_->getRootDisplayGroup();
    for (int i = 0; i < group->numDisplays(); ++i) {
      if (group->getDisplayAt(i)->getName() == name) {
        return static_cast<Display*>(group->getDisplayAt(i));
      }
    }
    return nullptr;
  }

  /// Where a point of the fixed frame is in the picture [pixels].
  Ogre::Vector2 pixel(const Ogre::Vector3& point) {
    const Ogre::Camera* camera = panel_.getCamera();
    const Ogre::Vector3 p = camera->getProjectionMatrix() * (camera->getViewMatrix() * point);
    const auto* window = panel_.getRenderWindow();
    return {0.5f * (1.0f + p.x) * static_cast<float>(window->getWidth()),
            0.5f * (1.0f - p.y) * static_cast<float>(window->getHeight())};
  }

  /// The picture that is being drawn, as 0xRRGGBB.
  std::vector<std::uint32_t> picture() {
    auto* window = panel_.getRenderWindow();
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width()) * height());
    const Ogre::PixelBox box(window->getWidth(), window->getHeight(), 1, Ogre::PF_X8R8G8B8,
                             pixels.data());
    window->copyContentsToMemory(Ogre::Box(box), box, Ogre::RenderTarget::FB_BACK);
    for (std::uint32_t& pixel : pixels) pixel &= 0xffffffu;
    return pixels;
  }
  Ogre::Viewport* viewport() { return panel_.getViewport(); }
  int width() { return static_cast<int>(panel_.getRenderWindow()->getWidth()); }
  int height() { return static_cast<int>(panel_.getRenderWindow()->getHeight()); }

 private:
  rviz::RenderPanel panel_;
  std::unique_ptr<rviz::VisualizationManager> manager_;
};

/// The screen of all tests, with what the shipped file shows.
inline std::unique_ptr<Screen>& shared_screen() {
  static std::unique_ptr<Screen> screen = std::make_unique<Screen>(
      QString::fromStdString(ANTHROB_CONFIG_DIR "/../launch/anthrob.rviz"));
  return screen;
}

/// Where RViz's robot model draws a point of a link.
inline Ogre::Vector3 on_bone(rviz::RobotModelDisplay* bones, const std::string& link,
                             const Ogre::Vector3& point_L) {
  struct Opened : rviz::RobotModelDisplay {
    static rviz::Robot* robot_of(rviz::RobotModelDisplay* display) {
      return display->*(&Opened::robot_);
    }
  };
  Ogre::SceneNode* node = Opened::robot_of(bones)->getLink(link)->getVisualNode();
  return node->_getDerivedPosition() + node->_getDerivedOrientation() * point_L;
}

/// A vertex, as the graphics card has it.
inline Ogre::Vector3 vertex(const TubeObject& object, std::size_t i) {
  const Ogre::VertexData* data = object.getSections()[0]->getRenderOperation()->vertexData;
  const auto* element = data->vertexDeclaration->findElementBySemantic(Ogre::VES_POSITION);
  const auto buffer = data->vertexBufferBinding->getBuffer(element->getSource());
  float p[3];
  buffer->readData(i * buffer->getVertexSize() + element->getOffset(), sizeof(p), p);
  return {p[0], p[1], p[2]};
}
inline Ogre::Vector3 first_end(const TubeObject& object) {
  return vertex(object, 0);
}
inline Ogre::Vector3 last_end(const TubeObject& object) {
  return vertex(object, object.getSections()[0]->getRenderOperation()->vertexData->vertexCount - 1);
}

}  // namespace anthrob
