#pragma once

#include <OgreManualObject.h>
#include <OgreMaterial.h>

#include <string>

#include "anthrob_core/force_colour.h"
#include "tube.h"

namespace Ogre {
class SceneNode;
}

namespace anthrob {

/// A tube in RViz's scene, which takes another shape at every frame.
class TubeObject : public Ogre::ManualObject {
 public:
  /// @param name unique in the scene
  TubeObject(const std::string& name, Ogre::SceneNode* parent);
  ~TubeObject() override;

  /// An empty mesh is not drawn.
  void show(const TubeMesh& mesh);
  void paint(const Colour& colour);

 private:
  Ogre::MaterialPtr material_;
};

}  // namespace anthrob
