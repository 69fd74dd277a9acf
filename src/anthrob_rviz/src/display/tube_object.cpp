#include "display/tube_object.h"

#include <OgreMaterialManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>

namespace anthrob {

namespace {

constexpr float kShade = 0.45f;  ///< of the colour, where no light falls

Ogre::Vector3 to_ogre(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

TubeObject::TubeObject(const std::string& name, Ogre::SceneNode* parent)
    : Ogre::ManualObject(name),
      material_(Ogre::MaterialManager::getSingleton().create(
          name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME)) {
  material_->setReceiveShadows(false);
  material_->getTechnique(0)->setLightingEnabled(true);
  setDynamic(true);
  parent->attachObject(this);
}

TubeObject::~TubeObject() {
  detachFromParent();
  clear();
  Ogre::MaterialManager::getSingleton().remove(material_->getName(), material_->getGroup());
}

void TubeObject::show(const TubeMesh& mesh) {
  setVisible(!mesh.empty());
  if (mesh.empty()) return;
  // Of this shape only: begin and beginUpdate keep what earlier ones filled.
  mAABB.setNull();
  mRadius = 0.0f;
  if (mSectionList.empty()) {
    estimateVertexCount(2 * mesh.positions.size());
    estimateIndexCount(2 * mesh.indices.size());
    begin(material_);
  } else {
    // The section stays, and with it the colour by which RViz's selection knows it.
    beginUpdate(0);
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    position(to_ogre(mesh.positions[i]));
    normal(to_ogre(mesh.normals[i]));
  }
  for (const std::uint32_t i : mesh.indices) index(i);
  end();
}

void TubeObject::paint(const Colour& colour) {
  material_->setAmbient(kShade * colour.r, kShade * colour.g, kShade * colour.b);
  material_->setDiffuse(colour.r, colour.g, colour.b, 1.0f);
}

}  // namespace anthrob
