#include "display/screen_overlay.h"

#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <Overlay/OgreOverlay.h>
#include <Overlay/OgreOverlayManager.h>
#include <Overlay/OgrePanelOverlayElement.h>

namespace anthrob {

namespace {

constexpr int kDistance = 10;  ///< [pixels] from the view's borders

const Ogre::String& resource_group() {
  return Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
}

}  // namespace

ScreenOverlay::ScreenOverlay(const std::string& name)
    : name_(name),
      overlay_(Ogre::OverlayManager::getSingleton().create(name)),
      panel_(static_cast<Ogre::PanelOverlayElement*>(
          Ogre::OverlayManager::getSingleton().createOverlayElement("Panel", name + " panel"))),
      material_(Ogre::MaterialManager::getSingleton().create(name, resource_group())) {
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->setLightingEnabled(false);
  pass->setDepthCheckEnabled(false);
  panel_->setMetricsMode(Ogre::GMM_PIXELS);
  panel_->setVerticalAlignment(Ogre::GVA_BOTTOM);
  panel_->setMaterial(material_);
  overlay_->add2D(panel_);
}

ScreenOverlay::~ScreenOverlay() {
  overlay_->hide();
  Ogre::OverlayManager::getSingleton().destroy(overlay_);
  Ogre::OverlayManager::getSingleton().destroyOverlayElement(panel_);
  Ogre::MaterialManager::getSingleton().remove(material_->getName(), resource_group());
  if (texture_) Ogre::TextureManager::getSingleton().remove(texture_->getName(), resource_group());
}

void ScreenOverlay::take_texture(const QImage& image) {
  texture_ = Ogre::TextureManager::getSingleton().createManual(
      name_, resource_group(), Ogre::TEX_TYPE_2D, static_cast<Ogre::uint>(image.width()),
      static_cast<Ogre::uint>(image.height()), 0, Ogre::PF_A8R8G8B8);
  Ogre::TextureUnitState* unit =
      material_->getTechnique(0)->getPass(0)->createTextureUnitState(texture_->getName());
  unit->setTextureFiltering(Ogre::TFO_NONE);
  panel_->setDimensions(static_cast<float>(image.width()), static_cast<float>(image.height()));
  panel_->setPosition(kDistance, static_cast<float>(-image.height() - kDistance));
}

void ScreenOverlay::show(const QImage& image) {
  if (!texture_) take_texture(image);
  QImage pixels = image;  // of its own, since Ogre takes no constant memory
  const Ogre::PixelBox box(static_cast<Ogre::uint32>(pixels.width()),
                           static_cast<Ogre::uint32>(pixels.height()), 1, Ogre::PF_A8R8G8B8,
                           pixels.bits());
  texture_->getBuffer()->blitFromMemory(box);
  overlay_->show();
}

void ScreenOverlay::hide() {
  overlay_->hide();
}

}  // namespace anthrob
