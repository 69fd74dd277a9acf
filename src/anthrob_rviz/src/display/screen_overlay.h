#pragma once

#include <OgreMaterial.h>
#include <OgreTexture.h>

#include <QImage>
#include <string>

namespace Ogre {
class Overlay;
class PanelOverlayElement;
}  // namespace Ogre

namespace anthrob {

/// A picture over RViz's view, in its lower left corner.
class ScreenOverlay {
 public:
  /// @param name unique in the program
  explicit ScreenOverlay(const std::string& name);
  ~ScreenOverlay();
  ScreenOverlay(const ScreenOverlay&) = delete;
  ScreenOverlay& operator=(const ScreenOverlay&) = delete;

  /// @param image of Format_ARGB32
  void show(const QImage& image);
  void hide();

 private:
  void take_texture(const QImage& image);

  std::string name_;
  Ogre::Overlay* overlay_;
  Ogre::PanelOverlayElement* panel_;
  Ogre::MaterialPtr material_;
  Ogre::TexturePtr texture_;
};

}  // namespace anthrob
